// Error against time, a mark for each method, and where `area` would reach the same error.
import {axis, frameOf, place, type Box} from './axes.js';
import {s} from './dom.js';
import {labels} from './labels.js';
import {markAt, styleOf} from './marks.js';
import {count, figures} from './numbers.js';
import type {Part, Plot} from './plots.js';
import {errorOf, secondsOf, type Results} from './results.js';

interface Point {
  name: string;
  style: number;
  error: number;
  seconds: number;
  area: {seconds: number; points: number | null} | null;
}

function pointsOf(results: Results, part: Part): Point[] {
  return results.methods.flatMap(method => {
    const error = errorOf[part](method), seconds = secondsOf(method);
    if (error === null || seconds === null) return [];
    const same = method.equal_area;
    // Its points were counted for the error in the penumbra.
    const area = part === 'penumbra' && method.name !== 'area' && same?.seconds ? {seconds: same.seconds, points: same.points} : null;
    return [{name: method.name, style: styleOf(results, method.name), error, seconds, area}];
  });
}

function draw(results: Results, width: number, part: Part): SVGSVGElement {
  const height = Math.round(Math.min(440, Math.max(300, width * 0.6)));
  const box: Box = {left: 52, right: width - 12, top: 30, bottom: height - 48};
  const points = pointsOf(results, part);
  const x = axis(points.flatMap(p => p.area ? [p.seconds, p.area.seconds] : [p.seconds]), true, box.left, box.right);
  const y = axis(points.map(p => p.error), true, box.bottom, box.top);
  const marks = points.map(p =>
    ({x: place(x, p.seconds), y: place(y, p.error), text: p.error > 0 ? p.name : `${p.name} (0)`}));
  const ends = points.map(p => p.area ? place(x, p.area.seconds) : null);
  const taken = marks.flatMap((m, i) => {
    const end = ends[i];
    return end == null ? [] : [{left: Math.min(m.x, end) - 7, right: Math.max(m.x, end) + 7, top: m.y - 6, bottom: m.y + 6}];
  });
  const names = labels(marks, {...box, left: box.left + 2}, taken);
  return s('svg', {width, height, viewBox: `0 0 ${width} ${height}`, role: 'img',
    'aria-label': `Error against time: ${points.map(p => `${p.name} ${figures(p.error)} in ${figures(p.seconds)} s`).join('; ')}`},
  frameOf(x, y, box, 'time, s', part === 'penumbra' ? 'RMSE of the visible fraction in penumbrae' : 'RMSE of the visible fraction'),
  ...points.flatMap((p, i) => {
    const at = marks[i], name = names[i], end = ends[i];
    if (!at || !name) return [];
    const leads = name.far ? [s('path', {class: 'lead', d: `M${at.x} ${at.y}L${name.x + (name.x < at.x ? 12 : 0)} ${name.y - 4}`})] : [];
    const same = end == null ? [] : [
      s('path', {class: 'same', d: `M${at.x} ${at.y}H${end}`}),
      markAt(p.style, end, at.y, `area with ${count(p.area?.points ?? null)} points: as near in ${figures(p.area?.seconds)} s`, true)];
    return [s('g', {class: `style-${p.style}`, 'data-method': p.name}, ...leads, ...same,
      markAt(p.style, at.x, at.y, `${p.name}: ${figures(p.error)} in ${figures(p.seconds)} s`),
      s('text', {class: 'label', x: name.x, y: name.y}, at.text))];
  }));
}

export function errorTime(results: Results): Plot {
  const exchanged = results.methods.some(m => m.equal_area?.seconds);
  return {
    title: 'Error against time',
    caption: 'Further down is nearer to the truth, further left is faster; both axes are logarithmic.' +
      (exchanged ? ' A line leads from each method to the time in which area reaches the same penumbra error (hollow mark).' : ''),
    draw: (width, part) => draw(results, width, part),
  };
}
