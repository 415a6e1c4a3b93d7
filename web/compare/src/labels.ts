// Names beside marks, so that none covers another name or a mark.
import type {Box} from './axes.js';

export interface Mark {
  x: number;
  y: number;
  text: string;
}

export interface Label {
  /** Left end of the baseline. */
  x: number;
  y: number;
  /** The name stands so far from its mark that a line leads to it. */
  far: boolean;
}

const lineHeight = 15, ascent = 11, markReach = 8;

let canvas: CanvasRenderingContext2D | null = null;

/** Width of a text of the plots, in CSS pixels. */
export function textWidth(text: string): number {
  canvas ??= document.createElement('canvas').getContext('2d');
  if (!canvas) return 7 * text.length;
  canvas.font = `12px ${getComputedStyle(document.body).fontFamily}`;
  return canvas.measureText(text).width;
}

const overlap = (a: Box, b: Box): boolean =>
  a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

const boxOf = (x: number, y: number, width: number): Box =>
  ({left: x - 2, right: x + width + 2, top: y - ascent - 1, bottom: y - ascent + lineHeight});

/** Rings of places round the mark, the nearest first, right before left before above and below. */
function* places(mark: Mark, width: number): Generator<Label> {
  for (let ring = 0; ring < 14; ++ring) {
    const reach = 11 + 11 * ring;
    for (const angle of [0, 180, 270, 90, 330, 30, 210, 150, 300, 60, 240, 120]) {
      const dx = Math.cos(angle * Math.PI / 180), dy = Math.sin(angle * Math.PI / 180);
      const align = dx > 0.4 ? 0 : dx < -0.4 ? width : width / 2;
      yield {x: mark.x + reach * dx - align, y: mark.y + 4 + reach * dy * 1.1, far: ring > 1};
    }
  }
}

/** A place for each name inside `box`; `taken` are boxes that names keep clear of. */
export function labels(marks: Mark[], box: Box, taken: Box[]): Label[] {
  const used = [...taken, ...marks.map(({x, y}) =>
    ({left: x - markReach, right: x + markReach, top: y - markReach, bottom: y + markReach}))];
  return marks.map(mark => {
    const width = textWidth(mark.text);
    const inside = (b: Box): boolean =>
      b.left >= box.left && b.right <= box.right && b.top >= box.top && b.bottom <= box.bottom;
    let found: Label = {x: mark.x, y: mark.y, far: true};
    for (const label of places(mark, width)) {
      const wanted = boxOf(label.x, label.y, width);
      if (!inside(wanted) || used.some(other => overlap(wanted, other))) continue;
      found = label;
      break;
    }
    used.push(boxOf(found.x, found.y, width));
    return found;
  });
}

/** Heights of names at the ends of curves: in order, no closer than a line, inside top..bottom. */
export function stacked(heights: number[], top: number, bottom: number): number[] {
  const order = heights.map((_, i) => i).sort((a, b) => (heights[a] ?? 0) - (heights[b] ?? 0));
  const result = [...heights];
  let free = top;
  for (const i of order) free = (result[i] = Math.max(heights[i] ?? 0, free)) + lineHeight;
  let limit = bottom;
  for (const i of order.reverse()) limit = (result[i] = Math.min(result[i] ?? 0, limit)) - lineHeight;
  return result;
}
