// Makes a folder as `penumbra compare` writes it, from a small scene of its own.
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import type {Method, MethodError, Results, Sweep} from '../../web/compare/src/results.js';
import {errorColour} from '../../web/compare/src/legend.js';
import {png} from './png.js';
import {draw, lamps, type Lamp} from './spheres.js';

export interface Wish {
  width: number;
  height: number;
  methods: string[];
  failed: string[];
  lamps: Lamp[];
  sweeps: boolean;
}

const about: Record<string, [title: string, summary: string, seconds: number]> = {
  'hard': ['Whitted 1980', 'One ray to the centre of the light decides whether all of it is seen. Edges are sharp wherever the light is not a point.', 0.031],
  'parker': ['Parker, Shirley and Smits 1998', 'The nearest miss of one ray to the light gives a soft edge outside the hard shadow. Smooth at one sample, but its umbra is too large.', 0.046],
  'heckbert-herf': ['Heckbert and Herf 1997', 'Hard shadows from many points of the light are averaged into a texture. It comes near the truth and shows steps where points are few.', 0.39],
  'sdf-classic': ['Quilez 2010', 'A march through the distance field keeps the least ratio of distance to way. It has the outer half of the penumbra alone.', 0.094],
  'sdf-improved': ['Aaltonen 2018', 'The same march, with the nearest point estimated between two steps. Corners come out less banded than in sdf-classic.', 0.101],
  'sdf-inner': ['Quilez after nurof3n', 'The march goes on through solids, so that the penumbra has its inner half as well. Light leaks through walls thinner than the penumbra.', 0.118],
  'area': ['Cook, Porter and Carpenter 1984', 'Many rays to points spread over the light are averaged. With enough of them this is the truth.', 0.87],
};

interface Drawn {
  planes: Float64Array[];
  means: Float64Array;
}

function meanPlane(planes: Float64Array[]): Float64Array {
  return (planes[0] ?? new Float64Array()).map((_, i) => planes.reduce((sum, p) => sum + (p[i] ?? NaN), 0) / planes.length);
}

const rms = (values: number[]): number => values.length ? Math.sqrt(values.reduce((s, v) => s + v * v, 0) / values.length) : 0;
const mean = (values: number[]): number => values.length ? values.reduce((s, v) => s + v, 0) / values.length : 0;

function errorsOf(mine: Float64Array, truth: Float64Array): {all: number[]; penumbra: number[]} {
  const all: number[] = [], penumbra: number[] = [];
  mine.forEach((value, i) => {
    const t = truth[i] ?? NaN;
    if (isNaN(value) || isNaN(t)) return;
    all.push(value - t);
    if (t > 0.002 && t < 0.998) penumbra.push(value - t);
  });
  return {all, penumbra};
}

function measured(mine: Float64Array, truth: Float64Array): MethodError {
  const {all, penumbra} = errorsOf(mine, truth);
  return {
    all: {rmse: rms(all), bias: mean(all)},
    penumbra: {rmse: rms(penumbra), bias: mean(penumbra), pixels: penumbra.length},
    largest: Math.max(0, ...all.map(Math.abs)),
    share_beyond_tenth: all.filter(e => Math.abs(e) > 0.1).length / Math.max(1, all.length),
    flip: 0.4 * rms(all), ssim: 1 - 0.8 * rms(all),
    leaked: all.reduce((s, e, i) => s + ((truth[i] ?? 1) < 0.002 ? Math.max(0, e) : 0), 0),
    lost: all.reduce((s, e, i) => s + ((truth[i] ?? 0) > 0.998 ? Math.max(0, -e) : 0), 0),
  };
}

function writeData(folder: string, name: string, wish: Wish, planes: Float64Array[]): void {
  const bytes = Buffer.concat(planes.map(plane => Buffer.from(Array.from(plane, v => isNaN(v) ? 255 : Math.round(254 * v)))));
  const packed = {width: wish.width, height: wish.height, lights: planes.length, bits: 8, values: bytes.toString('base64')};
  writeFileSync(join(folder, 'data', `${name}.js`), `penumbraData(${JSON.stringify(name)}, ${JSON.stringify(packed)});\n`);
}

function writePictures(folder: string, name: string, wish: Wish): Drawn {
  const {width, height} = wish, {planes, picture} = draw(name, width, height, wish.lamps), means = meanPlane(planes);
  const grey = (v: number): number[] => isNaN(v) ? [77, 85, 97] : [255 * v, 255 * v, 255 * v];
  writeFileSync(join(folder, 'pictures', `${name}.png`), png(width, height, (x, y) => picture[y * width + x] ?? []));
  writeFileSync(join(folder, 'visibility', `${name}.png`), png(width, height, (x, y) => grey(means[y * width + x] ?? NaN)));
  writeData(folder, name, wish, planes);
  return {planes, means};
}

