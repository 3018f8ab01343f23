/** Map: an occupancy grid as a texture, in RViz's three colour schemes. */
import * as THREE from 'three';
import { floats, type Frame } from '../frame';
import { place } from '../model/shapes';
import type { DisplayKind, Drawer, Site } from './display';
import { choice, flag, num } from './properties';

const HEADER_BYTES = 48;

/** RViz's Map. */
export const MAP: DisplayKind = {
  name: 'Map',
  about: 'An occupancy grid or a costmap.',
  types: ['nav_msgs/OccupancyGrid'],
  ownPose: true,
  properties: [
    num('Alpha', 0.7, 'How opaque the map is, 0 to 1.', { min: 0, max: 1 }),
    choice('Color Scheme', 'map', ['map', 'costmap', 'raw'], 'How values become colours.'),
    flag('Draw Behind', false, 'Draw everything else over the map.'),
  ],
  make: (site) => new MapDrawer(site),
};

class MapDrawer implements Drawer {
  private readonly material = new THREE.MeshBasicMaterial({ transparent: true, side: THREE.DoubleSide, depthWrite: false });
  private readonly mesh = new THREE.Mesh(new THREE.PlaneGeometry(1, 1).translate(0.5, 0.5, 0), this.material);
  private texture: THREE.DataTexture | null = null;
  private pixels = new Uint8Array(0);
  private values = new Int8Array(0);
  private width = 0;
  private height = 0;

  constructor(private readonly site: Site) {
    this.mesh.visible = false;
    this.mesh.renderOrder = -2;
    this.mesh.raycast = () => undefined;
    site.root.add(this.mesh);
  }

  frame(frame: Frame): void {
    const head = floats(frame, 8);
    const view = new DataView(frame.buffer, frame.offset + 28);
    const resolution = view.getFloat32(0, true);
    const width = view.getUint32(4, true);
    const height = view.getUint32(8, true);
    const { frames, status } = this.site;
    this.mesh.visible = !Number.isNaN(head[0]) && width > 0 && height > 0;
    if (Number.isNaN(head[0])) return status('Transform', 'error', `No transform to [${frames.fixed}]`);
    status('Transform', 'ok', 'Transform OK');
    if (!this.mesh.visible) return status('Map', 'error', `The map is empty (${width} x ${height})`);
    status('Map', 'ok', `Map received: ${width} x ${height} at ${resolution.toFixed(3)} m`);
    place(this.site.root, head);
    this.mesh.scale.set(width * resolution, height * resolution, 1);
    this.values = new Int8Array(frame.buffer, frame.offset + HEADER_BYTES, width * height);
    this.resize(width, height);
    this.paint();
    this.site.view.invalidate();
  }

  changed(path: string): void {
    this.material.opacity = this.site.props.num('Alpha');
    this.material.depthTest = !this.site.props.flag('Draw Behind');
    this.mesh.renderOrder = this.site.props.flag('Draw Behind') ? -50 : -2;
    if (path === 'Color Scheme') this.paint();
  }

  clear(): void {
    this.mesh.visible = false;
  }

  dispose(): void {
    this.texture?.dispose();
    this.material.dispose();
  }

  counts(): Record<string, number> {
    return { width: this.mesh.visible ? this.width : 0, height: this.mesh.visible ? this.height : 0 };
  }

  private resize(width: number, height: number): void {
    if (this.texture && width === this.width && height === this.height) return;
    this.texture?.dispose();
    [this.width, this.height] = [width, height];
    this.pixels = new Uint8Array(width * height * 4);
    this.texture = new THREE.DataTexture(this.pixels, width, height);
    this.material.map = this.texture;
    this.material.needsUpdate = true;
  }

  private paint(): void {
    if (!this.texture) return;
    const table = PALETTES[this.site.props.text('Color Scheme')] ?? PALETTES.map;
    const target = new Uint32Array(this.pixels.buffer);
    for (let i = 0; i < this.values.length; i++) target[i] = table[this.values[i] & 255];
    this.texture.needsUpdate = true;
  }
}

function palette(colour: (value: number) => [number, number, number, number]): Uint32Array {
  const table = new Uint32Array(256);
  const bytes = new Uint8Array(table.buffer);
  for (let value = 0; value < 256; value++) bytes.set(colour(value), value * 4);
  return table;
}

/** RViz's palettes: 0 to 100 known, 101 to 127 and 128 to 254 not legal, 255 unknown. */
const PALETTES: Record<string, Uint32Array> = {
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

function illegal(value: number, unknown: [number, number, number, number]): [number, number, number, number] {
  if (value === 255) return unknown;
  if (value <= 127) return [0, 255, 0, 255];
  return [255, (255 * (value - 128)) / 126, 0, 255];
}
