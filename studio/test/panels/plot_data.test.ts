import { expect, test } from 'vitest';
import { asCsv, Samples, thin } from '../../src/panels/plot_data';

function samplesOf(times: readonly number[], values: readonly (number | null)[]): Samples {
  const samples = new Samples();
  samples.add(times, values);
  return samples;
}

test('no sample has neither value nor time', () => {
  expect([new Samples().last(), new Samples().end()]).toEqual([NaN, -Infinity]);
});

test('samples outgrow their first room', () => {
  const times = Array.from({ length: 5000 }, (_, index) => index);
  const samples = samplesOf(times, times);
  expect([samples.length, samples.last(), samples.at(4321.5)]).toEqual([5000, 4999, 4322]);
});

test('time that jumps back starts anew, a little disorder does not', () => {
  const samples = samplesOf([10, 11, 10.8], [1, 2, 3]);
  expect(samples.length).toBe(3);
  samples.add([0.1], [4]);
  expect([samples.length, samples.last()]).toEqual([1, 4]);
});

test('of too many samples the newer half stays', () => {
  const times = Array.from({ length: 600_000 }, (_, index) => index);
  const samples = samplesOf(times, times);
  expect(samples.length).toBeLessThan(300_000);
  expect(samples.end()).toBe(599_999);
  expect(samples.at(599_000)).toBe(samples.length - 1000);
});

test('thinned samples keep every peak in its order', () => {
  const times = Array.from({ length: 1000 }, (_, index) => index);
  const values = times.map((time) => (time === 500 ? 9 : time === 503 ? -9 : 0));
  const [at, seen] = thin(samplesOf(times, values), 0, 1000, 100);
  expect(at.length).toBeLessThan(110);
  expect(seen.filter((value) => value !== 0)).toEqual([9, -9]);
  expect([...at].sort((a, b) => a - b)).toEqual(at);
});

test('few samples are not thinned, and gaps stay gaps', () => {
  expect(thin(samplesOf([0, 1, 2], [5, null, 7]), 0, 2, 100)).toEqual([
    [0, 1, 2],
    [5, null, 7],
  ]);
});

test('curves go into CSV by their times', () => {
  const text = asCsv([
    ['/a', samplesOf([0, 1], [1, 2])],
    ['/b[0],x', samplesOf([1, 0.5], [3, 4])],
  ]);
  expect(text).toBe('time,/a,"/b[0],x"\n0,1,\n0.5,,4\n1,2,3\n');
});
