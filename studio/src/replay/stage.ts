/** The scene of a replay: bodies and drawings, a camera that follows or is turned by hand. */
import * as THREE from 'three';
import { Assembly } from '../model/assembly';
import { useAssets } from '../model/assets';
import { stateAt } from '../scene/cameras';
import { freeYaw } from '../scene/framing';
import { gridLines } from '../scene/grid';
import { surroundings } from '../scene/lighting';
import { Pointer } from '../scene/pointer';
import { View } from '../scene/view';
import { assetsOf } from './assets';
import { drawings, type Drawn } from './drawings';
import type { Motion } from './motion';
import type { Recording } from './unpacking';

const GRID_CELLS = 40;
const FOLLOWED_FROM = 0.8;
const AIR = 1.7;

/** What the page does with the scene. */
export class Stage {
  readonly view: View;
  readonly assembly: Assembly;
  readonly drawn: Drawn[];
  /** Models that are not static. */
  readonly models: string[];
  following = '';
  private readonly fingers = new Map<number, { x: number; y: number }>();
  private span = 0;

  constructor(
    host: HTMLElement,
    private readonly recording: Recording,
    readonly motion: Motion,
  ) {
    useAssets(assetsOf(recording));
    const { scene } = recording.head;
    this.pinches(host);
    this.view = new View(host);
    this.view.canvas.setAttribute('role', 'img');
    this.view.canvas.setAttribute('aria-label', 'The world in three dimensions');
    this.assembly = new Assembly((moved) => {
      if (moved) this.view.moved();
      else this.view.invalidate();
    });
    this.assembly.set(scene);
    this.view.scene.add(this.assembly.root);
    this.view.lighting.set(surroundings(scene));
    if (scene.grid) {
      const look = { cells: GRID_CELLS, size_m: 1, alpha: 0.35, plane: 'XY', axes: false } as const;
      const grid = gridLines({ ...look, colour: [0.35, 0.37, 0.4] });
      grid.position.z = 0.002;
      this.view.scene.add(grid);
    }
    this.drawn = drawings(recording, motion, this.assembly);
    for (const one of this.drawn) this.view.scene.add(one.root);
    this.models = scene.models.filter((one) => !one.static).map((one) => one.name);
    new Pointer(this.view, 'rviz', {
      tool: () => ({}) as never,
      menu: () => undefined,
      key: () => false,
    });
    this.look(0);
    // Sizes are known when the meshes are there.
    setTimeout(() => this.begin(), 80);
  }

  /** Show a time. */
  look(time_s: number): void {
    this.motion.look(time_s);
    this.assembly.setPoses(this.motion.poses);
    this.assembly.bodies.forEach((body, i) => (body.root.visible = this.motion.there[i]));
    for (const one of this.drawn) if (one.root.visible) one.look(time_s);
    this.view.invalidate();
  }

  /** Go along with a model; an empty name stays where it is. */
  follow(model: string): void {
    this.following = model;
    const node = this.assembly.nodes(model)[0];
    if (!node) return this.view.rig.follow(null);
    this.view.rig.follow(() => {
      node.root.updateMatrix();
      return node.root.matrix;
    });
    // It goes along from where the model is now, though time may go on before the next frame.
    this.view.rig.tick(performance.now());
  }

  /** Glide to where the robots fill the picture, as they stand now. */
  fit(): void {
    const nodes = this.assembly.bodies.filter(
      (one, i) => !one.isStatic && this.motion.there[i] && this.isRobot(one.entity.model),
    );
    const box = this.assembly.worldBox(nodes.length ? nodes : this.assembly.bodies);
    this.view.rig.moveTo(grown(box, AIR));
  }

  /** Show or hide drawings of a kind. */
  show(kind: Drawn['kind'], on: boolean, time_s: number): void {
    for (const one of this.drawn) if (one.kind === kind) one.root.visible = on;
    this.look(time_s);
  }

  private begin(): void {
    const { rig } = this.view;
    const { view } = this.recording.head.scene;
    if (rig.touched) return;
    if (!this.models.length && view) return rig.set(stateAt(view));
    const robots = this.models.filter((name) => this.isRobot(name));
    const nodes = this.assembly.bodies.filter((one) => robots.includes(one.entity.model));
    const box = grown(this.assembly.worldBox(nodes.length ? nodes : this.assembly.bodies), AIR);
    const size = box.getSize(new THREE.Vector3()).length();
    const farthest = robots
      .map((name) => ({ name, far: this.travel(name) }))
      .sort((a, b) => b.far - a.far)[0];
    rig.set({ yaw: -0.9, pitch: 0.5 });
    const walls = this.assembly.bodies.filter((one) => !nodes.includes(one)).map((one) => one.root);
    const centre = box.getCenter(new THREE.Vector3());
    const distance = size * 1.2;
    const yaw = freeYaw(centre, { ...rig.state, distance }, this.view.camera, walls);
    rig.set({ focal: [centre.x, centre.y, centre.z], distance, yaw });
    if (farthest && farthest.far > (FOLLOWED_FROM * size) / AIR) this.follow(farthest.name);
    this.onBegun?.();
  }

  /** Called when the camera has found its place. */
  onBegun: (() => void) | null = null;

  private isRobot(name: string): boolean {
    const { models } = this.recording.head.scene;
    const free = models.filter((one) => !one.static);
    const robots = free.filter((one) => one.bodies.length > 1);
    return (robots.length ? robots : free).some((one) => one.name === name);
  }

  private travel(name: string): number {
    const base = this.assembly.model(name)?.bodies[0];
    if (base === undefined || !this.motion.moves(base)) return 0;
    const box = new THREE.Box3();
    const { count } = this.recording.head.frames;
    for (let frame = 0; frame < count; frame += Math.max(1, Math.floor(count / 50)))
      box.expandByPoint(new THREE.Vector3(...this.motion.placeAt(base, frame)));
    return box.getSize(new THREE.Vector3()).length();
  }

  /** Two fingers come nearer and go away; the view's own listeners do not hear of them. */
  private pinches(host: HTMLElement): void {
    const spread = (): number => {
      const [a, b] = [...this.fingers.values()];
      return Math.hypot(a.x - b.x, a.y - b.y);
    };
    const hear = (event: PointerEvent): void => {
      if (event.pointerType !== 'touch') return;
      const ends = event.type === 'pointerup' || event.type === 'pointercancel';
      if (ends) this.fingers.delete(event.pointerId);
      else if (event.type === 'pointerdown' || this.fingers.has(event.pointerId))
        this.fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      if (this.fingers.size !== 2) {
        this.span = 0;
        return;
      }
      event.stopPropagation();
      const now = spread();
      if (this.span) this.view.rig.zoom(this.span / Math.max(now, 1));
      this.span = now;
    };
    for (const name of ['pointerdown', 'pointermove', 'pointerup', 'pointercancel'] as const)
      host.addEventListener(name, hear, { capture: true });
  }
}

function grown(box: THREE.Box3, factor: number): THREE.Box3 {
  const centre = box.getCenter(new THREE.Vector3());
  const half = box.getSize(new THREE.Vector3()).multiplyScalar(factor / 2);
  return new THREE.Box3(centre.clone().sub(half), centre.clone().add(half));
}
