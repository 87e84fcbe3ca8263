// The computing side of a picture: a session in the pool, made again when it is lost.
import { Client } from '../../../wasm/client.ts';
import type { MeshEvent } from '../../../wasm/events.ts';
import type { CrashError } from '../../../wasm/errors.ts';
import type { CallName, Calls, RunResult } from '../../../wasm/protocol.ts';
import type { MeshArrays, MeshSource, MetricSpec } from '../../../wasm/session.ts';
import { corePool } from './core_pool.ts';

export class Workshop {
  /** Called with the events of the present run. */
  onEvents: (events: MeshEvent[]) => void = () => undefined;
  onCrash: (error: CrashError) => void = () => undefined;

  /** Every metric is scaled to so many cells, if that is said. */
  targetCells: () => number | null = () => null;

  /** Connected when it is first needed. */
  private present: Client | null = null;
  private dimension = 2;
  /** What is open, to ask for it again. */
  private source: MeshSource | null = null;
  private metric: MetricSpec | null = null;
  private run: number | null = null;

  /** Frees the session. With the next call there is a new one, in which a mesh must be opened again. */
  restart(): void {
    this.run = null;
    this.present?.dispose();
    this.present = null;
  }

  call<N extends CallName>(
    name: N,
    args: Calls[N]['args'],
    transfer: Transferable[] = [],
  ): Promise<Calls[N]['result']> {
    return this.client.call(name, args, transfer);
  }

  async open(source: MeshSource, metric?: MetricSpec): Promise<MeshArrays> {
    const cells = this.targetCells();
    const mesh = await this.call('open', { source, ...(metric ? { metric } : {}), ...(cells ? { cells } : {}) });
    this.dimension = mesh.dim;
    this.source = source;
    this.metric = metric ?? null;
    this.run = null;
    return mesh;
  }

  async setMetric(metric: MetricSpec): Promise<void> {
    const cells = this.targetCells();
    await this.call('metric', cells ? { ...metric, cells } : metric);
    this.metric = metric;
    this.run = null;
  }

  /** The metric that is in force once more, after another number of cells was wished for. */
  async setMetricAgain(): Promise<void> {
    if (this.metric) await this.setMetric(this.metric);
    else if (this.source) await this.open(this.source);
  }

  get running(): boolean {
    return this.run !== null;
  }

  /** Runs to the end; null when another run or mesh has taken its place meanwhile. */
  async adapt(options: Record<string, string>): Promise<RunResult | null> {
    const id = this.client.nextId;
    this.run = id;
    try {
      const result = await this.call('run', { options });
      return this.run === id ? result : null;
    } finally {
      if (this.run === id) this.run = null;
    }
  }

  /** Ends the present run; what was recorded stays. */
  async stop(): Promise<void> {
    await this.call('cancel', {});
  }

  /** Ends the present run and drops what it still sends. */
  async abandon(): Promise<void> {
    if (this.run === null) return;
    this.run = null;
    await this.call('cancel', {});
  }

  private get client(): Client {
    return (this.present ??= this.connect());
  }

  private connect(): Client {
    const client = new Client(corePool().connect(), () => this.dimension);
    client.onEvents = (events, run) => {
      if (run === this.run) this.onEvents(events);
    };
    client.onCrash = (error) => {
      this.run = null;
      this.onCrash(error);
    };
    return client;
  }
}
