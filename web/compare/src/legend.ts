// The fixed scales of the pictures that show numbers, with ticks.
import {h, s} from './dom.js';
import {fixed, signed} from './numbers.js';
import type {Results} from './results.js';
import type {Store} from './state.js';

/**
 * Colours of signed errors from -scale to +scale, as src/compare/error_map.cpp has them: RdBu's blues
 * and PuOr's oranges of Brewer's ColorBrewer 2.0 (2002); between them straight lines in sRGB.
 */
export const errorColours = [
  '#053061', '#2166ac', '#4393c3', '#92c5de', '#d1e5f0', '#f7f7f7', '#fee0b6', '#fdb863', '#e08214', '#b35806', '#7f3b08',
] as const;

const channels = (colour: string): number[] => [1, 3, 5].map(i => parseInt(colour.slice(i, i + 2), 16));

/** The colour of an error as red, green and blue, 0..255; beyond the scale that of its end. */
export function errorColour(error: number, scale: number): number[] {
  const at = (Math.min(1, Math.max(-1, error / scale)) + 1) / 2 * (errorColours.length - 1);
  const first = Math.min(Math.floor(at), errorColours.length - 2);
  const from = channels(errorColours[first] ?? ''), to = channels(errorColours[first + 1] ?? '');
  return from.map((value, i) => Math.round(value + (at - first) * ((to[i] ?? value) - value)));
}

interface Scale {
  id: string;
  title: string;
  colours: readonly string[];
  ticks: [place: number, text: string][];
  ends: [string, string];
  /** The colour of what has no surface. */
  nothing: string;
}

function bar(scale: Scale): HTMLElement {
  const stops = scale.colours.map((colour, i) =>
    s('stop', {offset: i / (scale.colours.length - 1), 'stop-color': colour}));
  const ticks = scale.ticks.map(([place, text]) => s('g', {transform: `translate(${20 + 280 * place} 0)`},
    s('path', {d: 'M0 14v5', class: 'tick'}), s('text', {y: 31, 'text-anchor': 'middle'}, text)));
  return h('figure', {class: 'legend'},
    h('figcaption', {}, scale.title),
    h('div', {class: 'ends'}, h('span', {}, scale.ends[0]),
      h('span', {}, h('i', {class: 'nothing', style: `background: ${scale.nothing}`}), 'no surface'), h('span', {}, scale.ends[1])),
    s('svg', {viewBox: '0 0 320 34', role: 'img', 'aria-label': `${scale.title}: ${scale.ends.join(' to ')}, ` +
      scale.ticks.map(([, text]) => text).join(', ')},
    s('defs', {}, s('linearGradient', {id: scale.id}, ...stops)),
    s('rect', {x: 20, y: 2, width: 280, height: 12, fill: `url(#${scale.id})`, class: 'bar'}), ...ticks));
}

export function legend(results: Results, store: Store): HTMLElement {
  const limit = results.scale.error;
  const error = bar({
    id: 'error-colours',
    title: 'Visible fraction, method − reference',
    colours: errorColours,
    ticks: [-1, -0.5, 0, 0.5, 1].map(t => [(t + 1) / 2, signed(t * limit, 2)]),
    ends: ['too dark', 'too bright'],
    nothing: '#808080',
  });
  const visible = bar({
    id: 'visible-colours',
    title: 'Visible fraction',
    colours: ['#000', '#fff'],
    ticks: [0, 0.25, 0.5, 0.75, 1].map(t => [t, fixed(t, 2)]),
    ends: ['light hidden', 'light seen'],
    nothing: '#4d5561',
  });
  store.onDraw(({kind}) => {
    error.hidden = kind !== 'error';
    visible.hidden = kind !== 'visibility';
  });
  return h('div', {class: 'legends'}, error, visible);
}