function methodOf(folder: string, name: string, wish: Wish, truth: Drawn): Method {
  const [title, summary, seconds] = about[name] ?? [name, '', 1];
  const base = {
    name, title, summary, link: `https://example.org/docs/methods/${name}.md`, device: 'cpu',
    conversions: name.startsWith('sdf') ? ['6 spheres became distance fields'] : [],
    command: `penumbra render spheres.json -o ${name}.png --shadows ${name}`,
  };
  if (wish.failed.includes(name))
    return {...base, status: 'failed', reason: 'no OpenGL driver was found; install libegl1 and libgl1-mesa-dri',
      picture: null, visibility: null, error_map: null, data: null, error: null, lights: null, cost: null, equal_area: null};
  const {planes, means} = writePictures(folder, name, wish), {width, height} = wish;
  writeFileSync(join(folder, 'errors', `${name}.png`), png(width, height, (x, y) => {
    const error = (means[y * width + x] ?? NaN) - (truth.means[y * width + x] ?? NaN);
    return isNaN(error) ? [128, 128, 128] : errorColour(error, 0.5);
  }));
  const error = measured(means, truth.means), points = Math.max(1, Math.round((0.9 / ((error.penumbra.rmse ?? 1) + 0.01)) ** 1.3));
  const sdf = name.startsWith('sdf');
  return {
    ...base, status: 'ok', reason: null, picture: `pictures/${name}.png`, visibility: `visibility/${name}.png`,
    error_map: `errors/${name}.png`, data: `data/${name}.js`, error,
    lights: wish.lamps.map((lamp, i) => {
      const {all, penumbra} = measured(planes[i] ?? means, truth.planes[i] ?? truth.means);
      return {name: lamp.name, all, penumbra};
    }),
    cost: {
      seconds: {median: seconds, least: 0.97 * seconds, most: 1.06 * seconds, repeats: 5}, relative_to_hard: seconds / 0.031,
      phases: [{name: 'build', seconds: 0.002}, {name: 'shadows', seconds: seconds - 0.002}],
      rays: sdf ? 64000 : 128000 * (name === 'area' ? 64 : 1), distance_evaluations: sdf ? 5.2e6 : null,
      texel_samples: name === 'heckbert-herf' ? 2.1e6 : null, peak_bytes: 38e6 + 1e6 * name.length,
    },
    equal_area: name === 'area' ? null : {points, seconds: 0.02 + 0.0135 * points},
  };
}

function sweepOf(methods: Method[]): Sweep {
  const values = [0.01, 0.03, 0.1, 0.3, 1];
  return {
    parameter: 'light-size', unit: '', values,
    methods: methods.filter(m => m.status === 'ok').map(m => ({
      name: m.name,
      rmse: values.map(v => (m.error?.all.rmse ?? 0) * v ** 0.5),
      penumbra_rmse: values.map((v, i) => i === 0 && m.name === 'parker' ? null : (m.error?.penumbra.rmse ?? 0) * v ** 0.2),
      seconds: values.map(v => (m.cost?.seconds?.median ?? 1) * (0.7 + 0.3 * v)),
    })),
  };
}

/** Writes the folder's pictures, data and results.json, and gives the results. */
export function makeFixture(folder: string, wished: Partial<Wish> = {}): Results {
  const wish: Wish = {
    width: 320, height: 200, methods: Object.keys(about), failed: ['heckbert-herf'], lamps, sweeps: true, ...wished,
  };
  for (const name of ['pictures', 'visibility', 'errors', 'data']) mkdirSync(join(folder, name), {recursive: true});
  const truth = writePictures(folder, 'reference', wish);
  const methods = wish.methods.map(name => methodOf(folder, name, wish, truth));
  const inner = methods.find(m => m.name === 'sdf-inner' && m.status === 'ok');
  return {
    format: 'penumbra-compare', version: 1,
    scene: {
      file: 'spheres.json', checksum: '6f1c0a5be2d94713', width: wish.width, height: wish.height, camera: 'default',
      lights: wish.lamps.map(({name, kind}) => ({name, kind})), objects: 7, triangles: 2,
    },
    machine: {processor: 'Intel Xeon 2.1 GHz', threads: 2, memory_bytes: 8.2e9, system: 'Debian GNU/Linux 12'},
    versions: {penumbra: '0.5.0', compiler: 'g++ 12.2.0', embree: '3.13.5'},
    command: 'penumbra compare spheres.json -o out --size 320x200 --sweep light-size=0.01..1',
    scale: {error: 0.5},
    reference: {
      name: 'reference', picture: 'pictures/reference.png', visibility: 'visibility/reference.png', data: 'data/reference.js',
      target_standard_error: 0.002, share_within: 0.9993, points_mean: 812.4, points_most: 65536, seconds: 14.2, cached: false,
    },
    methods, sweeps: wish.sweeps ? [sweepOf(methods)] : [],
    advice: inner ? {
      method: 'sdf-inner',
      text: `use sdf-inner here: penumbra error ${inner.error?.penumbra.rmse?.toFixed(2) ?? '?'} at ${inner.cost?.relative_to_hard?.toFixed(1) ?? '?'} × the time of hard`,
    } : null,
  };
}

/** The page of these results, as the program fills in the bundle. */
export function writePage(folder: string, bundle: string, results: unknown): string {
  const json = JSON.stringify(results);
  writeFileSync(join(folder, 'results.json'), json);
  const page = readFileSync(bundle, 'utf8').replace('@results@', () => json.replaceAll('<', '\\u003c'));
  const file = join(folder, 'index.html');
  writeFileSync(file, page);
  return file;
}
