import { expect, test } from 'vitest';
import { bytes, floats, readFrame } from '../src/binary_frame';

/** A frame as the server packs it: little-endian, payload at byte 16. */
function packed(payload: readonly number[]): ArrayBuffer {
  const buffer = new ArrayBuffer(16 + 4 * payload.length);
  const view = new DataView(buffer);
  view.setUint16(0, 513, true);
  view.setUint16(2, 7, true);
  view.setUint32(4, 70_000, true);
  view.setFloat64(8, 12.5, true);
  payload.forEach((value, index) => view.setFloat32(16 + 4 * index, value, true));
  return buffer;
}

test('the header is little-endian', () => {
  const { channel, kind, count, stamp_s } = readFrame(packed([]));
  expect({ channel, kind, count, stamp_s }).toEqual({
    channel: 513,
    kind: 7,
    count: 70_000,
    stamp_s: 12.5,
  });
});

test('the payload begins behind the header, and may be read from farther on', () => {
  const frame = readFrame(packed([1, -2, 0.5]));
  expect([...floats(frame, 3)]).toEqual([1, -2, 0.5]);
  expect([...floats(frame, 2, 4)]).toEqual([-2, 0.5]);
  expect(bytes(frame).length).toBe(12);
});

test('the payload is not copied', () => {
  const frame = readFrame(packed([1]));
  expect(floats(frame, 1).buffer).toBe(frame.buffer);
});

test('a payload shorter than its header says is refused', () => {
  expect(() => floats(readFrame(packed([1])), 2)).toThrow(RangeError);
});
