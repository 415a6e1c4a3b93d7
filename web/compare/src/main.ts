import {h} from './dom.js';
import {loupe} from './loupe.js';
import {foot, methods, sceneLine, sentence} from './methods.js';
import {plots} from './plots.js';
import {readResults, type Results} from './results.js';
import {sheet} from './sheet.js';
import {shownOf, Sources} from './sources.js';
import {stage} from './stage.js';
import {Store, type State} from './state.js';
import {lightTable, table} from './table.js';
import {LockedView} from './view.js';
import {furthestApart, Visibility, VisibilityStore} from './visibility.js';

/** The advised method against the reference, seen whole, the loupe in the middle. */
function startOf(results: Results): Store {
  const names = shownOf(results).map(shown => shown.name);
  const advised = results.advice?.method;
  const {width, height} = results.scene;
  return new Store({
    left: advised && names.includes(advised) ? advised : names[1] ?? results.reference.name,
    right: results.reference.name,
    kind: 'picture', light: null, divider: 0.5, zoom: 1, x: width / 2, y: height / 2,
    pixel: {x: Math.floor(width / 2), y: Math.floor(height / 2)}, pinned: false,
  });
}

function section(id: string, title: string, ...parts: (HTMLElement | null)[]): HTMLElement {
  return h('section', {'aria-labelledby': id}, h('h2', {id}, title), ...parts);
}

function build(results: Results, page: HTMLElement): void {
  const picture = {width: results.scene.width, height: results.scene.height};
  const store = startOf(results), redraw = (): void => { store.redraw(); };
  const view = new LockedView(store, picture), data = new VisibilityStore(redraw);
  const parts = {results, picture, store, view, data, sources: new Sources(results, data, redraw)};
  const aspect = Math.min(4, Math.max(0.6, picture.width / picture.height));
  document.title = `${results.scene.file}: soft shadows compared`;
  page.style.setProperty('--aspect', String(aspect));
  page.replaceChildren(
    h('header', {},
      h('h1', {}, results.scene.file),
      h('p', {class: 'scene'}, sceneLine(results)),
      results.advice ? h('p', {class: 'advice'}, sentence(results.advice.text)) : null),
    section('pictures', 'Pictures',
      h('div', {class: 'bench'}, stage(parts), loupe(parts)),
      sheet(parts)),
    section('numbers', 'Errors and costs', table(results), lightTable(results)),
    section('plots', 'Plots', plots(results)),
    section('about', 'Methods', methods(results)),
    h('footer', {'aria-labelledby': 'how'}, h('h2', {id: 'how'}, 'How this was made'), foot(results)));
  store.redraw();
  const middle = store.state.pixel;
  void data.load(shownOf(results)).then(() => { pointWhereTheyDiffer(results, store, data, middle); });
}

/** Puts the loupe, unless it has been moved, where the methods are furthest apart. */
function pointWhereTheyDiffer(results: Results, store: Store, data: VisibilityStore, middle: State['pixel']): void {
  const truth = data.get(results.reference.name);
  if (!(truth instanceof Visibility)) return;
  const pixel = furthestApart(truth, shownOf(results).map(shown => data.get(shown.name)).filter(one => one instanceof Visibility));
  if (pixel && store.state.pixel === middle) store.update({pixel});
}

const page = document.getElementById('page');
if (page) {
  try {
    build(readResults(document.getElementById('results')?.textContent ?? ''), page);
  } catch (problem) {
    page.replaceChildren(h('p', {class: 'advice'}, problem instanceof Error ? problem.message : String(problem)));
  }
}
