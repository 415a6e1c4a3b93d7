// All pictures side by side; they zoom and pan with the large ones and put themselves there.
import {button, h} from './dom.js';
import {Gestures, sizeOf} from './gestures.js';
import {Layer, marker} from './layer.js';
import type {Parts} from './parts.js';
import type {Shown} from './results.js';
import {shownOf} from './sources.js';

function pane(shown: Shown, {store, view, picture, sources}: Parts): HTMLElement {
  const layer = new Layer(picture, sources), square = marker();
  const frame = h('div', {class: 'frame'}, layer.element, square.element);
  new Gestures(frame, view, store);
  const sides = (['left', 'right'] as const).map(side => {
    const choose = button({'aria-label': `Show ${shown.name} on the ${side}`, 'aria-pressed': 'false'},
      () => { store.update({[side]: shown.name}); }, side === 'left' ? 'Left' : 'Right');
    store.onDraw(state => { choose.setAttribute('aria-pressed', String(state[side] === shown.name)); });
    return choose;
  });
  store.onDraw(state => {
    const size = sizeOf(frame);
    layer.show(shown, state);
    layer.place(state, size);
    square.place(state, picture, size);
    frame.classList.toggle('zoomed', state.zoom > 1);
  });
  return h('figure', {class: 'pane'}, frame,
    h('figcaption', {}, h('span', {class: 'method'}, shown.name), ...sides));
}

export function sheet(parts: Parts): HTMLElement {
  return h('div', {class: 'sheet'}, ...shownOf(parts.results).map(shown => pane(shown, parts)));
}
