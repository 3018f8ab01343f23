/** Scans, maps, paths and the robots' trails, drawn at a time. */
import * as THREE from 'three';
import type { Assembly } from '../model/assembly';
import { place } from '../model/shapes';
import type { Motion } from './motion';
import {
  lastBefore,
  type MapHead,
  type PathHead,
  type Recording,
  type ScanHead,
} from './unpacking';

const SCAN = 0xff3b30;
const PATH = 0x1fb35b;
const TRAILS = [0x1e88e5, 0xf2a65a, 0xb596ff, 0x49c78e];
const ABOVE_M = 0.006;
const OLD_S = 1.5;

/** Something that is drawn as it was at a time. */
export interface Drawn {
  /** Of what, for the menu. */
  readonly kind: 'Scans' | 'Maps' | 'Paths' | 'Trails';
  readonly root: THREE.Object3D;
  look(time_s: number): void;
}

/** All that a recording has to draw beside bodies. */
export function drawings(recording: Recording, motion: Motion, assembly: Assembly): Drawn[] {
  const { scans, maps, paths } = recording.head.drawings;
  return [
    ...scans.map((head) => new Scan(recording, head, assembly)),
    ...maps.map((head) => new Grid(recording, head)),
    ...paths.map((head) => new Path(recording, head)),
    ...trails(recording, motion),
  ];
}

class Scan implements Drawn {
  readonly kind = 'Scans';
  readonly root = new THREE.Group();
  private readonly ranges: Float64Array;
  private readonly times: Float64Array;
  private readonly points: Float32Array;
  private readonly cloud: THREE.Points;
  private readonly body: THREE.Object3D | null;
  private shown = -1;

  constructor(
    recording: Recording,
    private readonly head: ScanHead,
    assembly: Assembly,
  ) {
    this.ranges = recording.integers(head.ranges);
    this.times = recording.integers(head.times).map((value) => value * 1e-6);
    this.points = new Float32Array(head.beams * 3);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(this.points, 3));
    const material = new THREE.PointsMaterial({ color: SCAN, size: 4, sizeAttenuation: false });
    this.cloud = new THREE.Points(geometry, material);
    this.cloud.frustumCulled = false;
    this.body = assembly.bodies.find((one) => one.value.name === head.body)?.root ?? null;
    this.root.add(this.cloud);
  }

  look(time_s: number): void {
    const row = lastBefore(this.times, time_s + 1e-9);
    this.cloud.visible = row >= 0 && time_s - this.times[row] < OLD_S && this.body !== null;
    if (!this.cloud.visible || row === this.shown) return;
    this.shown = row;
    const { beams, angle_min, angle_step, range_step } = this.head;
    let count = 0;
    for (let beam = 0; beam < beams; beam++) {
      const range = this.ranges[row * beams + beam] * range_step;
      if (range <= 0) continue;
      const angle = angle_min + beam * angle_step;
      this.points.set([range * Math.cos(angle), range * Math.sin(angle), 0], 3 * count++);
    }
    this.cloud.geometry.setDrawRange(0, count);
    this.cloud.geometry.getAttribute('position').needsUpdate = true;
    // Where the laser was when it was measured, so that walls stand still.
    this.body?.updateWorldMatrix(true, false);
    place(this.cloud, this.head.pose);
    this.cloud.updateMatrix();
    if (this.body) this.cloud.matrix.premultiply(this.body.matrixWorld);
    this.cloud.matrix.decompose(this.cloud.position, this.cloud.quaternion, this.cloud.scale);
  }
}

class Grid implements Drawn {
  readonly kind = 'Maps';
  readonly root = new THREE.Group();
  private readonly made = new Map<number, THREE.Object3D>();

  constructor(
    private readonly recording: Recording,
    private readonly head: MapHead,
  ) {}

