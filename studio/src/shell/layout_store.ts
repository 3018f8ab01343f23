/** Named layouts: with the server where it keeps them, in the browser otherwise. */

import type { Connection } from '../connection';
import { isObject, textsOf, type Json, type JsonObject } from '../json';

const PREFIX = 'gazelle.layout.';
const LAST = 'gazelle.last.';
const TAB = 'gazelle.tab';

/** Saves, loads, lists and deletes named layouts. */
export class LayoutStore {
  constructor(private readonly connection: Connection) {}

  /** All names, sorted. */
  async list(): Promise<string[]> {
    const names = new Set(this.localNames());
    try {
      for (const name of namesIn(await this.connection.call('layout.list'))) names.add(name);
    } catch {
      // A server without a configuration folder: what the browser keeps is all there is.
    }
    return [...names].sort((a, b) => a.localeCompare(b));
  }

  /** A layout by name; null when there is none. */
  async load(name: string): Promise<Json> {
    try {
      const value = await this.connection.call('layout.load', { name });
      if (value !== null) return isObject(value) && 'value' in value ? value.value : value;
    } catch {
      // Falls through to the browser's own copy.
    }
    return read(PREFIX + name);
  }

  /** Keeps a layout; answers where: with the server, or in this browser only. */
  async save(name: string, value: JsonObject): Promise<'server' | 'browser'> {
    localStorage.setItem(PREFIX + name, JSON.stringify(value));
    try {
      await this.connection.call('layout.save', { name, value });
      return 'server';
    } catch {
      return 'browser';
    }
  }

  /** Forgets a layout. */
  async delete(name: string): Promise<void> {
    localStorage.removeItem(PREFIX + name);
    await this.connection.call('layout.delete', { name }).catch(() => null);
  }

  /** What was open the last time the same commands opened the page. */
  last(commands: readonly string[]): Json {
    return read(LAST + key(commands));
  }

  /** What was open in this tab before it was reloaded. */
  tab(): { commands: string[]; layout: Json } | null {
    const kept = parsed(sessionStorage.getItem(TAB));
    return isObject(kept)
      ? { commands: textsOf(kept, 'commands'), layout: kept.layout ?? null }
      : null;
  }

  /** Keeps what is open for the next time. */
  keepLast(commands: readonly string[], value: JsonObject): void {
    sessionStorage.setItem(TAB, JSON.stringify({ commands: [...commands], layout: value }));
    localStorage.setItem(LAST + key(commands), JSON.stringify(value));
  }

  /** Forgets what was open. */
  forgetLast(commands: readonly string[]): void {
    sessionStorage.removeItem(TAB);
    localStorage.removeItem(LAST + key(commands));
  }

  private localNames(): string[] {
    return Object.keys(localStorage)
      .filter((each) => each.startsWith(PREFIX))
      .map((each) => each.slice(PREFIX.length));
  }
}

function key(commands: readonly string[]): string {
  return [...new Set(commands)].sort().join('+') || 'studio';
}

function read(name: string): Json {
  return parsed(localStorage.getItem(name));
}

/** What cannot be read counts as nothing kept. */
function parsed(text: string | null): Json {
  if (text === null) return null;
  try {
    return JSON.parse(text) as Json;
  } catch {
    return null;
  }
}

function namesIn(value: Json): string[] {
  const list = isObject(value) ? value.names : value;
  return Array.isArray(list) ? list.filter((each): each is string => typeof each === 'string') : [];
}
