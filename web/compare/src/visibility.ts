// The visible fractions that the loupe shows. Files are scripts, data/NAME.js, since a page opened
// from disk may run a script beside it but not read a file: penumbraData("NAME", {...}).

interface Packed {
  width: number;
  height: number;
  lights: number;
  bits: number;
  values: string;
  encoding?: string;
}

/** What one method sees: planes of width × height bytes, a light each, rows from the top. */
export class Visibility {
  constructor(
    readonly width: number, readonly height: number, readonly lights: number, readonly bytes: Uint8Array,
  ) {}

  /** The bytes of one light. */
  plane(light: number): Uint8Array {
    const size = this.width * this.height;
    return this.bytes.subarray(light * size, (light + 1) * size);
  }

  /** In [0, 1]; null where there is no surface. */
  at(x: number, y: number, light: number): number | null {
    const byte = this.bytes[(light * this.height + y) * this.width + x];
    return byte === undefined || byte === 255 ? null : byte / 254;
  }

  /** The mean over all lights; null where there is no surface. */
  mean(x: number, y: number): number | null {
    let sum = 0, known = 0;
    for (let light = 0; light < this.lights; ++light) {
      const value = this.at(x, y, light);
      if (value === null) continue;
      sum += value;
      ++known;
    }
    return known > 0 ? sum / known : null;
  }
}

/** A pixel in a penumbra, like its neighbours on every side: no edge of an object. */
function amidPenumbra(truth: Visibility, x: number, y: number): boolean {
  const middle = truth.mean(x, y);
  return middle !== null && Math.abs(middle - 0.5) < 0.25 && [[-3, 0], [3, 0], [0, -3], [0, 3]].every(([dx = 0, dy = 0]) => {
    const beside = x + dx < 0 || x + dx >= truth.width ? null : truth.mean(x + dx, y + dy);
    return beside !== null && Math.abs(beside - middle) < 0.3;
  });
}

/** Looks at no more than about this many pixels. */
const mostLooks = 60000;

/** The pixel, on a coarse grid, amid a penumbra of `truth`, where the means are furthest apart. */
export function furthestApart(truth: Visibility, all: Visibility[]): {x: number; y: number} | null {
  const step = Math.max(1, Math.ceil(Math.sqrt(truth.width * truth.height / mostLooks)));
  let best: {x: number; y: number} | null = null, widest = -1;
  for (let y = step >> 1; y < truth.height; y += step)
    for (let x = step >> 1; x < truth.width; x += step) {
      if (!amidPenumbra(truth, x, y)) continue;
      const means = all.map(one => one.mean(x, y)).filter(mean => mean !== null), apart = Math.max(...means) - Math.min(...means);
      if (apart <= widest) continue;
      widest = apart;
      best = {x, y};
    }
  return best;
}

/** A string says why there is none, or that it is not there yet. */
export type Loaded = Visibility | string;

export const loading = 'loading …';

declare global {
  interface Window {
    penumbraData: (name: string, packed: Packed) => void;
  }
}

async function unpack(packed: Packed): Promise<Visibility> {
  let bytes = Uint8Array.from(atob(packed.values), c => c.charCodeAt(0));
  if (packed.encoding === 'deflate') {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
    bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  }
  if (packed.bits !== 8 || bytes.length !== packed.width * packed.height * packed.lights)
    throw new Error('its size is not what it says');
  return new Visibility(packed.width, packed.height, packed.lights, bytes);
}

/** Loads files one after the other and tells `changed` of each. */
export class VisibilityStore {
  private readonly loaded = new Map<string, Loaded>();
  private readonly arrived = new Map<string, Packed>();

  constructor(private readonly changed: () => void) {
    window.penumbraData = (name, packed) => { this.arrived.set(name, packed); };
  }

  get(name: string): Loaded {
    return this.loaded.get(name) ?? loading;
  }

  async load(files: {name: string; data: string | null}[]): Promise<void> {
    for (const {name, data} of files) {
      if (data === null) continue;
      this.loaded.set(name, await this.read(name, data));
      this.changed();
    }
  }

  private async read(name: string, file: string): Promise<Loaded> {
    try {
      await runScript(file);
      const packed = this.arrived.get(name);
      if (!packed) return `${file} does not hold ${name}`;
      this.arrived.delete(name);
      return await unpack(packed);
    } catch (problem) {
      return `${file}: ${problem instanceof Error ? problem.message : 'cannot be read'}`;
    }
  }
}

function runScript(file: string): Promise<void> {
  return new Promise((resolve, reject) => {
    const script = document.createElement('script');
    script.src = file;
    script.onload = () => { script.remove(); resolve(); };
    script.onerror = () => { script.remove(); reject(new Error('is missing')); };
    document.head.append(script);
  });
}
