// Axes of a plot: where a value stands, which ticks are labelled.
import {s} from './dom.js';
import {figures} from './numbers.js';

export interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

export interface Axis {
  log: boolean;
  low: number;
  high: number;
  /** Ends in the drawing; `from` belongs to `low`. */
  from: number;
  to: number;
}

/** An axis over all values with some room at its ends; a logarithmic one leaves out what is not above 0. */
export function axis(values: number[], log: boolean, from: number, to: number): Axis {
  const usable = values.filter(v => isFinite(v) && (!log || v > 0));
  const low = usable.length > 0 ? Math.min(...usable) : log ? 0.1 : 0;
  const high = usable.length > 0 ? Math.max(...usable) : 1;
  if (log) {
    const room = Math.max(1.25, (high / low) ** 0.1);
    return {log, low: low / room, high: high * room, from, to};
  }
  const room = 0.05 * (high - low) || 0.5 * Math.abs(high) || 0.5;
  return {log, low: low >= 0 && low - room < 0 ? 0 : low - room, high: high + room, from, to};
}

/** Where a value stands in the drawing; what the axis cannot show stands at its low end. */
export function place(a: Axis, value: number): number {
  const t = a.log
    ? value > 0 ? Math.log(value / a.low) / Math.log(a.high / a.low) : 0
    : (value - a.low) / (a.high - a.low);
  return a.from + Math.max(0, t) * (a.to - a.from);
}

const tidy = (value: number): number => Number(value.toPrecision(6));

function logTicks(a: Axis): {value: number; labelled: boolean}[] {
  const decades = Math.log10(a.high / a.low);
  const labelled = decades > 2.5 ? [1] : decades > 1.2 ? [1, 3] : decades > 0.6 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9];
  const ticks = [];
  for (let d = Math.floor(Math.log10(a.low)); d <= Math.log10(a.high); ++d)
    for (const m of decades > 0.6 ? [1, 2, 3, 4, 5, 6, 7, 8, 9] : labelled) {
      const value = tidy(m * 10 ** d);
      if (value >= a.low && value <= a.high) ticks.push({value, labelled: labelled.includes(m)});
    }
  return ticks;
}

function linearTicks(a: Axis, wanted: number): {value: number; labelled: boolean}[] {
  const rough = (a.high - a.low) / wanted, size = 10 ** Math.floor(Math.log10(rough));
  const step = size * ([1, 2, 5, 10].find(m => m * size >= rough) ?? 10);
  const ticks = [];
  for (let i = Math.ceil(a.low / step); i * step <= a.high; ++i) ticks.push({value: tidy(i * step), labelled: true});
  return ticks;
}

const ticksOf = (a: Axis): {value: number; labelled: boolean}[] =>
  a.log ? logTicks(a) : linearTicks(a, Math.abs(a.to - a.from) / 70);

/** Labels from which none touches the one before it. */
function apart(a: Axis, reach: (text: string) => number): {value: number; text: string}[] {
  let free = -Infinity;
  return ticksOf(a).map(({value, labelled}) => {
    const text = labelled ? figures(value) : '', at = Math.abs(place(a, value) - a.from);
    if (!text || at - reach(text) < free) return {value, text: ''};
    free = at + reach(text) + 6;
    return {value, text};
  });
}

export function frameOf(x: Axis, y: Axis, box: Box, xTitle: string, yTitle: string): SVGGElement {
  const parts: SVGElement[] = [];
  for (const {value, text} of apart(x, label => 3.5 * label.length)) {
    const at = place(x, value);
    parts.push(s('path', {class: text ? 'grid' : 'grid minor', d: `M${at} ${box.top}V${box.bottom}`}));
    if (text) parts.push(s('text', {x: at, y: box.bottom + 18, 'text-anchor': 'middle'}, text));
  }
  for (const {value, text} of apart(y, () => 6)) {
    const at = place(y, value);
    parts.push(s('path', {class: text ? 'grid' : 'grid minor', d: `M${box.left} ${at}H${box.right}`}));
    if (text) parts.push(s('text', {x: box.left - 8, y: at + 4, 'text-anchor': 'end'}, text));
  }
  parts.push(s('path', {class: 'axis', d: `M${box.left} ${box.top}V${box.bottom}H${box.right}`}),
    s('text', {class: 'title', x: box.right, y: box.bottom + 38, 'text-anchor': 'end'}, xTitle),
    s('text', {class: 'title', x: 0, y: 14}, yTitle));
  return s('g', {}, ...parts);
}
