// The table of methods, sorted by any column.
import {button, h} from './dom.js';
import {columns, type Column} from './columns.js';
import {count, fixed, percent} from './numbers.js';
import type {Method, Results} from './results.js';

type Order = 'ascending' | 'descending';

const byName: Column = {group: '', head: 'method', meaning: '', text: m => m.name, key: m => m.name};

/** Rows without a value go last in either order; equal ones keep the order of the results. */
export function sorted(methods: Method[], column: Column, order: Order): Method[] {
  const sign = order === 'ascending' ? 1 : -1;
  return [...methods].sort((a, b) => {
    const x = column.key(a), y = column.key(b);
    if (x === null || y === null) return Number(x === null) - Number(y === null);
    if (typeof x === 'string' || typeof y === 'string') return sign * String(x).localeCompare(String(y), 'en');
    return sign * (x - y);
  });
}

function bodyRow(method: Method): HTMLTableRowElement {
  const head = h('th', {scope: 'row'}, h('a', {href: `#method-${method.name}`}, method.name));
  if (method.status === 'ok')
    return h('tr', {'data-method': method.name}, head, ...columns.map(c => h('td', {}, c.text(method))));
  return h('tr', {'data-method': method.name, class: 'failed'}, head,
    h('td', {colspan: columns.length}, h('span', {}, `failed: ${method.reason ?? 'no reason was given'}`)));
}

function referenceRow({reference}: Results): HTMLTableRowElement {
  const text = `the truth here: ${count(reference.points_mean)} points a pixel in the mean, ` +
    `${fixed(reference.seconds, 1)} s${reference.cached ? ' (kept from an earlier run)' : ''}; standard error below ` +
    `${fixed(reference.target_standard_error, 3)} at ${percent(reference.share_within, 2)} % of pixels`;
  return h('tr', {}, h('th', {scope: 'row'}, reference.name), h('td', {colspan: columns.length}, h('span', {}, text)));
}

function groupCells(): HTMLTableCellElement[] {
  const cells: HTMLTableCellElement[] = [];
  let last: string | null = null;
  for (const {group} of columns) {
    const cell = cells.at(-1);
    if (cell && group === last) cell.colSpan += 1;
    else cells.push(group ? h('th', {scope: 'colgroup'}, group) : h('td'));
    last = group;
  }
  return cells;
}

function meanings(): HTMLElement {
  return h('details', {}, h('summary', {}, 'What the columns mean'),
    h('dl', {}, ...columns.flatMap(c => [
      h('dt', {}, c.group ? `${c.group}: ${c.head}` : c.head), h('dd', {}, c.meaning)])));
}

export function table(results: Results): HTMLElement {
  const body = h('tbody');
  const all = [byName, ...columns];
  const heads = all.map(c => h('th', {scope: 'col'}, button({}, () => { press(c); }, h('span', {class: 'order', 'aria-hidden': 'true'}), c.head)));
  let order: Order = 'ascending', by = columns[0] ?? byName;

  function draw(): void {
    body.replaceChildren(...sorted(results.methods, by, order).map(bodyRow));
    heads.forEach((head, i) => {
      if (all[i] === by) head.setAttribute('aria-sort', order);
      else head.removeAttribute('aria-sort');
    });
  }
  function press(column: Column): void {
    order = column === by && order === 'ascending' ? 'descending' : 'ascending';
    by = column;
    draw();
  }
  draw();
  return h('div', {},
    h('p', {class: 'caption'}, 'Errors are of the visible fraction, against the reference. Press a heading to sort.'),
    h('div', {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'Table of errors and costs'},
      h('table', {id: 'methods'},
        h('thead', {}, h('tr', {class: 'groups'}, h('td'), ...groupCells()), h('tr', {}, ...heads)),
        body, h('tfoot', {}, referenceRow(results)))),
    meanings());
}

/** Errors by light, where there are several. */
export function lightTable(results: Results): HTMLElement | null {
  const methods = results.methods.filter(m => m.lights !== null && m.lights.length > 1);
  const names = methods[0]?.lights?.map(l => l.name);
  if (!names) return null;
  return h('details', {}, h('summary', {}, 'Penumbra RMSE by light'),
    h('div', {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'Penumbra error by light'},
      h('table', {id: 'by-light'},
        h('thead', {}, h('tr', {}, h('th', {scope: 'col'}, 'method'), ...names.map(name => h('th', {scope: 'col'}, name)))),
        h('tbody', {}, ...methods.map(m => h('tr', {}, h('th', {scope: 'row'}, m.name),
          ...(m.lights ?? []).map(l => h('td', {}, fixed(l.penumbra.rmse, 4)))))))));
}
