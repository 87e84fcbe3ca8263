// Undo and redo. A link holds all of the page's state, so that earlier states are earlier links.

const longest = 200;

export class History {
  private readonly links: string[] = [];
  private at = -1;
  private readonly show: (link: string) => void;

  constructor(show: (link: string) => void) {
    this.show = show;
  }

  /** The state has settled at `link`. What had been undone is forgotten, unless it is the same. */
  record(link: string): void {
    if (link === this.links[this.at]) return;
    this.links.splice(this.at + 1, Infinity, link);
    if (this.links.length > longest) this.links.shift();
    this.at = this.links.length - 1;
  }

  undo(): boolean {
    return this.go(-1);
  }

  redo(): boolean {
    return this.go(1);
  }

  get canUndo(): boolean {
    return this.at > 0;
  }

  get canRedo(): boolean {
    return this.at < this.links.length - 1;
  }

  private go(by: 1 | -1): boolean {
    const link = this.links[this.at + by];
    if (link === undefined) return false;
    this.at += by;
    this.show(link);
    return true;
  }
}