  look(time_s: number): void {
    const times = this.head.versions.map((one) => one.time_s);
    const number = lastBefore(times, time_s + 1e-9);
    let shown = this.made.get(number);
    if (!shown && number >= 0) {
      shown = this.sheet(number);
      this.made.set(number, shown);
      this.root.add(shown);
    }
    for (const [key, one] of this.made) one.visible = key === number;
  }

  private sheet(number: number): THREE.Object3D {
    const { size, resolution, pose, cells } = this.head.versions[number];
    const values = this.recording.raw(cells);
    const pixels = new Uint8Array(values.length * 4);
    values.forEach((value, i) => {
      const grey = value > 100 ? 128 : 255 - Math.round(value * 2.55);
      pixels.set([grey, grey, grey, value > 100 ? 40 : 110 + value], 4 * i);
    });
    const texture = new THREE.DataTexture(pixels, size[0], size[1]);
    texture.needsUpdate = true;
    const [width, height] = [size[0] * resolution, size[1] * resolution];
    const geometry = new THREE.PlaneGeometry(width, height).translate(
      width / 2,
      height / 2,
      ABOVE_M,
    );
    const material = new THREE.MeshBasicMaterial({
      map: texture,
      transparent: true,
      side: THREE.DoubleSide,
      depthWrite: false,
      polygonOffset: true,
      polygonOffsetFactor: -1,
    });
    const sheet = new THREE.Mesh(geometry, material);
    // Below trails and paths.
    sheet.renderOrder = -2;
    place(sheet, pose);
    return sheet;
  }
}

class Path implements Drawn {
  readonly kind = 'Paths';
  readonly root = new THREE.Group();
  private readonly line = new THREE.Line(
    new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({ color: PATH, transparent: true }),
  );
  private shown = -1;

  constructor(
    private readonly recording: Recording,
    private readonly head: PathHead,
  ) {
    this.line.frustumCulled = false;
    this.root.add(this.line);
  }

  look(time_s: number): void {
    const times = this.head.versions.map((one) => one.time_s);
    const number = lastBefore(times, time_s + 1e-9);
    this.line.visible = number >= 0;
    if (number < 0 || number === this.shown) return;
    this.shown = number;
    const { pose, points, step } = this.head.versions[number];
    const places = Float32Array.from(this.recording.integers(points), (value) => value * step);
    for (let i = 2; i < places.length; i += 3) places[i] += 2 * ABOVE_M;
    this.line.geometry.dispose();
    this.line.geometry = new THREE.BufferGeometry();
    this.line.geometry.setAttribute('position', new THREE.BufferAttribute(places, 3));
    place(this.line, pose);
  }
}

/** The way of each model that moves, on the ground, up to the time. */
function trails(recording: Recording, motion: Motion): Drawn[] {
  const { scene, frames } = recording.head;
  const found: Drawn[] = [];
  for (const model of scene.models) {
    const base = model.bodies[0];
    if (model.static || base === undefined || !motion.moves(base)) continue;
    const places = new Float32Array(3 * frames.count);
    let length = 0;
    for (let frame = 0; frame < frames.count; frame++) {
      const [x, y] = motion.placeAt(base, frame);
      places.set([x, y, ABOVE_M], 3 * frame);
      if (frame) length += Math.hypot(x - places[3 * frame - 3], y - places[3 * frame - 2]);
    }
    if (length > 0.05) found.push(new Trail(places, TRAILS[found.length % TRAILS.length], motion));
  }
  return found;
}

class Trail implements Drawn {
  readonly kind = 'Trails';
  readonly root: THREE.Line;

  constructor(
    places: Float32Array,
    colour: number,
    private readonly motion: Motion,
  ) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(places, 3));
    this.root = new THREE.Line(
      geometry,
      new THREE.LineBasicMaterial({ color: colour, transparent: true }),
    );
    this.root.frustumCulled = false;
  }

  look(time_s: number): void {
    this.root.geometry.setDrawRange(0, Math.floor(this.motion.frameAt(time_s)) + 1);
  }
}
