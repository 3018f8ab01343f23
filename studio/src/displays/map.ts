/** Map: an occupancy grid as a texture, in RViz's three colour schemes. */
import * as THREE from 'three';
import { floats, type Frame } from '../binary_frame';
import { place } from '../model/shapes';
import type { Drawing, Drawer, Site } from './display';
import { Swatches, type Look } from './map_swatches';
import { choice, flag, num } from './properties';

const HEADER_BYTES = 64;
/** The kind of frames that bring a part. */
const PART = 30;

/** RViz's Map. */
export const MAP: Drawing = {
  ownPose: true,
  properties: [
    num('Alpha', 0.7, 'How opaque the map is, 0 to 1.', { min: 0, max: 1 }),
    choice('Color Scheme', 'map', ['map', 'costmap', 'raw'], 'How values become colours.'),
    flag('Draw Behind', false, 'Draw everything else over the map.'),
  ],
  make: (site) => new MapDrawer(site),
};

class MapDrawer implements Drawer {
  private readonly swatches: Swatches;
  private number = 0;

  constructor(private readonly site: Site) {
    this.swatches = new Swatches(site.view.renderer, this.look());
    this.swatches.root.visible = false;
    site.root.add(this.swatches.root);
  }

  frame(frame: Frame): void {
    const head = floats(frame, 8);
    const [width, height, number, x, y, columns, rows] = new Uint32Array(
      frame.buffer,
      frame.offset + 32,
      7,
    );
    const { frames, status } = this.site;
    const { root } = this.swatches;
    // A part of a grid that was shown before, of another topic.
    if (frame.kind === PART && number !== this.number) return;
    root.visible = !Number.isNaN(head[0]) && width > 0 && height > 0;
    if (Number.isNaN(head[0]))
      return status('Transform', 'error', `No transform to [${frames.fixed}]`);
    status('Transform', 'ok', 'Transform OK');
    if (!root.visible) return status('Map', 'error', `The map is empty (${width} x ${height})`);
    status('Map', 'ok', `Map received: ${width} x ${height} at ${head[7].toFixed(3)} m`);
    place(this.site.root, head);
    root.scale.set(head[7], head[7], 1);
    this.number = number;
    this.swatches.resize(width, height);
    this.swatches.put(
      { x, y, width: columns, height: rows },
      new Uint8Array(frame.buffer, frame.offset + HEADER_BYTES, columns * rows),
    );
    this.site.view.invalidate();
  }

  changed(): void {
    this.swatches.restyle(this.look());
  }

  clear(): void {
    this.swatches.root.visible = false;
    this.number = 0;
  }

  dispose(): void {
    this.swatches.dispose();
  }

  counts(): Record<string, number> {
    const { root, width, height } = this.swatches;
    const known = root.visible ? this.swatches.count((value) => value <= 100) : 0;
    return { width: root.visible ? width : 0, height: root.visible ? height : 0, known };
  }

  private look(): Look {
    const { props } = this.site;
    const palette = PALETTES[props.text('Color Scheme')] ?? PALETTES.map;
    return { alpha: props.num('Alpha'), palette, behind: props.flag('Draw Behind') };
  }
}

function palette(colour: (value: number) => [number, number, number, number]): THREE.DataTexture {
  const bytes = new Uint8Array(4 * 256);
  for (let value = 0; value < 256; value++) bytes.set(colour(value), value * 4);
  const texture = new THREE.DataTexture(bytes, 256, 1);
  texture.needsUpdate = true;
  return texture;
}

/** RViz's palettes: 0 to 100 known, 101 to 127 and 128 to 254 not legal, 255 unknown. */
const PALETTES: Record<string, THREE.DataTexture> = {
  map: palette((v) => {
    if (v <= 100) return [255 - (255 * v) / 100, 255 - (255 * v) / 100, 255 - (255 * v) / 100, 255];
    return illegal(v, [0x70, 0x89, 0x86, 255]);
  }),
  costmap: palette((v) => {
    if (v === 0) return [0, 0, 0, 0];
    if (v <= 98) return [(255 * v) / 100, 0, 255 - (255 * v) / 100, 255];
    if (v === 99) return [0, 255, 255, 255];
    if (v === 100) return [255, 0, 255, 255];
    return illegal(v, [0x70, 0x89, 0x86, 255]);
  }),
  raw: palette((v) => [v, v, v, 255]),
};

function illegal(
  value: number,
  unknown: [number, number, number, number],
): [number, number, number, number] {
  if (value === 255) return unknown;
  if (value <= 127) return [0, 255, 0, 255];
  return [255, (255 * (value - 128)) / 126, 0, 255];
}
