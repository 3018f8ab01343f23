/** A message as rows of a tree: names, values and the path that a plot understands. */

import { isObject, type Json } from '../json';
import { short } from './format';

/** One row of a message. */
export interface MessageRow {
  /** `/odom/pose/pose/position/x` or `/joint_states/position[2]`. */
  path: string;
  name: string;
  depth: number;
  value: string;
  /** Has rows of its own. */
  branch: boolean;
  expanded: boolean;
  numeric: boolean;
}

const MOST_ITEMS = 200;

/** The rows of a value, its own fields only; those below `expanded` paths too. */
export function messageRows(
  value: Json,
  path: string,
  depth: number,
  expanded: ReadonlySet<string>,
  rows: MessageRow[] = [],
): MessageRow[] {
  for (const [name, child, childPath] of childrenOf(value, path)) {
    const branch = isBranch(child);
    const open = branch && expanded.has(childPath);
    rows.push({
      path: childPath,
      name,
      depth,
      value: branch ? summary(child) : leafText(child),
      branch,
      expanded: open,
      numeric: typeof child === 'number' || typeof child === 'boolean',
    });
    if (open) messageRows(child, childPath, depth + 1, expanded, rows);
  }
  return rows;
}

function childrenOf(value: Json, path: string): [string, Json, string][] {
  const items = cutItems(value) ?? (Array.isArray(value) ? value : null);
  if (items)
    return items
      .slice(0, MOST_ITEMS)
      .map((item, index) => [`[${index}]`, item, `${path}[${index}]`]);
  if (isObject(value))
    return Object.entries(value).map(([name, item]) => [name, item, `${path}/${name}`]);
  return [];
}

/** The head of an array that the server has cut: `{"…": length, "head": […]}`. */
function cutItems(value: Json): Json[] | null {
  return isObject(value) && '…' in value && Array.isArray(value.head) ? value.head : null;
}

function isBranch(value: Json): boolean {
  if (Array.isArray(value)) return value.length > 0;
  return isObject(value) && Object.keys(value).length > 0;
}

/** What a branch shows in one line. */
function summary(value: Json): string {
  const cut = cutItems(value);
  if (cut && isObject(value)) return `${String(value['…'])} items: ${preview(cut)}`;
  if (Array.isArray(value)) return `${value.length} items: ${preview(value)}`;
  return '';
}

function preview(items: Json[]): string {
  if (items.some((item) => isObject(item) || Array.isArray(item))) return '…';
  return `[${items.slice(0, 8).map(leafText).join(', ')}${items.length > 8 ? ', …' : ''}]`;
}

/** A value in one line. */
export function leafText(value: Json): string {
  if (typeof value === 'number') return short(value);
  if (typeof value === 'string') return value;
  if (value === null) return 'nan';
  if (typeof value === 'boolean') return value ? 'True' : 'False';
  return Array.isArray(value) ? '[]' : '{}';
}

/** A whole value as text, indented as YAML is. */
export function asYaml(value: Json, indent = ''): string {
  if (!isBranch(value)) return typeof value === 'string' ? JSON.stringify(value) : leafText(value);
  const entries = childrenOf(value, '');
  const list = Array.isArray(value) || cutItems(value) !== null;
  return entries
    .map(([name, child]) => {
      const lead = list ? '-' : `${name}:`;
      const deeper = isBranch(child);
      return `${indent}${lead}${deeper ? '\n' : ' '}${asYaml(child, `${indent}  `)}`;
    })
    .join('\n');
}
