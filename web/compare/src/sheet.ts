// All pictures side by side; they zoom and pan with the large ones and put themselves there.
import {button, h} from './dom.js';
import {Gestures, sizeOf} from './gestures.js';
import {Layer, marker} from './layer.js';
import type {Results, Shown} from './results.js';
import {shownOf} from './sources.js';
import type {Store} from './state.js';
import type {LockedView, Size} from './view.js';

function pane(shown: Shown, store: Store, view: LockedView, picture: Size): HTMLElement {
  const layer = new Layer(picture), square = marker();
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

export function sheet(results: Results, store: Store, view: LockedView, picture: Size): HTMLElement {
  return h('div', {class: 'sheet'}, ...shownOf(results).map(shown => pane(shown, store, view, picture)));
}
