// Two pictures under a divider, with what chooses them.
import {divider} from './divider.js';
import {button, choice, h} from './dom.js';
import {Gestures, sizeOf} from './gestures.js';
import {Layer, marker} from './layer.js';
import {legend} from './legend.js';
import type {Parts} from './parts.js';
import {lightNames} from './results.js';
import {shownOf} from './sources.js';
import type {Kind, Store} from './state.js';
import type {LockedView, Size} from './view.js';

const arrows: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1],
};

function picker({results, store}: Parts, side: 'left' | 'right'): HTMLElement {
  const select = h('select', {id: `pick-${side}`},
    ...shownOf(results).map(shown => h('option', {value: shown.name}, shown.name)),
    ...results.methods.filter(method => method.status !== 'ok')
      .map(method => h('option', {disabled: true}, `${method.name} (failed)`)));
  select.addEventListener('change', () => { store.update({[side]: select.value}); });
  store.onDraw(state => { select.value = state[side]; });
  return h('div', {class: 'picker'}, h('label', {for: select.id}, side === 'left' ? 'Left' : 'Right'), select);
}

/** Which light the visible fractions and errors are of, where there are several. */
function lightPicker({results, store}: Parts): HTMLElement | null {
  const names = lightNames(results);
  if (names.length < 2) return null;
  const select = h('select', {id: 'pick-light'}, h('option', {value: ''}, 'mean of all'),
    ...names.map((name, i) => h('option', {value: i}, name)));
  select.addEventListener('change', () => { store.update({light: select.value === '' ? null : Number(select.value)}); });
  const element = h('div', {class: 'picker'}, h('label', {for: select.id}, 'Light'), select);
  store.onDraw(({kind}) => { element.hidden = kind === 'picture'; });
  return element;
}

function keys(event: KeyboardEvent, frame: HTMLElement, view: LockedView, store: Store): boolean {
  if (event.ctrlKey || event.metaKey || event.altKey) return false;
  const size = sizeOf(frame), arrow = arrows[event.key], step = event.shiftKey ? 10 : 1;
  if (arrow) view.step(size, arrow[0] * step, arrow[1] * step);
  else if (event.key === '+' || event.key === '=') view.zoom(size, 1.5);
  else if (event.key === '-') view.zoom(size, 1 / 1.5);
  else if (event.key === '0') view.fit(size);
  else if (event.key === '1') view.actualSize(size);
  else if (event.key === 'Enter' || event.key === ' ') store.update({pinned: !store.state.pinned});
  else if (event.key === 'Escape' && store.state.pinned) store.update({pinned: false});
  else return false;
  return true;
}

function frameOf({store, view, picture, sources}: Parts): HTMLElement {
  const left = new Layer(picture, sources, 'layer left'), right = new Layer(picture, sources, 'layer right'), square = marker();
  const names = {left: h('span', {class: 'name left'}), right: h('span', {class: 'name right'})};
  const frame = h('div', {
    class: 'frame', id: 'stage', tabindex: 0, role: 'application',
    'aria-label': 'Two pictures under a divider. Arrow keys move the loupe, with Shift by ten pixels; ' +
      'plus and minus zoom, 0 fits, 1 shows actual size; Enter pins the loupe.',
  }, left.element, right.element, square.element, names.left, names.right);
  frame.append(divider(store, frame));
  new Gestures(frame, view, store);
  frame.addEventListener('keydown', event => {
    if (event.target === frame && keys(event, frame, view, store)) event.preventDefault();
  });
  new ResizeObserver(() => { store.redraw(); }).observe(frame);
  store.onDraw(state => {
    const size = sizeOf(frame);
    left.show(sources.find(state.left), state);
    right.show(sources.find(state.right), state);
    left.place(state, size);
    right.place(state, size);
    square.place(state, picture, size);
    frame.style.setProperty('--divider', `${100 * state.divider}%`);
    names.left.textContent = state.left;
    names.right.textContent = state.right;
    names.left.hidden = state.divider < 0.12;
    names.right.hidden = state.divider > 0.88;
    frame.classList.toggle('zoomed', state.zoom > 1);
  });
  return frame;
}

function zoomButtons(frame: HTMLElement, {view, store}: Parts): HTMLElement {
  const level = h('output', {class: 'level', 'aria-label': 'Zoom'});
  store.onDraw(state => { level.textContent = `${state.zoom.toFixed(1)}×`; });
  const size = (): Size => sizeOf(frame);
  return h('div', {class: 'zoom', role: 'group', 'aria-label': 'Zoom of all pictures'},
    button({'aria-label': 'Zoom out'}, () => { view.zoom(size(), 1 / 1.5); }, '−'),
    level,
    button({'aria-label': 'Zoom in'}, () => { view.zoom(size(), 1.5); }, '+'),
    button({}, () => { view.fit(size()); }, 'Fit'),
    button({'aria-label': 'Actual size'}, () => { view.actualSize(size()); }, '1:1'));
}

export function stage(parts: Parts): HTMLElement {
  const {results, store} = parts, frame = frameOf(parts);
  const kinds: [Kind, string][] = [['picture', 'Picture'], ['visibility', 'Visible fraction'], ['error', 'Error']];
  return h('div', {class: 'stage'},
    h('div', {class: 'controls'},
      picker(parts, 'left'),
      button({class: 'swap', 'aria-label': 'Swap left and right'}, () => {
        store.update({left: store.state.right, right: store.state.left});
      }, '⇄'),
      picker(parts, 'right'),
      choice('Show', kinds, store.state.kind, kind => { store.update({kind: kind as Kind}); }),
      lightPicker(parts),
      zoomButtons(frame, parts)),
    frame,
    legend(results, store));
}
