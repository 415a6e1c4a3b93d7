// Pointer and wheel on a frame: a mouse points with the loupe, drags the picture and pins the loupe
// by a click; fingers point, drag and pinch. While the picture fits, the page scrolls under a
// finger and under a wheel that turns outwards.
import type {Store} from './state.js';
import type {LockedView, Size} from './view.js';

/** A press that moves no further than this, in CSS pixels, is a click. */
const clickReach = 4;

interface Touch {
  x: number;
  y: number;
}

export function sizeOf(element: Element): Size {
  return {width: element.clientWidth, height: element.clientHeight};
}

export class Gestures {
  private readonly down = new Map<number, Touch>();
  private travelled = 0;

  constructor(
    private readonly frame: HTMLElement, private readonly view: LockedView, private readonly store: Store,
  ) {
    frame.addEventListener('wheel', event => { this.wheel(event); }, {passive: false});
    frame.addEventListener('pointerdown', event => { this.press(event); });
    frame.addEventListener('pointermove', event => { this.move(event); });
    for (const type of ['pointerup', 'pointercancel'] as const)
      frame.addEventListener(type, event => { this.release(event); });
  }

  private place(event: MouseEvent): Touch {
    const box = this.frame.getBoundingClientRect();
    return {x: event.clientX - box.left - this.frame.clientLeft, y: event.clientY - box.top - this.frame.clientTop};
  }

  private wheel(event: WheelEvent): void {
    if (event.deltaY === 0 || (event.deltaY > 0 && this.store.state.zoom <= 1)) return;
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : 30;
    const {x, y} = this.place(event);
    this.view.zoom(sizeOf(this.frame), Math.exp(-0.002 * lines * event.deltaY), x, y);
  }

  private press(event: PointerEvent): void {
    if (event.button !== 0 || (event.target as Element).closest('button, [role=slider]')) return;
    this.frame.setPointerCapture(event.pointerId);
    this.down.set(event.pointerId, this.place(event));
    this.travelled = this.down.size > 1 ? Infinity : 0;
    if (event.pointerType !== 'mouse') this.point(this.place(event));
  }

  private move(event: PointerEvent): void {
    const to = this.place(event);
    const from = this.down.get(event.pointerId);
    if (!from) {
      if (event.pointerType === 'mouse' && this.down.size === 0) this.point(to);
      return;
    }
    this.travelled += Math.hypot(to.x - from.x, to.y - from.y);
    const other = [...this.down].find(([id]) => id !== event.pointerId)?.[1];
    this.down.set(event.pointerId, to);
    if (other) this.pinch(from, to, other);
    else if (this.store.state.zoom > 1) this.drag(from, to);
    else this.point(to);
  }

  private drag(from: Touch, to: Touch): void {
    if (this.travelled > clickReach) this.view.pan(sizeOf(this.frame), to.x - from.x, to.y - from.y);
  }

  private pinch(from: Touch, to: Touch, other: Touch): void {
    const before = Math.hypot(from.x - other.x, from.y - other.y);
    const after = Math.hypot(to.x - other.x, to.y - other.y);
    const size = sizeOf(this.frame);
    if (before > 0) this.view.zoom(size, after / before, (from.x + other.x) / 2, (from.y + other.y) / 2);
    this.view.pan(size, (to.x - from.x) / 2, (to.y - from.y) / 2);
  }

  private release(event: PointerEvent): void {
    if (!this.down.delete(event.pointerId) || event.type === 'pointercancel') return;
    if (event.pointerType !== 'mouse' || this.travelled > clickReach) return;
    const pinned = !this.store.state.pinned;
    if (pinned) this.point(this.place(event));
    this.store.update({pinned});
  }

  private point(at: Touch): void {
    if (!this.store.state.pinned) this.store.update({pixel: this.view.pixelAt(sizeOf(this.frame), at.x, at.y)});
  }
}
