// A module worker around sessions, each with a port: runs adaptations in slices so that they can be paused and
// cancelled, streams their events, and answers measurements between the slices. Where a page may not start workers, the
// same slices run in the page itself (pool.ts).
import { CoreError, LoadError } from './errors.ts';
import { countEvents } from './events.ts';
import { writeFile } from './files.ts';
import { modulesFrom, type Modules } from './loader.ts';
import { makeMetric } from './metrics.ts';
import type { CallName, Calls, Failure, Goodbye, Hello, Reply, Request, RunResult, Setup } from './protocol.ts';
import {
  beginRun,
  cases,
  openSession,
  prepared,
  version,
  type Opened,
  type Options,
  type Outcome,
  type Session,
  type Specification,
} from './session.ts';

const sliceMilliseconds = 12;
/** As many runs are made at most to meet a number of cells. */
const mostTrials = 10;

type Recorded = ReturnType<Session['takeEvents']>;

/** The session, and what it was made of: enough to make it again. */
interface Present extends Opened {
  specification: Specification;
}

interface Run {
  id: number;
  session: Session;
  paused: boolean;
  cancelled: boolean;
  wake: () => void;
}

/** The part of a worker's global scope that is used here. */
interface Port {
  postMessage(message: Reply, transfer: Transferable[]): void;
}

/** Lets waiting messages in, without the 4 ms that nested timers cost. */
function nextTask(): Promise<void> {
  return new Promise((resolve) => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => {
      port1.close();
      resolve();
    };
    port2.postMessage(null);
  });
}

function toFailure(error: unknown): Failure {
  if (error instanceof CoreError) return { kind: 'refused', message: error.message, status: error.status };
  if (error instanceof LoadError) return { kind: 'load', message: error.message, reason: error.reason };
  return { kind: 'crashed', message: error instanceof Error ? error.message : String(error) };
}

function transferables(result: unknown): Transferable[] {
  if (ArrayBuffer.isView(result)) return [result.buffer as ArrayBuffer];
  if (result === null || typeof result !== 'object') return [];
  return Object.values(result)
    .filter((v) => ArrayBuffer.isView(v))
    .map((v) => v.buffer as ArrayBuffer);
}

/** Answers requests. `post` sends a reply with its transferables. */
export class Server {
  private readonly port: Port;
  private readonly modules: Modules;
  /** Settled when what was asked for so far has its core: one may wait for its module while other requests come in. */
  private opened: Promise<unknown> = Promise.resolve();
  private present: Present | null = null;
  private run: Run | null = null;

  constructor(port: Port, modules: Modules) {
    this.port = port;
    this.modules = modules;
  }

  async handle(request: Request): Promise<void> {
    try {
      const result = await this.answer(request);
      this.port.postMessage({ type: 'answer', id: request.id, result }, transferables(result));
    } catch (error) {
      this.port.postMessage({ type: 'failure', id: request.id, failure: toFailure(error) }, []);
    }
  }

  /** Ends the run and frees the session. */
  close(): void {
    this.cancel();
    this.present?.session.destroy();
    this.present = null;
  }

  /** Begins in the order of the requests; a run's answer comes when it is over. */
  private answer(request: Request): Promise<Calls[CallName]['result']> {
    const queue = <T>(work: () => Promise<T>): Promise<T> => {
      const done = this.opened.then(work);
      this.opened = done.catch(() => undefined); // told to its own request
      return done;
    };
    if (request.name === 'run')
      return queue(() => this.begin(request.id, request.args.options)).then((run) => this.play(run));
    if (request.name === 'open') return queue(() => this.perform(request));
    return this.opened.then(() => this.perform(request));
  }

