/** Binary frames: `uint16` channel, `uint16` kind, `uint32` count, `float64` stamp, payload at byte 16. */

/** One binary frame; the views on `buffer` begin at `offset`, which is a multiple of 16. */
export interface Frame {
  readonly channel: number;
  readonly kind: number;
  readonly count: number;
  /** Simulated time of the data, seconds. */
  readonly stamp_s: number;
  readonly buffer: ArrayBuffer;
  readonly offset: number;
}

const HEADER_BYTES = 16;

/** Reads the header of a frame; the payload is not copied. */
export function readFrame(buffer: ArrayBuffer): Frame {
  const view = new DataView(buffer);
  return {
    channel: view.getUint16(0, true),
    kind: view.getUint16(2, true),
    count: view.getUint32(4, true),
    stamp_s: view.getFloat64(8, true),
    buffer,
    offset: HEADER_BYTES,
  };
}

/** The payload as `float32`, from `skip` bytes after its beginning. */
export function floats(frame: Frame, length: number, skip = 0): Float32Array<ArrayBuffer> {
  return new Float32Array(frame.buffer, frame.offset + skip, length);
}

/** The payload as bytes. */
export function bytes(frame: Frame): Uint8Array<ArrayBuffer> {
  return new Uint8Array(frame.buffer, frame.offset);
}
