// The page's end of a session: calls as promises, events as a callback.
import { CoreError, CrashError, LoadError } from './errors.ts';
import { decodeEvents, type MeshEvent } from './events.ts';
import type { Connection } from './pool.ts';
import type { CallName, Calls, Failure, Reply, Request } from './protocol.ts';

function toError(failure: Failure): Error {
  switch (failure.kind) {
    case 'refused':
      return new CoreError(failure.status ?? 'illegal', failure.message);
    case 'load':
      return new LoadError(failure.reason ?? 'broken', failure.message);
    case 'crashed':
      return new CrashError(failure.message);
  }
}

interface Waiting {
  resolve(result: unknown): void;
  reject(error: Error): void;
}

/** Talks to one session. After a crash every call is rejected; make a new client. */
export class Client {
  /** Called with the events of a run and the number of its request. */
  onEvents: (events: MeshEvent[], run: number) => void = () => undefined;
  /** Called once when the session is lost. */
  onCrash: (error: CrashError) => void = () => undefined;

  private readonly connection: Promise<Connection>;
  private readonly waiting = new Map<number, Waiting>();
  private readonly dimension: () => number;
  private next = 1;
  private lost: CrashError | null = null;

  /** `dimension` tells the dimension of the mesh that events belong to. */
  constructor(connection: Promise<Connection>, dimension: () => number) {
    this.connection = connection;
    this.dimension = dimension;
    connection.then(
      (open) => {
        open.onmessage = ({ data }) => this.receive(data);
        open.onlost = (error) => this.lose(error);
      },
      (error: unknown) => this.lose(new CrashError(error)),
    );
  }

  /** Number that the next call will have: a run's events carry it. */
  get nextId(): number {
    return this.next;
  }

  call<N extends CallName>(
    name: N,
    args: Calls[N]['args'],
    transfer: Transferable[] = [],
  ): Promise<Calls[N]['result']> {
    if (this.lost) return Promise.reject(this.lost);
    const id = this.next++;
    const request = { id, name, args } as Request;
    return new Promise<Calls[N]['result']>((resolve, reject) => {
      this.waiting.set(id, { resolve: resolve as (result: unknown) => void, reject });
      this.connection.then((open) => open.postMessage(request, transfer)).catch(reject);
    });
  }

  dispose(): void {
    this.hangUp();
    this.lost ??= new CrashError('the session was closed');
    this.rejectAll(this.lost);
  }

  private receive(reply: Reply): void {
    if (reply.type === 'events') {
      this.onEvents(decodeEvents(this.dimension(), reply.ints, reply.doubles), reply.id);
      return;
    }
    const waiting = this.waiting.get(reply.id);
    this.waiting.delete(reply.id);
    if (reply.type === 'answer') {
      waiting?.resolve(reply.result);
    } else {
      const error = toError(reply.failure);
      waiting?.reject(error);
      if (error instanceof CrashError) this.lose(error);
    }
  }

  private lose(error: CrashError): void {
    if (this.lost) return;
    this.lost = error;
    this.hangUp();
    this.rejectAll(error);
    this.onCrash(error);
  }

  private hangUp(): void {
    this.connection.then((open) => open.close()).catch(() => undefined);
  }

  private rejectAll(error: Error): void {
    for (const { reject } of this.waiting.values()) reject(error);
    this.waiting.clear();
  }
}
