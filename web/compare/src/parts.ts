import type {Results} from './results.js';
import type {Sources} from './sources.js';
import type {Store} from './state.js';
import type {LockedView, Size} from './view.js';
import type {VisibilityStore} from './visibility.js';

/** What every part of the page that shows pictures works with. */
export interface Parts {
  results: Results;
  picture: Size;
  store: Store;
  view: LockedView;
  data: VisibilityStore;
  sources: Sources;
}
