/** The config package that is being made: what the server has of it, and changes of its parts. */
import type { Connection } from '../connection';
import type { AssistantValue } from '../generated/messages';
import type { Json, JsonObject } from '../json';

/** A part that `setup_assistant.edit` takes. */
export type Part =
  | 'author'
  | 'controllers'
  | 'end_effectors'
  | 'groups'
  | 'interfaces'
  | 'package_name'
  | 'pairs'
  | 'passive_joints'
  | 'states'
  | 'virtual_joints';

/** What steps share. */
export class Session {
  value: AssistantValue | null = null;
  private readonly listeners = new Set<() => void>();

  constructor(
    private readonly connection: Connection,
    private readonly fail: (problem: unknown) => void,
  ) {}

  /** Hear of every change. */
  watch(listener: () => void): void {
    this.listeners.add(listener);
  }

  /** Begin with a robot's file or a config package; true when that went well. */
  async load(params: JsonObject): Promise<boolean> {
    return this.take(this.ask('setup_assistant.load', params));
  }

  /** Put another value into a part; what cannot be is told, and the old value shown again. */
  async edit(part: Part, value: unknown): Promise<boolean> {
    if (!this.value) return false;
    const { session } = this.value;
    const took = await this.take(
      this.ask('setup_assistant.edit', { session, part, value: value as Json }),
    );
    if (!took) this.tell();
    return took;
  }

  /** Find the pairs that need no check; `told` hears how far that is, 0 to 1. */
  async findPairs(trials: number, told: (done: number) => void): Promise<boolean> {
    if (!this.value) return false;
    const { session } = this.value;
    const timer = setInterval(() => {
      this.connection
        .call('setup_assistant.progress', { session })
        .then((done) => told(Number(done)))
        .catch(() => undefined);
    }, 300);
    try {
      return await this.take(this.ask('setup_assistant.find_pairs', { session, trials }));
    } finally {
      clearInterval(timer);
    }
  }

  /** End the search for pairs. */
  stop(): void {
    if (this.value)
      void this.ask('setup_assistant.progress', { session: this.value.session, stop: true });
  }

  /** Ask the server; null when that failed, which is told. */
  async ask(method: string, params: JsonObject = {}): Promise<Json> {
    try {
      return await this.connection.call(method, params);
    } catch (problem) {
      this.fail(problem);
      return null;
    }
  }

  private async take(answer: Promise<Json>): Promise<boolean> {
    const value = await answer;
    if (value === null) return false;
    this.value = value as unknown as AssistantValue;
    this.tell();
    return true;
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }
}
