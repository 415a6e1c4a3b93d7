// Which picture shows a method, and what is said where there is none.
import {errorColour} from './legend.js';
import type {Results, Shown} from './results.js';
import type {Kind, State} from './state.js';
import {Visibility, type VisibilityStore} from './visibility.js';

export type Source = {file: string} | {note: string};

/** As in the files: grey in errors, slate in visible fractions, which may be grey. */
const noSurface = {error: [128, 128, 128, 255], visibility: [77, 85, 97, 255]};

/** By the visible fraction in 254ths, from -254. */
const greys = Array.from({length: 509}, (_, i) => [...Array<number>(3).fill(255 * Math.max(0, i - 254) / 254), 255]);

/** The reference and every method that has pictures, in the order of the results. */
export function shownOf(results: Results): Shown[] {
  return [results.reference, ...results.methods.filter(method => method.status === 'ok')];
}

function fileOf(shown: Shown, kind: Kind): string | null | undefined {
  return kind === 'picture' ? shown.picture : kind === 'visibility' ? shown.visibility : shown.error_map;
}

/** Pictures come from files; those of one light are made from the data of the loupe. */
export class Sources {
  private made = new Map<string, string>();
  private madeFor: number | null = null;
  /** By the error in 254ths, from -254. */
  private readonly errorColours: number[][];

  constructor(
    private readonly results: Results, private readonly data: VisibilityStore, private readonly changed: () => void,
  ) {
    this.errorColours = Array.from({length: 509}, (_, i) => [...errorColour((i - 254) / 254, results.scale.error), 255]);
  }

  find(name: string): Shown {
    return shownOf(this.results).find(shown => shown.name === name) ?? this.results.reference;
  }

  of(shown: Shown, {kind, light}: Readonly<State>): Source {
    if (kind === 'error' && shown === this.results.reference) return {note: 'Errors are measured against this reference.'};
    if (kind !== 'picture' && light !== null) return this.ofLight(shown, kind, light);
    const file = fileOf(shown, kind);
    return file ? {file} : {note: `There is no picture of ${shown.name}.`};
  }

  private ofLight(shown: Shown, kind: Kind, light: number): Source {
    const mine = this.data.get(shown.name), truth = this.data.get(this.results.reference.name);
    if (!(mine instanceof Visibility)) return {note: mine};
    if (!(truth instanceof Visibility)) return {note: truth};
    if (light !== this.madeFor) this.forget(light);
    const key = `${kind} ${shown.name}`, file = this.made.get(key);
    if (file === undefined) this.make(key, light, mine, kind === 'error' ? truth : null);
    return file ? {file} : {note: 'drawing …'};
  }

  /** The visible fractions of one light, or their errors against a truth. */
  private make(key: string, light: number, mine: Visibility, truth: Visibility | null): void {
    this.made.set(key, '');
    const canvas = document.createElement('canvas');
    canvas.width = mine.width;
    canvas.height = mine.height;
    const context = canvas.getContext('2d');
    if (!context) return;
    const pixels = context.createImageData(mine.width, mine.height);
    const colours = truth ? this.errorColours : greys, none = truth ? noSurface.error : noSurface.visibility;
    const true_ = truth?.plane(light);
    mine.plane(light).forEach((seen, i) => {
      const expected = true_?.[i] ?? 0;
      pixels.data.set(seen === 255 || expected === 255 ? none : colours[seen - expected + 254] ?? none, 4 * i);
    });
    context.putImageData(pixels, 0, 0);
    canvas.toBlob(blob => {
      if (blob === null || light !== this.madeFor) return;
      this.made.set(key, URL.createObjectURL(blob));
      this.changed();
    });
  }

  private forget(light: number): void {
    for (const file of this.made.values()) if (file) URL.revokeObjectURL(file);
    this.made = new Map();
    this.madeFor = light;
  }
}
