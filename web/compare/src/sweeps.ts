// What a sweep found: error and time over its parameter, a curve for each method.
import {axis, frameOf, place, type Axis, type Box} from './axes.js';
import {s} from './dom.js';
import {stacked, textWidth} from './labels.js';
import {dashOf, markAt, styleOf} from './marks.js';
import {figures} from './numbers.js';
import type {Part, Plot} from './plots.js';
import type {Maybe, Results, Sweep} from './results.js';

interface Curve {
  name: string;
  style: number;
  points: {x: number; y: number}[];
}

function curvesOf(results: Results, sweep: Sweep, values: (m: Sweep['methods'][number]) => Maybe[] | null): Curve[] {
  return sweep.methods.flatMap(method => {
    const points = (values(method) ?? []).flatMap((y, i) => {
      const x = sweep.values[i];
      return y === null || x === undefined ? [] : [{x, y}];
    });
    return points.length > 0 ? [{name: method.name, style: styleOf(results, method.name), points}] : [];
  });
}

const spreadLog = (values: number[]): boolean =>
  values.every(v => v > 0) && Math.max(...values) / Math.min(...values) >= 8;

function path(curve: Curve, x: Axis, y: Axis): string {
  return curve.points.map((p, i) => `${i === 0 ? 'M' : 'L'}${place(x, p.x).toFixed(1)} ${place(y, p.y).toFixed(1)}`).join('');
}

function draw(curves: Curve[], sweep: Sweep, width: number, yTitle: string): SVGSVGElement {
  const height = Math.round(Math.min(400, Math.max(280, width * 0.62)));
  const names = Math.max(0, ...curves.map(c => textWidth(c.name)));
  const box: Box = {left: 52, right: width - names - 26, top: 30, bottom: height - 48};
  const x = axis(sweep.values, spreadLog(sweep.values), box.left, box.right);
  const heights = curves.flatMap(c => c.points.map(p => p.y));
  const y = axis(heights, heights.some(v => v > 0), box.bottom, box.top);
  const ends = curves.map(c => c.points.at(-1) ?? {x: 0, y: 0});
  const at = stacked(ends.map(p => place(y, p.y) + 4), box.top + 8, box.bottom);
  const title = `${sweep.parameter}, ${sweep.unit ? sweep.unit : 'factor'}`;
  return s('svg', {width, height, viewBox: `0 0 ${width} ${height}`, role: 'img',
    'aria-label': `${yTitle} over ${title}: ${curves.map(c => c.name).join(', ')}`},
  frameOf(x, y, box, title, yTitle),
  ...curves.map((curve, i) => {
    const end = ends[i] ?? {x: 0, y: 0}, ex = place(x, end.x), ey = place(y, end.y), label = at[i] ?? ey;
    return s('g', {class: `style-${curve.style}`, 'data-method': curve.name},
      s('path', {class: 'curve', d: path(curve, x, y), 'stroke-dasharray': dashOf(curve.style)}),
      s('path', {class: 'lead', d: `M${ex + 6} ${ey}L${box.right + 14} ${label - 4}`}),
      ...curve.points.map(p => markAt(curve.style, place(x, p.x), place(y, p.y), `${curve.name}: ${figures(p.y)} at ${figures(p.x)}`)),
      s('text', {class: 'label', x: box.right + 18, y: label}, curve.name));
  }));
}

export function sweepPlots(results: Results): Plot[] {
  return (results.sweeps ?? []).flatMap(sweep => [
    {
      title: `Error over ${sweep.parameter}`,
      draw: (width: number, part: Part) => draw(
        curvesOf(results, sweep, m => part === 'penumbra' ? m.penumbra_rmse : m.rmse), sweep, width,
        part === 'penumbra' ? 'RMSE of the visible fraction in penumbrae' : 'RMSE of the visible fraction'),
    },
    {
      title: `Time over ${sweep.parameter}`,
      draw: (width: number) => draw(curvesOf(results, sweep, m => m.seconds), sweep, width, 'time, s'),
    },
  ]);
}
