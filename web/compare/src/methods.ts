// What each method is, and the facts at the foot of the page.
import {copyLine, h, link} from './dom.js';
import {count, figures, fixed, percent} from './numbers.js';
import type {Method, Results} from './results.js';

function phases(method: Method): string | null {
  const parts = (method.cost?.phases ?? []).filter(p => p.seconds !== null);
  return parts.length === 0 ? null : parts.map(p => `${p.name} ${figures(p.seconds)} s`).join(', ');
}

function fact(term: string, text: string | null): HTMLElement[] {
  return text === null || text === '' ? [] : [h('dt', {}, term), h('dd', {}, text)];
}

function article(method: Method): HTMLElement {
  const done = method.conversions?.length ? method.conversions.join('; ') : null;
  return h('article', {id: `method-${method.name}`},
    h('h3', {}, method.name, method.title ? h('span', {class: 'title'}, method.title) : null),
    h('p', {}, method.summary ?? '', method.link === null ? null : ' ', method.link === null ? null : link(method.link, 'More about it')),
    method.status === 'ok' ? null : h('p', {class: 'failed'}, `It failed here: ${method.reason ?? 'no reason was given'}`),
    h('dl', {}, ...fact('Conversions', done), ...fact('Phases', phases(method))),
    method.command === null ? null : copyLine(method.command, `the command of ${method.name}`));
}

export function methods(results: Results): HTMLElement {
  return h('div', {class: 'articles'}, ...results.methods.map(article));
}

function machine(results: Results): string | null {
  const m = results.machine;
  if (!m) return null;
  return [m.processor, m.threads === null ? null : `${m.threads} threads`,
    m.memory_bytes === null ? null : `${fixed(m.memory_bytes / 1e9, 1)} GB`, m.system].filter(Boolean).join(', ');
}

export function foot(results: Results): HTMLElement {
  const r = results.reference;
  const versions = Object.entries(results.versions ?? {}).filter(([, v]) => v !== null).map(([k, v]) => `${k} ${v ?? ''}`);
  return h('div', {},
    h('dl', {class: 'facts'},
      ...fact('Reference', `area, ${count(r.points_mean)} points a pixel in the mean, ${count(r.points_most)} at most, ` +
        `${figures(r.seconds)} s${r.cached ? ', kept from an earlier run' : ''}`),
      ...fact('Its standard error', `below ${fixed(r.target_standard_error, 3)} at ${percent(r.share_within, 2)} % of pixels`),
      ...fact('Machine', machine(results)),
      ...fact('Versions', versions.join(', ')),
      ...fact('Scene checksum', results.scene.checksum)),
    results.command === null ? null : copyLine(results.command, 'the command of this page'),
    h('p', {}, link('results.json', 'results.json'), ' beside this page holds all of these numbers.'));
}

/** The advice as a sentence of its own. */
export function sentence(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1) + (/[.!?]$/.test(text) ? '' : '.');
}

/** The scene in one line. */
export function sceneLine(results: Results): string {
  const {width, height, camera, lights, objects, triangles} = results.scene;
  const many = (n: number | null, one: string): string | null => n === null ? null : `${count(n)} ${one}${n === 1 ? '' : 's'}`;
  const kinds = lights.map((l, i) => l.name?.startsWith(l.kind ?? '') ? l.name : l.name ? `${l.name}: ${l.kind ?? ''}` : l.kind ?? `light ${i + 1}`);
  const shown = kinds.length > 4 ? [...kinds.slice(0, 3), `${kinds.length - 3} more`] : kinds;
  return [`${width} × ${height} pixels`, camera ? /^camera/.test(camera) ? camera : `camera ${camera}` : null,
    `${many(lights.length, 'light') ?? ''}${lights.length ? ` (${shown.join(', ')})` : ''}`,
    many(objects, 'object'), triangles ? many(triangles, 'triangle') : null].filter(Boolean).join(' · ');
}
