// Plots that are drawn anew when their width or what they show changes.
import {choice, h} from './dom.js';
import {errorTime} from './error_time.js';
import type {Results} from './results.js';
import {sweepPlots} from './sweeps.js';

export type Part = 'penumbra' | 'all';

export interface Plot {
  title: string;
  caption?: string;
  draw: (width: number, part: Part) => SVGSVGElement;
}

function figure(plot: Plot, part: () => Part): {element: HTMLElement; redraw: () => void} {
  const holder = h('div', {class: 'plot'});
  let drawn = 0;
  const redraw = (): void => {
    drawn = Math.floor(holder.clientWidth);
    if (drawn > 0) holder.replaceChildren(plot.draw(drawn, part()));
  };
  new ResizeObserver(() => { if (Math.floor(holder.clientWidth) !== drawn) redraw(); }).observe(holder);
  return {element: h('figure', {}, h('h3', {}, plot.title), holder,
    plot.caption === undefined ? null : h('figcaption', {}, plot.caption)), redraw};
}

export function plots(results: Results): HTMLElement {
  let part: Part = 'penumbra';
  const figures = [errorTime(results), ...sweepPlots(results)].map(plot => figure(plot, () => part));
  return h('div', {},
    choice('Error over', [['penumbra', 'Penumbra'], ['all', 'Whole picture']], part, value => {
      part = value as Part;
      for (const f of figures) f.redraw();
    }),
    h('div', {class: 'plots'}, ...figures.map(f => f.element)));
}
