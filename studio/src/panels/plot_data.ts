/** The samples of curves: kept in order of time, thinned out for drawing, written as CSV. */

import { csvField } from '../widgets/format';

const FIRST_CAPACITY = 1024;
const MOST_SAMPLES = 200_000;

/** The samples of one curve. */
export class Samples {
  t = new Float64Array(FIRST_CAPACITY);
  v = new Float64Array(FIRST_CAPACITY);
  length = 0;

  /** Adds samples; time that jumps back (a reset world, a bag from its beginning) starts anew. */
  add(times: readonly number[], values: readonly (number | null)[]): void {
    for (let index = 0; index < times.length; index += 1) {
      const time = times[index];
      if (this.length > 0 && time < this.t[this.length - 1] - 0.5) this.length = 0;
      if (this.length === this.t.length) this.makeRoom();
      this.t[this.length] = time;
      this.v[this.length] = values[index] ?? NaN;
      this.length += 1;
    }
  }

  /** Forgets all samples. */
  clear(): void {
    this.length = 0;
  }

  /** The newest value; NaN without one. */
  last(): number {
    return this.length > 0 ? this.v[this.length - 1] : NaN;
  }

  /** The newest time; -Infinity without one. */
  end(): number {
    return this.length > 0 ? this.t[this.length - 1] : -Infinity;
  }

  /** The index of the first sample not before a time. */
  at(time: number): number {
    let low = 0;
    let high = this.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.t[middle] < time) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  private makeRoom(): void {
    if (this.length >= MOST_SAMPLES) {
      const kept = this.length >> 1;
      this.t.copyWithin(0, this.length - kept, this.length);
      this.v.copyWithin(0, this.length - kept, this.length);
      this.length = kept;
      return;
    }
    this.t = doubled(this.t);
    this.v = doubled(this.v);
  }
}

function doubled(values: Float64Array<ArrayBuffer>): Float64Array<ArrayBuffer> {
  const larger = new Float64Array(values.length * 2);
  larger.set(values);
  return larger;
}

/**
 * The samples from one time to another in at most about `most` points: of every piece of time the
 * least and the greatest value stay, so that no peak is lost.
 */
export function thin(
  samples: Samples,
  from: number,
  to: number,
  most: number,
): [number[], (number | null)[]] {
  const first = Math.max(0, samples.at(from) - 1);
  const last = Math.min(samples.length, samples.at(to) + 1);
  const step = Math.max(1, Math.ceil((2 * (last - first)) / most));
  const times: number[] = [];
  const values: (number | null)[] = [];
  const take = (index: number) => {
    times.push(samples.t[index]);
    values.push(Number.isFinite(samples.v[index]) ? samples.v[index] : null);
  };
  for (let at = first; at < last; at += step) {
    const end = Math.min(at + step, last);
    let low = at;
    let high = at;
    for (let index = at; index < end; index += 1) {
      const value = samples.v[index];
      if (value < samples.v[low] || Number.isNaN(samples.v[low])) low = index;
      if (value > samples.v[high] || Number.isNaN(samples.v[high])) high = index;
    }
    take(Math.min(low, high));
    if (low !== high) take(Math.max(low, high));
  }
  return [times, values];
}

/** All samples as CSV: one row per time, one column per curve. */
export function asCsv(curves: readonly (readonly [string, Samples])[]): string {
  const rows = new Map<number, (number | string)[]>();
  curves.forEach(([, samples], column) => {
    for (let index = 0; index < samples.length; index += 1) {
      const row = rows.get(samples.t[index]) ?? Array<string>(curves.length).fill('');
      row[column] = samples.v[index];
      rows.set(samples.t[index], row);
    }
  });
  const lines = [...rows].sort(([a], [b]) => a - b).map(([time, row]) => [time, ...row].join(','));
  return [['time', ...curves.map(([name]) => csvField(name))].join(','), ...lines, ''].join('\n');
}
