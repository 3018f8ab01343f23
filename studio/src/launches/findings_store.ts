/** What the launches of the graph have found wrong, once for the badge and the panel. */

import type { Connection } from '../connection';
import type { FoundIn, LaunchFinding, LaunchValue } from '../generated/messages';
import { isObject } from '../json';

type Listener = () => void;
const stores = new WeakMap<Connection, FindingsStore>();

/** The store of a connection. */
export function findingsStore(connection: Connection): FindingsStore {
  let found = stores.get(connection);
  if (!found) {
    found = new FindingsStore(connection);
    stores.set(connection, found);
  }
  return found;
}

/** The newest launches of the graph with what they said, and who wants to know. */
export class FindingsStore {
  launches: readonly LaunchValue[] = [];
  private readonly listeners = new Set<Listener>();

  constructor(connection: Connection) {
    connection.open(
      'launch.findings',
      {},
      {
        onData: (value) => {
          if (!isObject(value)) return;
          this.launches = (value as unknown as FoundIn).launches;
          for (const listener of this.listeners) listener();
        },
      },
    );
  }

  /** Calls back at every change, and now. Returns what ends it. */
  watch(listener: Listener): () => void {
    this.listeners.add(listener);
    listener();
    return () => this.listeners.delete(listener);
  }

  /** How many there are of a severity. */
  count(severity: string): number {
    return this.launches
      .flatMap((launch) => launch.findings)
      .filter((finding) => finding.severity === severity).length;
  }
}

/** `2 errors, 1 warning`; empty when there is neither. */
export function inWords(errors: number, warnings: number): string {
  const part = (count: number, word: string): string[] =>
    count > 0 ? [`${count} ${word}${count === 1 ? '' : 's'}`] : [];
  return [...part(errors, 'error'), ...part(warnings, 'warning')].join(', ');
}

/** How a launch stands, in a few words. */
export function stateOf(launch: { is_running: boolean; code: number | null }): string {
  if (launch.is_running) return 'running';
  if (launch.code === null) return 'was killed';
  return launch.code === 0 || launch.code === 130 ? 'ended' : `failed with code ${launch.code}`;
}

/** A finding as the terminal has it, to be copied. */
export function asText(finding: LaunchFinding): string {
  const code = finding.code ? ` [${finding.code}]` : '';
  const lines = [
    `${finding.place ? `${finding.place}: ` : ''}${finding.severity}: ${finding.message}${code}`,
  ];
  const { source } = finding;
  if (source) {
    lines.push(`  ${String(source.line).padStart(5)} | ${source.text}`);
    if (source.column)
      lines.push(
        `  ${' '.repeat(5)} | ${' '.repeat(source.column - 1)}${'^'.repeat(source.width)}`,
      );
  }
  lines.push(...finding.via.map((place) => `  from ${place}`));
  if (finding.fix) lines.push(`  fix: ${finding.fix}`);
  return lines.join('\n');
}
