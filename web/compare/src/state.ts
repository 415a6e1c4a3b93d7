// What the page shows now: one object that every part draws from.

export type Kind = 'picture' | 'visibility' | 'error';

export interface State {
  left: string;
  right: string;
  kind: Kind;
  /** Index of a light, or null for the mean over all. */
  light: number | null;
  /** Where the divider stands, 0 (left) to 1. */
  divider: number;
  /** 1 fits the picture into its frame. */
  zoom: number;
  /** Centre of what is seen, in pixels of the picture. */
  x: number;
  y: number;
  /** The pixel under the loupe; it stays where it is while pinned. */
  pixel: {x: number; y: number};
  pinned: boolean;
}

/** Holds the state and has it drawn, at most once a frame. */
export class Store {
  private readonly drawers: ((state: Readonly<State>) => void)[] = [];
  private asked = false;

  constructor(private current: State) {}

  get state(): Readonly<State> {
    return this.current;
  }

  onDraw(drawer: (state: Readonly<State>) => void): void {
    this.drawers.push(drawer);
  }

  update(change: Partial<State>): void {
    this.current = {...this.current, ...change};
    this.redraw();
  }

  redraw(): void {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      for (const draw of this.drawers) draw(this.current);
    });
  }
}