  private async perform(request: Exclude<Request, { name: 'run' }>): Promise<Calls[CallName]['result']> {
    switch (request.name) {
      case 'about': {
        const core = await this.modules.core(2);
        return { version: version(core), cases: cases(core) };
      }
      case 'open': {
        const { source, metric, cells } = request.args;
        this.cancel();
        const opened = await openSession(this.modules, source, metric, cells);
        this.replace({ ...opened, specification: { metric: opened.metric, options: {} } });
        return opened.session.mesh();
      }
      case 'metric':
        this.session().setMetric(request.args);
        this.cancel();
        this.present!.metric = this.present!.specification.metric = request.args;
        return null;
      case 'makeMetric': {
        this.session(); // there must be a mesh: as it was opened, not what a run has made of it
        const { core, source } = this.present!;
        const original = prepared(core, source, { options: {} }).session;
        const mesh = original.input();
        original.destroy();
        return makeMetric(await this.modules.metrics(), mesh, request.args);
      }
      case 'pause':
        if (this.run) this.run.paused = true;
        return null;
      case 'resume':
        if (this.run) {
          this.run.paused = false;
          this.run.wake();
        }
        return null;
      case 'cancel':
        this.cancel();
        return null;
      case 'measure': {
        const { points, cells, lengths } = request.args;
        const shapes = this.session().cellShapes(points, cells);
        if (!lengths) return { shapes, edges: new Int32Array(0), lengths: new Float64Array(0) };
        return { shapes, ...this.session().edgeLengths(points, cells) };
      }
      case 'tensors':
        return this.session().tensors(request.args.points);
      case 'write':
        return this.write(request.args.name, request.args.events);
      case 'report':
        return this.session().report();
    }
  }

  private session(): Session {
    if (!this.present) throw new CoreError('usage', 'No mesh is open.');
    return this.present.session;
  }

  private replace(present: Present): void {
    this.present?.session.destroy();
    this.present = present;
  }

  private cancel(): void {
    if (!this.run) return;
    this.run.cancelled = true;
    this.run.wake();
  }

  /** Options start from their defaults every time. */
  private async begin(id: number, options: Options): Promise<Run> {
    this.session();
    this.cancel();
    const specification = { metric: this.present!.metric, options };
    const opened = await beginRun(this.modules, this.present!, specification);
    this.replace({ ...opened, specification });
    this.run = { id, session: opened.session, paused: false, cancelled: false, wake: () => undefined };
    return this.run;
  }

  /** Steps in slices until the run is over; where it misses the number of cells that was asked for, with other sizes again. */
  private async play(run: Run): Promise<RunResult> {
    const started = performance.now();
    let events = 0;
    const post = ({ ints, doubles }: Recorded): void => {
      if (ints.length === 0) return;
      events += countEvents(run.session.dimension(), ints);
      this.port.postMessage({ type: 'events', id: run.id, ints, doubles }, [ints.buffer, doubles.buffer]);
    };
    const target = this.target();
    const outcome = target ? await this.meet(target, run, post) : await this.advance(run, post);
    if (this.run === run) this.run = null;
    const live = outcome !== null || this.present?.session === run.session;
    const report = live ? run.session.report() : '';
    const seconds = (performance.now() - started) / 1000;
    return { outcome: outcome ?? { status: 'cancelled', message: 'The run was stopped.' }, events, seconds, report };
  }

  /** The number of cells that was asked for, where layers alone do not meet it: full adaptation of quads does. */
  private target(): number | undefined {
    const { metric, session, specification } = this.present!;
    return session.dimension() === 3 || specification.options.method === 'paper' ? metric?.cells : undefined;
  }

