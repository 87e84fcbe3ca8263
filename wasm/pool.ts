// Sessions spread over a few workers that all pages' figures share; without workers they run in the page, in slices.
import { CrashError } from './errors.ts';
import type { Goodbye, Hello, Reply, Request, Setup } from './protocol.ts';

/** Both directions of one session's messages. */
export interface Connection {
  postMessage(message: Request, transfer: Transferable[]): void;
  onmessage: ((event: { data: Reply }) => void) | null;
  /** The worker died under the session. */
  onlost: ((error: CrashError) => void) | null;
  /** Frees the session; what it still sends is not heard. */
  close(): void;
}

/** A worker and the sessions in it. */
interface Host {
  worker: Promise<Worker>;
  connections: Set<Connection>;
}

/** What a page takes of worker.ts. */
export type ServerCode = Pick<typeof import('./worker.ts'), 'serverInPage'>;

export class Pool {
  private readonly hosts: Host[] = [];
  private readonly makeWorker: () => Worker;
  private readonly modules: Promise<Setup['modules']>;
  private readonly most: number;
  private readonly loadServer: () => Promise<ServerCode>;
  /** How the last session was connected: what tests and curious visitors may ask. */
  place: 'worker' | 'page' | null = null;

  /**
   * No more than `most` workers are started; `makeWorker` may throw. `loadServer` gets the worker's code for a session in
   * the page, when that is needed.
   */
  constructor(
    makeWorker: () => Worker,
    modules: Promise<Setup['modules']>,
    most: number,
    loadServer: () => Promise<ServerCode>,
  ) {
    this.makeWorker = makeWorker;
    this.modules = modules;
    this.most = most;
    this.loadServer = loadServer;
  }

  /** Starts a worker for the first session, before that is asked for. */
  warm(): void {
    if (this.hosts.length === 0) this.choose();
  }

  /** A new session: in a worker with few others or, where none can be started, in the page itself. */
  async connect(): Promise<Connection> {
    const host = this.choose();
    const place = {} as Connection; // holds the session's place while the worker starts
    host.connections.add(place);
    try {
      const worker = await host.worker;
      this.place = 'worker';
      return this.within(worker, host, await this.modules);
    } catch {
      this.drop(host); // the next session tries again
      this.place = 'page';
      return await this.inPage();
    } finally {
      host.connections.delete(place);
    }
  }

  private choose(): Host {
    const least = this.hosts.reduce<Host | null>(
      (best, host) => (best && best.connections.size <= host.connections.size ? best : host),
      null,
    );
    if (least && (least.connections.size === 0 || this.hosts.length >= this.most)) return least;
    const host: Host = { worker: started(this.makeWorker), connections: new Set() };
    this.hosts.push(host);
    host.worker.then(
      (worker) => (worker.onerror = (event) => this.lose(host, event.message)),
      () => undefined,
    );
    return host;
  }

  private within(worker: Worker, host: Host, modules: Setup['modules']): Connection {
    const { port1, port2 } = new MessageChannel();
    const setup: Setup = { type: 'connect', port: port2, modules };
    worker.postMessage(setup, [port2]);
    const connection: Connection = {
      postMessage: (message, transfer) => port1.postMessage(message, transfer),
      onmessage: null,
      onlost: null,
      close: () => {
        if (!host.connections.delete(connection)) return;
        port1.postMessage({ type: 'goodbye' } satisfies Goodbye);
        port1.close();
      },
    };
    port1.onmessage = ({ data }: MessageEvent<Reply>) => connection.onmessage?.({ data });
    host.connections.add(connection);
    return connection;
  }

  private async inPage(): Promise<Connection> {
    const { serverInPage } = await this.loadServer();
    const connection: Connection = {
      postMessage: (message) => void server.handle(message),
      onmessage: null,
      onlost: null,
      close: () => {
        connection.onmessage = null;
        server.close();
      },
    };
    const server = serverInPage((data) => connection.onmessage?.({ data }), await this.modules);
    return connection;
  }

  private lose(host: Host, message: string): void {
    this.drop(host);
    for (const connection of host.connections) connection.onlost?.(new CrashError(message || 'the worker failed'));
  }

  private drop(host: Host): void {
    const at = this.hosts.indexOf(host);
    if (at >= 0) this.hosts.splice(at, 1);
    host.worker.then((worker) => worker.terminate()).catch(() => undefined);
  }
}

/** A worker that has said hello; rejected when it cannot be started. */
function started(make: () => Worker): Promise<Worker> {
  return new Promise((resolve, reject) => {
    const worker = make();
    worker.onerror = (event) => {
      event.preventDefault?.();
      worker.terminate();
      reject(new Error(event.message || 'the worker could not be started'));
    };
    worker.onmessage = ({ data }: MessageEvent<Hello>) => {
      if (data.type !== 'hello') return;
      worker.onmessage = worker.onerror = null;
      resolve(worker);
    };
  });
}
