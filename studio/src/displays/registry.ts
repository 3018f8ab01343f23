/** All kinds of displays: rows of the server's table, each with its drawing. */
import type { Connection } from '../connection';
import { DISPLAY_ROWS, type DisplayName } from '../generated/displays';
import { DRAWINGS } from '../generated/drawings';
import type { AddedDisplays, DisplayRow } from '../generated/messages';
import { shortType } from '../graph_store';
import type { DisplayKind } from './display';

let kinds: readonly DisplayKind[] = kindsOf(Object.values(DISPLAY_ROWS));
let asked: Promise<readonly string[]> | null = null;

function kindsOf(rows: readonly DisplayRow[]): DisplayKind[] {
  return rows
    .map((row) => ({ ...row, ...DRAWINGS[row.drawn_as as DisplayName] }))
    .sort((a, b) => a.name.localeCompare(b.name));
}

/** All kinds that are known. */
export function displayKinds(): readonly DisplayKind[] {
  return kinds;
}

/** Ask once for what pip packages add; gives a sentence for each display that cannot be shown. */
export function learnAdded(connection: Connection): Promise<readonly string[]> {
  asked ??= connection.call('display.list').then((value) => {
    const added = value as unknown as AddedDisplays;
    kinds = kindsOf([...kinds, ...added.displays]);
    return added.problems;
  });
  asked.catch(() => {
    asked = null;
  });
  return asked;
}

/** The kind of a class as `.rviz` files write it: `rviz/LaserScan`, `rviz_default_plugins/LaserScan`. */
export function displayKind(name: string): DisplayKind | undefined {
  const own = name.split('/').pop() ?? name;
  return kinds.find((kind) => kind.name === own || kind.aliases.includes(own));
}

/** The kinds that show a type of message. */
export function kindsFor(type: string): readonly DisplayKind[] {
  const short = shortType(type);
  return kinds.filter((kind) => kind.types.includes(short));
}
