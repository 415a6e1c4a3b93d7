// What results.json holds (format penumbra-compare, version 1). Times in seconds, all else in SI
// units, visible fractions in 0..1; null where unknown.

export type Maybe = number | null;

export interface PartError {
  rmse: Maybe;
  bias: Maybe;
  pixels?: Maybe;
}

export interface MethodError {
  all: PartError;
  penumbra: PartError;
  largest: Maybe;
  share_beyond_tenth: Maybe;
  flip: Maybe;
  ssim: Maybe;
  leaked: Maybe;
  lost: Maybe;
}

export interface LightError {
  name: string;
  all: PartError;
  penumbra: PartError;
}

export interface Cost {
  seconds: {median: Maybe; least: Maybe; most: Maybe; repeats: Maybe} | null;
  relative_to_hard: Maybe;
  phases: {name: string; seconds: Maybe}[] | null;
  rays: Maybe;
  distance_evaluations: Maybe;
  texel_samples: Maybe;
  peak_bytes: Maybe;
}

export interface Shown {
  name: string;
  picture: string | null;
  visibility: string | null;
  error_map?: string | null;
  data: string | null;
}

export interface Method extends Shown {
  title: string | null;
  summary: string | null;
  link: string | null;
  status: 'ok' | 'failed';
  reason: string | null;
  device: string | null;
  conversions: string[] | null;
  command: string | null;
  error_map: string | null;
  error: MethodError | null;
  lights: LightError[] | null;
  cost: Cost | null;
  equal_area: {points: Maybe; seconds: Maybe} | null;
}

export interface Reference extends Shown {
  target_standard_error: Maybe;
  share_within: Maybe;
  points_mean: Maybe;
  points_most: Maybe;
  seconds: Maybe;
  cached: boolean | null;
}

export interface SweepCurve {
  name: string;
  rmse: Maybe[] | null;
  penumbra_rmse: Maybe[] | null;
  seconds: Maybe[] | null;
}

export interface Sweep {
  parameter: string;
  unit: string | null;
  values: number[];
  methods: SweepCurve[];
}

export interface Light {
  name: string | null;
  kind: string | null;
}

export interface Results {
  format: string;
  version: number;
  scene: {
    file: string;
    checksum: string | null;
    width: number;
    height: number;
    camera: string | null;
    lights: Light[];
    objects: Maybe;
    triangles: Maybe;
  };
  machine: {processor: string | null; threads: Maybe; memory_bytes: Maybe; system: string | null} | null;
  versions: Record<string, string | null> | null;
  command: string | null;
  scale: {error: number};
  reference: Reference;
  methods: Method[];
  sweeps: Sweep[] | null;
  advice: {method: string | null; text: string} | null;
}

/** The results in the page's own element; throws one clear sentence. */
export function readResults(text: string): Results {
  let parsed: unknown;
  try {
    parsed = JSON.parse(text);
  } catch (problem) {
    throw new Error(`The results in this page are no JSON: ${String(problem)}`);
  }
  const results = parsed as Partial<Results> | null;
  if (results?.format !== 'penumbra-compare' || results.version !== 1)
    throw new Error('The results in this page are not of the format penumbra-compare, version 1.');
  return results as Results;
}

/** A name for every light, distinct or not: its own, or its kind and number. */
export function lightNames(results: Results): string[] {
  return results.scene.lights.map((light, i) => light.name ?? `${light.kind ?? 'light'} ${i + 1}`);
}

export const errorOf = {
  penumbra: (method: Method): Maybe => method.error?.penumbra.rmse ?? null,
  all: (method: Method): Maybe => method.error?.all.rmse ?? null,
};

export const secondsOf = (method: Method): Maybe => method.cost?.seconds?.median ?? null;
