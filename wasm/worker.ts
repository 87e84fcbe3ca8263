// A module worker around sessions, each with a port: runs adaptations in slices so that they can be paused and
// cancelled, streams their events, and answers measurements between the slices. Where a page may not start workers, the
// same slices run in the page itself (pool.ts).
import { decodeEvents } from './events.ts';
import { writeFile } from './files.ts';
import { LoadError, modulesFrom, type Modules } from './loader.ts';
import { makeMetric } from './metrics.ts';
import type { CallName, Calls, Failure, Goodbye, Hello, Reply, Request, RunResult, Setup } from './protocol.ts';
import {
  CoreError,
  beginRun,
  cases,
  openSession,
  prepared,
  version,
  type Opened,
  type Options,
  type Session,
  type Specification,
} from './session.ts';

const sliceMilliseconds = 12;

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
        const { source, metric } = request.args;
        this.cancel();
        const opened = await openSession(this.modules, source, metric);
        this.replace({ ...opened, specification: { metric: opened.metric, options: {} } });
        return opened.session.mesh();
      }
      case 'metric':
        this.session().setMetric(request.args);
        this.cancel();
        this.present!.specification.metric = request.args;
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
    const specification = { ...this.present!.specification, options };
    const opened = await beginRun(this.modules, this.present!, specification);
    this.replace({ ...opened, specification });
    this.run = { id, session: opened.session, paused: false, cancelled: false, wake: () => undefined };
    return this.run;
  }

  /** Steps in slices until the run is over. */
  private async play(run: Run): Promise<RunResult> {
    const { id, session } = run;
    const started = performance.now();
    let events = 0;
    for (;;) {
      const end = performance.now() + sliceMilliseconds;
      let outcome = session.step();
      while (!outcome && performance.now() < end) outcome = session.step();
      events += this.post(id, session);
      if (outcome) {
        this.run = null;
        const seconds = (performance.now() - started) / 1000;
        return { outcome, events, seconds, report: session.report() };
      }
      await nextTask();
      while (run.paused && !run.cancelled) await new Promise<void>((resolve) => (run.wake = resolve));
      if (run.cancelled) {
        const outcome = { status: 'cancelled', message: 'The run was stopped.' } as const;
        const live = this.present?.session === session;
        if (this.run === run) this.run = null;
        return { outcome, events, seconds: (performance.now() - started) / 1000, report: live ? session.report() : '' };
      }
    }
  }

  private post(id: number, session: Session): number {
    const { ints, doubles } = session.takeEvents();
    if (ints.length === 0) return 0;
    const count = decodeEvents(session.dimension(), ints, doubles).length;
    this.port.postMessage({ type: 'events', id, ints, doubles }, [ints.buffer, doubles.buffer]);
    return count;
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
        const { ints, doubles } = again.takeEvents();
        count += decodeEvents(again.dimension(), ints, doubles).length;
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
