/** Reads what `gazelle/studio/replay/packing.py` writes: a JSON head and packed whole numbers. */
import type { PageScene } from '../generated/messages';
import type { Pose } from '../model/pose';

/** Where an array is: offset, bytes, rows, columns, order of differences. */
export type Integers = [number, number, number, number, number];
/** Where bytes are: offset and length. */
export type Raw = [number, number];

export interface MeshHead {
  low: [number, number, number];
  step: number;
  vertices: Integers;
  normals: Integers;
  corners: Integers;
  uv?: Integers;
}

/** How a body moves: one pose, or whole numbers of steps for each frame. */
export interface TrackHead {
  pose?: Pose;
  places?: Integers;
  turns?: Integers;
  steps?: [number, number];
  /** The frames between which it is there: first, and behind the last. */
  there?: [number, number][];
}

/** A field of a topic over time. */
export interface ColumnHead {
  name: string;
  /** Of a number that never changes. */
  number?: number;
  /** Of a text that never changes. */
  text?: string;
  low?: number;
  step?: number;
  words?: string[];
  at?: Integers;
  /** Rows without a number. */
  gaps?: number[];
  /** Worked out here in place of being told. */
  values?: Float64Array;
}

export interface TopicHead {
  name: string;
  type: string;
  count: number;
  times: Integers;
  columns: ColumnHead[];
}

export interface ScanHead {
  topic: string;
  times: Integers;
  body: string;
  pose: Pose;
  angle_min: number;
  angle_step: number;
  range_step: number;
  beams: number;
  ranges: Integers;
}

export interface MapHead {
  topic: string;
  versions: {
    time_s: number;
    size: [number, number];
    resolution: number;
    pose: Pose;
    cells: Raw;
  }[];
}

export interface PathHead {
  topic: string;
  versions: { time_s: number; pose: Pose; step: number; points: Integers }[];
}

export interface Head {
  title: string;
  scene: PageScene;
  meshes: Record<string, MeshHead>;
  textures: Record<string, Raw>;
  tracks: TrackHead[];
  frames: { count: number; period_s: number; start_s: number; duration_s: number };
  topics: TopicHead[];
  drawings: { scans: ScanHead[]; maps: MapHead[]; paths: PathHead[] };
}

/** A recording whose arrays are read when they are asked for. */
export class Recording {
  readonly head: Head;
  private readonly bytes: Uint8Array<ArrayBuffer>;

  constructor(buffer: ArrayBuffer) {
    const length = new DataView(buffer).getUint32(0, true);
    this.head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length))) as Head;
    this.bytes = new Uint8Array(buffer, 4 + length);
  }

  /** Bytes as they are. */
  raw([offset, length]: Raw): Uint8Array<ArrayBuffer> {
    return this.bytes.subarray(offset, offset + length);
  }

  /** Whole numbers, row by row. */
  integers([offset, , rows, columns, order]: Integers): Float64Array {
    const found = new Float64Array(rows * columns);
    let at = offset;
    for (let column = 0; column < columns; column++) {
      let value = 0;
      let slope = 0;
      for (let row = 0; row < rows; row++) {
        let number = 0;
        let scale = 1;
        let group = this.bytes[at++];
        while (group >= 128) {
          number += (group - 128) * scale;
          scale *= 128;
          group = this.bytes[at++];
        }
        number += group * scale;
        const step = number % 2 ? -(number + 1) / 2 : number / 2;
        if (order === 2) {
          slope += step;
          value += slope;
        } else value += step;
        found[row * columns + column] = value;
      }
    }
    return found;
  }
}

/** The last place in rising numbers whose value is not above another; -1 before the first. */
export function lastBefore(values: ArrayLike<number>, value: number): number {
  let low = 0;
  let high = values.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle] <= value) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}
