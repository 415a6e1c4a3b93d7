// One picture in a frame, placed by the shared view.
import {h} from './dom.js';
import type {Shown} from './results.js';
import type {Sources} from './sources.js';
import type {State} from './state.js';
import {placement, type Size} from './view.js';

/** From this scale on a pixel is shown as a square. */
const squareFrom = 1.5;

export class Layer {
  readonly element: HTMLElement;
  private readonly image = h('img', {alt: '', draggable: 'false', decoding: 'async'});
  private readonly note = h('p', {class: 'note'});
  private file = '';

  constructor(private readonly picture: Size, private readonly sources: Sources, className = 'layer') {
    this.image.width = picture.width;
    this.image.height = picture.height;
    this.element = h('div', {class: className}, this.image, this.note);
    this.image.addEventListener('error', () => { this.say(`${this.file} is missing.`); });
  }

  show(shown: Shown, state: Readonly<State>): void {
    const source = this.sources.of(shown, state);
    if ('file' in source) {
      if (source.file !== this.file) this.load(source.file, `${shown.name}: ${state.kind}`);
    } else {
      this.file = '';
      this.say(source.note);
    }
  }

  place(state: Readonly<State>, frame: Size): void {
    const {scale, left, top} = placement(state, this.picture, frame);
    this.image.style.transform = `translate(${left}px, ${top}px) scale(${scale})`;
    this.image.style.imageRendering = scale * devicePixelRatio >= squareFrom ? 'pixelated' : 'auto';
  }

  private load(file: string, alt: string): void {
    this.file = file;
    this.image.src = file;
    this.image.alt = alt;
    this.image.hidden = false;
    this.note.textContent = '';
  }

  private say(text: string): void {
    this.image.hidden = true;
    this.note.textContent = text;
  }
}

/** A square round the pixel of the loupe. */
export function marker(): {element: HTMLElement; place: (state: Readonly<State>, picture: Size, frame: Size) => void} {
  const element = h('div', {class: 'marker'});
  return {
    element,
    place(state, picture, frame) {
      const {scale, left, top} = placement(state, picture, frame);
      const side = Math.max(scale, 9);
      element.style.width = element.style.height = `${side}px`;
      element.style.transform = `translate(${left + (state.pixel.x + 0.5) * scale - side / 2}px, ` +
        `${top + (state.pixel.y + 0.5) * scale - side / 2}px)`;
    },
  };
}
