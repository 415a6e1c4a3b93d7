// The line between two pictures: a slider by pointer, finger and keys.
import {h} from './dom.js';
import type {Store} from './state.js';

const steps: Record<string, number> = {
  ArrowLeft: -0.01, ArrowDown: -0.01, ArrowRight: 0.01, ArrowUp: 0.01, PageDown: -0.1, PageUp: 0.1, Home: -1, End: 1,
};

export function divider(store: Store, frame: HTMLElement): HTMLElement {
  const element = h('div', {
    class: 'divider', role: 'slider', tabindex: 0, 'aria-label': 'Divider between the two pictures',
    'aria-orientation': 'horizontal', 'aria-valuemin': 0, 'aria-valuemax': 100,
  }, h('span', {class: 'grip'}));
  const move = (value: number): void => { store.update({divider: Math.min(1, Math.max(0, value))}); };

  element.addEventListener('keydown', event => {
    const step = steps[event.key];
    if (step === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    move(store.state.divider + step * (event.shiftKey ? 10 : 1));
  });
  element.addEventListener('pointerdown', event => {
    if (event.button !== 0) return;
    event.stopPropagation();
    element.setPointerCapture(event.pointerId);
    element.focus({preventScroll: true});
    event.preventDefault();
  });
  element.addEventListener('pointermove', event => {
    if (!element.hasPointerCapture(event.pointerId)) return;
    event.stopPropagation();
    const box = frame.getBoundingClientRect();
    move((event.clientX - box.left - frame.clientLeft) / frame.clientWidth);
  });
  store.onDraw(({divider: value, left, right}) => {
    const percent = Math.round(100 * value);
    element.setAttribute('aria-valuenow', String(percent));
    element.setAttribute('aria-valuetext', `${percent} %: ${left} on the left, ${right} on the right`);
  });
  return element;
}
