// The visible fractions of every method at the pointed pixel, with the pixels round it.
import {button, h} from './dom.js';
import {errorColour} from './legend.js';
import {fixed, signed} from './numbers.js';
import type {Parts} from './parts.js';
import {lightNames, type Shown} from './results.js';
import {shownOf} from './sources.js';
import type {State} from './state.js';
import {Visibility} from './visibility.js';

/** The patch beside a row: so many pixels each way, so many CSS pixels wide each. */
const patchReach = 4, patchScale = 4;

interface Row {
  element: HTMLTableRowElement;
  draw: (state: Readonly<State>) => void;
}

function drawPatch(patch: HTMLElement, shown: Shown, state: Readonly<State>, {picture, sources}: Parts): void {
  const source = sources.of(shown, state);
  patch.style.backgroundImage = 'file' in source ? `url(${JSON.stringify(encodeURI(source.file))})` : 'none';
  patch.style.backgroundSize = `${picture.width * patchScale}px ${picture.height * patchScale}px`;
  patch.style.backgroundPosition =
    `${(patchReach - state.pixel.x) * patchScale}px ${(patchReach - state.pixel.y) * patchScale}px`;
}

function swatch(error: number | null, scale: number): HTMLElement | null {
  if (error === null) return null;
  const mark = h('span', {class: 'swatch'});
  mark.style.background = `rgb(${errorColour(error, scale).join(' ')})`;
  return mark;
}

function row(shown: Shown, parts: Parts): Row {
  const {results, data} = parts;
  const lights = results.scene.lights.length;
  const patch = h('span', {class: 'patch'}), side = h('span', {class: 'side'});
  const mean = h('td', {'data-value': 'mean'}), error = h('td', {'data-value': 'error'});
  const perLight = lights > 1 ? results.scene.lights.map((_, i) => h('td', {'data-value': `light-${i}`})) : [];
  const values = [mean, error, ...perLight];
  const note = h('td', {class: 'note', colspan: values.length});
  const head = h('th', {scope: 'row'}, patch, h('span', {}, h('span', {class: 'method'}, shown.name), side));
  const element = h('tr', {'data-method': shown.name}, head, ...values);

  const draw = (state: Readonly<State>): void => {
    const {x, y} = state.pixel;
    const mine = data.get(shown.name), truth = data.get(results.reference.name);
    drawPatch(patch, shown, state, parts);
    side.textContent = [state.left, state.right]
      .map((name, i) => name === shown.name ? (i === 0 ? 'left' : 'right') : '').filter(Boolean).join(', ');
    if (!(mine instanceof Visibility)) {
      note.textContent = mine;
      element.replaceChildren(head, note);
      return;
    }
    element.replaceChildren(head, ...values);
    const seen = mine.mean(x, y), true_ = truth instanceof Visibility ? truth.mean(x, y) : null;
    const off = seen === null || true_ === null || shown === results.reference ? null : seen - true_;
    mean.textContent = fixed(seen, 3);
    error.replaceChildren(...[swatch(off, results.scale.error), signed(off, 3)].filter(part => part !== null));
    perLight.forEach((cell, i) => { cell.textContent = fixed(mine.at(x, y, i), 3); });
  };
  return {element, draw};
}

/** What the keyboard has moved to, for those who cannot see it. */
function spoken(state: Readonly<State>, {data}: Parts): string {
  const told = [state.left, state.right].map(name => {
    const loaded = data.get(name);
    const value = loaded instanceof Visibility ? loaded.mean(state.pixel.x, state.pixel.y) : null;
    return `${name} ${value === null ? 'no surface' : value.toFixed(3)}`;
  });
  return `Pixel ${state.pixel.x}, ${state.pixel.y}: ${told.join(', ')}`;
}

export function loupe(parts: Parts): HTMLElement {
  const {results, store, data} = parts;
  const names = lightNames(results);
  const rows = shownOf(results).map(shown => row(shown, parts));
  const place = h('span', {class: 'place'}), live = h('output', {class: 'spoken', 'aria-live': 'polite'});
  const pin = button({class: 'pin', 'aria-pressed': 'false'}, () => {
    store.update({pinned: !store.state.pinned});
  }, 'Pin');
  const table = h('table', {},
    h('thead', {}, h('tr', {}, h('th', {scope: 'col'}, 'Method'), h('th', {scope: 'col'}, names.length > 1 ? 'Mean' : 'Visible'),
      h('th', {scope: 'col'}, 'Error'), ...(names.length > 1 ? names : []).map(name => h('th', {scope: 'col'}, name)))),
    h('tbody', {}, ...rows.map(r => r.element)));
  store.onDraw(state => {
    const {x, y} = state.pixel, truth = data.get(results.reference.name);
    const nothing = truth instanceof Visibility && truth.mean(x, y) === null;
    place.textContent = `x ${x}, y ${y}${nothing ? ': no surface' : ''}`;
    pin.setAttribute('aria-pressed', String(state.pinned));
    pin.textContent = state.pinned ? 'Pinned' : 'Pin';
    for (const r of rows) r.draw(state);
    if (document.activeElement?.id === 'stage') live.textContent = spoken(state, parts);
  });
  return h('aside', {class: 'loupe', id: 'loupe', 'aria-label': 'Visible fractions at the pointed pixel'},
    h('header', {}, h('h3', {}, 'Visible fraction at ', place), pin),
    h('div', {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'Visible fractions by method and light'}, table),
    live);
}