  /**
   * Runs to the end with one factor on all sizes after the other, until there are so many cells, to 5 %. Hands the events of
   * the nearest run over, and leaves its session. Null when it was cancelled before.
   */
  private async meet(target: number, run: Run, post: (recorded: Recorded) => void): Promise<Outcome | null> {
    const dimension = run.session.dimension();
    let [low, high, at] = [-20, 20, 0]; // logarithms of the factor
    let best: { present: Present; outcome: Outcome; miss: number; held: Recorded[] } | null = null;
    for (let trial = 1; trial <= mostTrials; ++trial) {
      if (trial > 1) this.setOut(run, Math.exp(at), best?.present);
      const held: Recorded[] = [];
      const outcome = await this.advance(run, (recorded) => held.push(recorded));
      if (!outcome) {
        if (best && best.present !== this.present) best.present.session.destroy();
        return null;
      }
      const ratio = (JSON.parse(run.session.report()) as { mesh: { cells: number } }).mesh.cells / target;
      const miss = Math.abs(ratio - 1);
      if (!best || miss < best.miss) {
        best?.present.session.destroy();
        best = { present: this.present!, outcome, miss, held };
      }
      if (best.miss <= 0.05) break;
      if (ratio > 1) low = at;
      else high = at;
      at += Math.log(ratio) / dimension;
      if (!(at > low && at < high)) at = (low + high) / 2;
    }
    if (this.present !== best!.present) this.replace(best!.present);
    run.session = best!.present.session;
    best!.held.forEach(post);
    return best!.outcome;
  }

  /** The same run from its start, with all sizes as asked times a factor; the session before is freed unless it is kept. */
  private setOut(run: Run, scale: number, kept?: Present): void {
    const { core, source, metric, specification } = this.present!;
    const next = { ...specification, metric: { ...metric!, scale } };
    const { session } = prepared(core, source, next);
    session.begin();
    if (this.present !== kept) this.present!.session.destroy();
    this.present = { core, source, metric, session, specification: next };
    run.session = session;
  }

  /** Steps in slices to the end; null when it was cancelled before. */
  private async advance(run: Run, take: (recorded: Recorded) => void): Promise<Outcome | null> {
    const { session } = run;
    for (;;) {
      const end = performance.now() + sliceMilliseconds;
      let outcome = session.step();
      while (!outcome && performance.now() < end) outcome = session.step();
      take(session.takeEvents());
      if (outcome) return outcome;
      await nextTask();
      while (run.paused && !run.cancelled) await new Promise<void>((resolve) => (run.wake = resolve));
      if (run.cancelled) return null;
    }
  }

  /** An earlier mesh is made again from the recipe: runs are deterministic. */
  private async write(name: string, events?: number): Promise<Uint8Array> {
    const files = name.endsWith('.json') ? null : await this.modules.files();
    const content = (session: Session): Uint8Array =>
      files ? writeFile(files, name, session.input()) : new TextEncoder().encode(session.report());
    if (events === undefined) return content(this.session());
    this.session();
    const { core, source, specification } = this.present!;
    const again = prepared(core, source, specification).session;
    try {
      let count = 0;
      if (events > 0) again.begin();
      while (count < events && !again.step()) {
        count += countEvents(again.dimension(), again.takeEvents().ints);
      }
      return content(again);
    } finally {
      again.destroy();
    }
  }
}

/** Answers a port's requests with a session of its own until it says goodbye. */
function serve(port: MessagePort, modules: Modules): void {
  const server = new Server(port, modules);
  port.onmessage = ({ data }: MessageEvent<Request | Goodbye>) => {
    if (!('type' in data)) return void server.handle(data);
    server.close();
    port.close();
  };
}

/** A session in the page itself, for pool.ts. */
export function serverInPage(post: (reply: Reply) => void, modules: Setup['modules']): Server {
  return new Server({ postMessage: post }, modulesFrom(modules));
}

/** `self` of a dedicated worker, without the DOM library's conflicting declaration of `self`. */
interface WorkerScope {
  onmessage: ((event: { data: Setup }) => void) | null;
  postMessage(message: Hello): void;
}

if (typeof document === 'undefined' && typeof self !== 'undefined' && 'postMessage' in self) {
  const scope = self as unknown as WorkerScope;
  scope.onmessage = ({ data: { port, modules } }) => serve(port, modulesFrom(modules));
  scope.postMessage({ type: 'hello' });
}
