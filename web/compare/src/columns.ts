// The columns of the table: what each one is called, means, shows and sorts by.
import {count, fixed, megabytes, percent, signed} from './numbers.js';
import type {Maybe, Method} from './results.js';

export interface Column {
  group: string;
  head: string;
  /** One sentence under the table. */
  meaning: string;
  text: (method: Method) => string;
  /** What rows are sorted by; null goes last. */
  key: (method: Method) => Maybe | string;
}

type Value = (method: Method) => Maybe | undefined;

function column(group: string, head: string, meaning: string, value: Value, text: (value: Maybe) => string): Column {
  const key = (method: Method): Maybe => value(method) ?? null;
  return {group, head, meaning, key, text: method => text(key(method))};
}

const decimals = (digits: number) => (value: Maybe): string => fixed(value, digits);
const withSign = (digits: number) => (value: Maybe): string => signed(value, digits);

function spread(method: Method): string {
  const time = method.cost?.seconds;
  return time ? `${fixed(time.least, 3)} … ${fixed(time.most, 3)}` : '–';
}

function spreadOf(method: Method): Maybe {
  const time = method.cost?.seconds;
  return time && time.most !== null && time.least !== null ? time.most - time.least : null;
}

const penumbra = 'Penumbra', cost = 'Cost', exchange = 'area, same error', whole = 'Whole picture';
const final = 'Final picture', light = 'Light, pixels', work = 'Work';

export const columns: Column[] = [
  column(penumbra, 'RMSE', 'root mean square error of the visible fractions of all lights where the reference is between 0.002 and 0.998',
    m => m.error?.penumbra.rmse, decimals(4)),
  column(penumbra, 'bias', 'mean error there; above 0 it is too bright', m => m.error?.penumbra.bias, withSign(4)),
  column(cost, 'time, s', 'to build what the method needs and to render one sample a pixel: median of the repeats after a warm-up', m => m.cost?.seconds?.median, decimals(3)),
  column(cost, '× hard', 'time over the time of hard', m => m.cost?.relative_to_hard, decimals(2)),
  column(exchange, 'points', 'points on each light with which the method area has the same penumbra RMSE', m => m.equal_area?.points, count),
  column(exchange, 'time, s', 'its time with so many points', m => m.equal_area?.seconds, decimals(3)),
  column(whole, 'RMSE', 'root mean square error wherever there is a surface', m => m.error?.all.rmse, decimals(4)),
  column(whole, 'bias', 'mean error wherever there is a surface', m => m.error?.all.bias, withSign(4)),
  column(whole, 'largest', 'largest error at any pixel', m => m.error?.largest, decimals(3)),
  column(whole, '> 0.1, %', 'share of all pixels and lights that are off by more than 0.1', m => m.error?.share_beyond_tenth, v => percent(v, 2)),
  column(final, 'FLIP', 'mean FLIP difference of the final pictures at 67 pixels a degree; 0 is none', m => m.error?.flip, decimals(4)),
  column(final, 'SSIM', 'mean structural similarity of the final pictures; 1 is the same', m => m.error?.ssim, decimals(4)),
  column(light, 'leaked', 'sum of the errors of all pixels where the reference is dark', m => m.error?.leaked, decimals(1)),
  column(light, 'lost', 'minus the sum of the errors of all pixels where the reference is lit', m => m.error?.lost, decimals(1)),
  {group: work, head: 'spread, s', meaning: 'fastest and slowest repeat; sorted by their difference', text: spread, key: spreadOf},
  column(work, 'rays', 'shadow rays of that one picture', m => m.cost?.rays, count),
  column(work, 'distances', 'evaluations of the distance field by shadows', m => m.cost?.distance_evaluations, count),
  column(work, 'texels', 'texels of what is baked first, times points on the lights', m => m.cost?.texel_samples, count),
  column(work, 'memory, MB', 'most memory in use beyond the scene', m => m.cost?.peak_bytes, megabytes),
  {group: work, head: 'device', meaning: 'what it ran on', text: m => m.device ?? '–', key: m => m.device},
];
