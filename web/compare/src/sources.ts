// Which file shows a method, and what is said where there is none.
import type {Results, Shown} from './results.js';
import type {Kind} from './state.js';

/** The file of a method's picture of this kind, or a sentence. */
export function sourceOf(shown: Shown, kind: Kind): {file: string} | {note: string} {
  const file = kind === 'picture' ? shown.picture : kind === 'visibility' ? shown.visibility : shown.error_map;
  if (file) return {file};
  if (kind === 'error' && shown.picture !== null) return {note: 'Errors are measured against this reference.'};
  return {note: `There is no picture of ${shown.name}.`};
}

/** The reference and every method that has pictures, in the order of the results. */
export function shownOf(results: Results): Shown[] {
  return [results.reference, ...results.methods.filter(method => method.status === 'ok')];
}

export function findShown(results: Results, name: string): Shown {
  return shownOf(results).find(shown => shown.name === name) ?? results.reference;
}
