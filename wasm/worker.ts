// A module worker around one session: runs adaptations in slices so that it can be paused and cancelled, streams their
// events, and answers measurements between the slices.
import { decodeEvents } from './events.ts';
import { CrashError, LoadError, loadCore, type Core } from './loader.ts';
import type { CallName, Calls, Failure, Reply, Request, RunResult, Setup } from './protocol.ts';
import { CoreError, Session, cases, version, type MeshSource, type MetricSpec, type Options } from './session.ts';

const sliceMilliseconds = 12;

/** What the session was made of: enough to make it again. */
interface Recipe {
  source: MeshSource;
  metric?: MetricSpec;
  options: Options;
}

interface Run {
  id: number;
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
  private readonly core: Promise<Core>;
  private session: Session | null = null;
  private recipe: Recipe | null = null;
  private run: Run | null = null;

  constructor(port: Port, core: Promise<Core>) {
    this.port = port;
    this.core = core;
    core.catch(() => undefined); // told to each request instead
  }

  async handle(request: Request): Promise<void> {
    try {
      const result = await this.answer(request);
      this.port.postMessage({ type: 'answer', id: request.id, result }, transferables(result));
    } catch (error) {
      this.port.postMessage({ type: 'failure', id: request.id, failure: toFailure(error) }, []);
    }
  }

  private async answer(request: Request): Promise<Calls[CallName]['result']> {
    const core = await this.core;
    switch (request.name) {
      case 'about':
        return { version: version(core), cases: cases(core) };
      case 'open': {
        this.cancel();
        const next = this.make(core, { ...request.args, options: {} });
        this.session?.destroy();
        this.session = next;
        this.recipe = { ...request.args, options: {} };
        return next.mesh();
      }
      case 'metric':
        this.opened().setMetric(request.args);
        this.cancel();
        this.recipe!.metric = request.args;
        return null;
      case 'run':
        return this.adapt(core, request.id, request.args.options);
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
        const shapes = this.opened().cellShapes(points, cells);
        return {
          shapes,
          lengths: lengths ? this.opened().edgeLengths(points, cells).lengths : new Float64Array(0),
        };
      }
      case 'tensors':
        return this.opened().tensors(request.args.points);
      case 'write':
        return this.write(core, request.args.name, request.args.events);
      case 'report':
        return this.opened().report();
    }
  }

  private opened(): Session {
    if (!this.session) throw new CoreError('usage', 'No mesh is open.');
    return this.session;
  }

  private make(core: Core, recipe: Recipe): Session {
    const session = new Session(core);
    try {
      session.load(recipe.source);
      if (recipe.metric) session.setMetric(recipe.metric);
      for (const [name, value] of Object.entries(recipe.options)) session.setOption(name, value);
      return session;
    } catch (error) {
      if (!(error instanceof CrashError)) session.destroy();
      throw error;
    }
  }

  private cancel(): void {
    if (!this.run) return;
    this.run.cancelled = true;
    this.run.wake();
  }

  /** Steps in slices until the run is over. Options start from their defaults every time. */
  private async adapt(core: Core, id: number, options: Options): Promise<RunResult> {
    this.opened();
    this.cancel();
    const recipe: Recipe = { ...this.recipe!, options };
    const session = this.make(core, recipe);
    this.session!.destroy();
    this.session = session;
    this.recipe = recipe;

    const run: Run = { id, paused: false, cancelled: false, wake: () => undefined };
    this.run = run;
    const started = performance.now();
    let events = 0;
    session.begin();
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
        const live = this.session === session;
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
  private write(core: Core, name: string, events?: number): Uint8Array {
    const content = (session: Session): Uint8Array =>
      name.endsWith('.json') ? new TextEncoder().encode(session.report()) : session.write(name);
    if (events === undefined) return content(this.opened());
    this.opened();
    const again = this.make(core, this.recipe!);
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

/** Connects a server to the worker's own scope; the first message says where the core is. */
export function serve(scope: DedicatedWorkerGlobalScopeLike): void {
  let server: Server | null = null;
  scope.onmessage = ({ data }) => {
    if ('type' in data) server = new Server(scope, loadCore(data.core));
    else void server?.handle(data);
  };
}

/** `self` of a dedicated worker, without the DOM library's conflicting declaration of `self`. */
export interface DedicatedWorkerGlobalScopeLike extends Port {
  onmessage: ((event: { data: Setup | Request }) => void) | null;
}

if (typeof document === 'undefined' && typeof self !== 'undefined' && 'postMessage' in self)
  serve(self as unknown as DedicatedWorkerGlobalScopeLike);
