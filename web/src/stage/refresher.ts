// Keeps something derived up to date without falling behind: one job under way at a time, the newest state wins.

export class Refresher {
  private wanted = false;
  private busy = false;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private readonly job: () => Promise<void>;

  /** `job` looks at the state as it is when its turn comes. A job that fails leaves things as they were. */
  constructor(job: () => Promise<void>) {
    this.job = job;
  }

  /** Runs the job once more, in `wait` milliseconds at the earliest. */
  request(wait: number): void {
    this.wanted = true;
    this.timer ??= setTimeout(() => {
      this.timer = undefined;
      void this.next();
    }, wait);
  }

  private async next(): Promise<void> {
    if (this.busy || !this.wanted) return;
    this.busy = true;
    this.wanted = false;
    try {
      await this.job();
    } catch {
      // Told elsewhere: a refused request by its caller, a lost worker by the client's onCrash.
    } finally {
      this.busy = false;
    }
    if (this.wanted) this.request(0);
  }
}
