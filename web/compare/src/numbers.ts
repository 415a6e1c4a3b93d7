// Numbers as people read them: a true minus, thin spaces between thousands, – where unknown.
import type {Maybe} from './results.js';

const unknown = '–';
const minus = (text: string): string => text.replace('-', '−');

const known = (value: Maybe | undefined): value is number => typeof value === 'number' && isFinite(value);

/** With so many decimals. */
export function fixed(value: Maybe | undefined, decimals: number): string {
  if (!known(value)) return unknown;
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? (0).toFixed(decimals) : minus(text);
}

/** The same with its sign; 0 has none. */
export function signed(value: Maybe | undefined, decimals: number): string {
  if (!known(value)) return unknown;
  const text = value.toFixed(decimals);
  if (Number(text) === 0) return (0).toFixed(decimals);
  return value > 0 ? `+${text}` : minus(text);
}

/** Three significant figures without an exponent from 0.0001 to 10⁶. */
export function figures(value: Maybe | undefined): string {
  if (!known(value)) return unknown;
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e6) return minus(value.toExponential(1)).replace('e', ' e');
  return minus(String(Number(value.toPrecision(3))));
}

/** A count: 12 345 up to a million, then 1.23 M, 4.56 G. */
export function count(value: Maybe | undefined): string {
  if (!known(value)) return unknown;
  for (const [size, letter] of [[1e12, 'T'], [1e9, 'G'], [1e6, 'M']] as const)
    if (value >= size) return `${(value / size).toPrecision(3)} ${letter}`;
  return (Number.isInteger(value) ? String(value) : value.toFixed(1)).replace(/\B(?=(\d{3})+(?!\d|\.))/g, '\u2009');
}

/** Bytes in megabytes of 10⁶. */
export function megabytes(value: Maybe | undefined): string {
  return known(value) ? (value / 1e6).toFixed(value < 1e7 ? 1 : 0) : unknown;
}

/** A share as a percentage. */
export function percent(value: Maybe | undefined, decimals: number): string {
  return known(value) ? (100 * value).toFixed(decimals) : unknown;
}
