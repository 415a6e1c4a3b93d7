// Colour and shape of each method: the same in every plot, and either tells them apart alone.
import {s} from './dom.js';
import type {Results} from './results.js';

const shapes = [
  'M-5 0a5 5 0 1 0 10 0a5 5 0 1 0-10 0z', 'M-4.5-4.5h9v9h-9z', 'M0-6L5.5 4h-11z', 'M0-6L6 0L0 6L-6 0z',
  'M0 6L5.5-4h-11z', 'M-2-6h4v4h4v4h-4v4h-4v-4h-4v-4h4z', 'M-6 0L-3-5h6L6 0L3 5h-6z', 'M0-6L6-1L3.5 5h-7L-6-1z',
];
const dashes = ['', '7 3', '2 3', '9 3 2 3', '5 2', '12 4', '3 2', '1 3'];

/** Which of the eight styles a method has. */
export function styleOf(results: Results, name: string): number {
  return Math.max(0, results.methods.findIndex(m => m.name === name)) % shapes.length;
}

export function markAt(style: number, x: number, y: number, title: string, hollow = false): SVGPathElement {
  return s('path', {class: hollow ? 'mark hollow' : 'mark', d: shapes[style] ?? '', transform: `translate(${x} ${y})`},
    s('title', {}, title));
}

export function dashOf(style: number): string {
  return dashes[style] ?? '';
}
