// Zoom and pan that all pictures share. A frame of any size shows the same part of the picture as
// long as all frames have one shape.
import type {State, Store} from './state.js';

export interface Size {
  width: number;
  height: number;
}

export interface Placement {
  /** Frame units for a pixel of the picture. */
  scale: number;
  left: number;
  top: number;
}

/** A pixel of the picture becomes no larger than this many CSS pixels, unless it fits so. */
const largestPixel = 48;

const clamp = (value: number, low: number, high: number): number => Math.min(Math.max(value, low), high);

const fitScale = (picture: Size, frame: Size): number =>
  Math.min(frame.width / picture.width, frame.height / picture.height);

export function placement(state: Readonly<State>, picture: Size, frame: Size): Placement {
  const scale = fitScale(picture, frame) * state.zoom;
  return {scale, left: frame.width / 2 - state.x * scale, top: frame.height / 2 - state.y * scale};
}

/** The centre on one axis: no gap at an edge while the picture is larger than its frame. */
function held(centre: number, length: number, visible: number): number {
  return visible >= length ? length / 2 : clamp(centre, visible / 2, length - visible / 2);
}

export class LockedView {
  constructor(private readonly store: Store, private readonly picture: Size) {}

  /** The pixel at a place in a frame, the nearest one if the place is beside the picture. */
  pixelAt(frame: Size, x: number, y: number): {x: number; y: number} {
    const p = placement(this.store.state, this.picture, frame);
    return {
      x: clamp(Math.floor((x - p.left) / p.scale), 0, this.picture.width - 1),
      y: clamp(Math.floor((y - p.top) / p.scale), 0, this.picture.height - 1),
    };
  }

  /** Zooms by `factor` and keeps the place (x, y) of the frame where it is. */
  zoom(frame: Size, factor: number, x = frame.width / 2, y = frame.height / 2): void {
    const before = placement(this.store.state, this.picture, frame);
    const most = Math.max(1, largestPixel / fitScale(this.picture, frame));
    const zoom = clamp(this.store.state.zoom * factor, 1, most);
    const scale = fitScale(this.picture, frame) * zoom;
    this.show(frame, zoom, (x - before.left) / before.scale + (frame.width / 2 - x) / scale,
      (y - before.top) / before.scale + (frame.height / 2 - y) / scale);
  }

  /** One pixel of the picture for a CSS pixel, or the fit where that is larger. */
  actualSize(frame: Size): void {
    this.zoom(frame, 1 / (fitScale(this.picture, frame) * this.store.state.zoom));
  }

  fit(frame: Size): void {
    this.show(frame, 1, this.picture.width / 2, this.picture.height / 2);
  }

  /** Moves the picture by so many units of the frame. */
  pan(frame: Size, dx: number, dy: number): void {
    const {x, y, zoom} = this.store.state;
    const {scale} = placement(this.store.state, this.picture, frame);
    this.show(frame, zoom, x - dx / scale, y - dy / scale);
  }

  /** Moves the loupe by pixels, and the picture where the loupe would leave the frame. */
  step(frame: Size, dx: number, dy: number): void {
    const old = this.store.state.pixel;
    const pixel = {
      x: clamp(old.x + dx, 0, this.picture.width - 1), y: clamp(old.y + dy, 0, this.picture.height - 1),
    };
    const {x, y, zoom} = this.store.state;
    const {scale} = placement(this.store.state, this.picture, frame);
    const reachX = Math.max(0, frame.width / scale / 2 - 1), reachY = Math.max(0, frame.height / scale / 2 - 1);
    this.store.update({pixel});
    this.show(frame, zoom, clamp(x, pixel.x + 0.5 - reachX, pixel.x + 0.5 + reachX),
      clamp(y, pixel.y + 0.5 - reachY, pixel.y + 0.5 + reachY));
  }

  private show(frame: Size, zoom: number, x: number, y: number): void {
    const scale = fitScale(this.picture, frame) * zoom;
    this.store.update({
      zoom, x: held(x, this.picture.width, frame.width / scale), y: held(y, this.picture.height, frame.height / scale),
    });
  }
}
