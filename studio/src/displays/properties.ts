/** Properties of a display, under RViz's names; `Covariance/Position/Alpha` lies three deep. */
import { parseColour } from '../model/materials';
import { isObject, type Json, type JsonObject } from '../json';

export type PropertyKind =
  | 'bool'
  | 'number'
  | 'colour'
  | 'choice'
  | 'text'
  | 'topic'
  | 'frame'
  | 'vector';

/** One property: its path, its default, and how it is edited. */
export interface PropertySpec {
  path: string;
  kind: PropertyKind;
  value: Json;
  about: string;
  options?: readonly string[];
  min?: number;
  max?: number;
  /** Message types of a topic, as `sensor_msgs/LaserScan`. */
  types?: readonly string[];
  /** The server acts on it: it goes along with the stream's parameters. */
  server?: boolean;
}

type Extra = Partial<PropertySpec>;

/** A switch. */
export const flag = (
  path: string,
  value: boolean,
  about: string,
  extra: Extra = {},
): PropertySpec => ({ path, kind: 'bool', value, about, ...extra });
/** A number. */
export const num = (
  path: string,
  value: number,
  about: string,
  extra: Extra = {},
): PropertySpec => ({ path, kind: 'number', value, about, ...extra });
/** A colour as RViz writes it: `255; 85; 0`. */
export const colour = (
  path: string,
  value: string,
  about: string,
  extra: Extra = {},
): PropertySpec => ({ path, kind: 'colour', value, about, ...extra });
/** One of several words. */
export const choice = (
  path: string,
  value: string,
  options: readonly string[],
  about: string,
  extra: Extra = {},
): PropertySpec => ({ path, kind: 'choice', value, options, about, ...extra });
/** A text. */
export const text = (
  path: string,
  value: string,
  about: string,
  extra: Extra = {},
): PropertySpec => ({ path, kind: 'text', value, about, ...extra });

/** The values of a display's properties. */
export class Properties {
  private readonly values = new Map<string, Json>();
  readonly specs: PropertySpec[] = [];

  constructor(specs: readonly PropertySpec[]) {
    specs.forEach((spec) => this.add(spec));
  }

  /** Add a property that was not known before (a namespace, a link). True if it is new. */
  add(spec: PropertySpec): boolean {
    if (this.specs.some((each) => each.path === spec.path)) return false;
    this.specs.push(spec);
    if (!this.values.has(spec.path)) this.values.set(spec.path, spec.value);
    return true;
  }

  get(path: string): Json {
    return this.values.get(path) ?? null;
  }

  num(path: string): number {
    const value = Number(this.get(path));
    return Number.isFinite(value) ? value : 0;
  }

  flag(path: string): boolean {
    const value = this.get(path);
    return value === true || value === 'true';
  }

  text(path: string): string {
    const value = this.get(path);
    return value === null ? '' : String(value);
  }

  colour(path: string): [number, number, number] {
    return parseColour(this.text(path));
  }

  set(path: string, value: Json): void {
    this.values.set(path, value);
  }

  /** What the server needs to know, by the property's own name. */
  forServer(): JsonObject {
    const found: JsonObject = {};
    for (const spec of this.specs) {
      if (spec.server) found[spec.path.split('/').pop() as string] = this.get(spec.path);
    }
    return found;
  }

  /** Values that differ from the defaults, by path: what a layout keeps. */
  toObject(): JsonObject {
    const found: JsonObject = {};
    for (const spec of this.specs) {
      const value = this.get(spec.path);
      if (JSON.stringify(value) !== JSON.stringify(spec.value)) found[spec.path] = value;
    }
    return found;
  }

  /** Take values of a `.rviz` file or a layout; names that no spec has are kept for later ones. */
  fromObject(values: JsonObject, prefix = ''): void {
    for (const [name, value] of Object.entries(values)) {
      const path = prefix + name;
      if (!isObject(value)) {
        if (path.endsWith('/Value') && this.specs.some((s) => s.path === path.slice(0, -6)))
          this.set(path.slice(0, -6), value);
        else this.set(path, value);
      } else this.fromObject(value, `${path}/`);
    }
  }
}
