/** A scene value as objects: kept when the value changes, moved by streams of poses. */
import * as THREE from 'three';
import { BodyNode } from './body';
import { ModeSet, type Mode } from './view_modes';
import type { JointValue, ModelValue, PageScene } from '../generated/messages';
import type { Pose } from './pose';
import { place } from './shapes';

const BARE_MODEL_M = 0.5;
/** Overlays of a building would bury what stands in it. */
const LARGEST_MODEL_M = 4;
const POSE_LENGTH = 7;

/** All bodies of a world or of a robot. */
export class Assembly {
  readonly root = new THREE.Group();
  readonly modes = new ModeSet();
  bodies: BodyNode[] = [];
  value: PageScene | null = null;
  /** The model that a gizmo holds: poses of the stream wait. */
  held: string | null = null;
  private keys: string[] = [];
  private refreshing = false;
  private readonly loadListeners = new Set<() => void>();

  /** @param changed is called whenever there is something new to draw; `moved` for shadows. */
  constructor(private readonly changed: (moved: boolean) => void) {
    this.root.name = 'assembly';
  }

  /** Take a new scene value; bodies that did not change stay as they are. */
  set(value: PageScene | null): void {
    const old = new Map(this.bodies.map((node, index) => [this.keys[index], node]));
    this.value = value;
    this.bodies = [];
    this.keys = [];
    const joints = value ? jointsByChild(value) : new Map<number, JointValue[]>();
    value?.bodies.forEach((body, index) => {
      const model = value.models[body.model];
      const own = joints.get(index) ?? [];
      const key = JSON.stringify([
        { ...body, pose: 0, model: 0 },
        model?.name,
        model?.static,
        own.map((j) => ({ ...j, parent: 0, child: 0 })),
      ]);
      const name = model?.name ?? value.name;
      const entity = { model: name, link: body.link, body: body.name };
      const node =
        old.get(key) ?? new BodyNode(body, entity, own, model?.static ?? false, () => this.later());
      old.delete(key);
      this.keys.push(key);
      this.bodies.push(node);
      this.root.add(node.root);
      place(node.root, body.pose);
    });
    old.forEach((node) => this.root.remove(node.root));
    this.applyModes();
  }

  /** Be called when meshes have come: boxes are larger then. Returns what ends it. */
  onLoaded(listener: () => void): () => void {
    this.loadListeners.add(listener);
    return () => this.loadListeners.delete(listener);
  }

  /** Move all bodies: `poses` holds seven numbers for each body of the scene value. */
  setPoses(poses: Float32Array): void {
    const count = Math.min(this.bodies.length, Math.floor(poses.length / POSE_LENGTH));
    let moved = false;
    for (let i = 0; i < count; i++) {
      const node = this.bodies[i];
      if (this.held !== null && node.entity.model === this.held) continue;
      moved = moveIfNew(node.root, poses, i * POSE_LENGTH) || moved;
    }
    if (moved) this.changed(true);
  }

  /** The pose of a model: of its first body, where the model's frame is (world kind). */
  modelPose(name: string): THREE.Matrix4 | null {
    const model = this.model(name);
    if (!model || !this.value || !model.bodies.length) return null;
    const first = model.bodies[0];
    const offset = matrixOf(this.value.bodies[first].pose).invert().multiply(matrixOf(model.pose));
    const node = this.bodies[first].root;
    node.updateMatrix();
    return node.matrix.clone().multiply(offset);
  }

  /** Move a model as a rigid whole, ahead of what the simulator will say. */
  moveModel(name: string, target: THREE.Matrix4): void {
    const now = this.modelPose(name);
    const model = this.model(name);
    if (!now || !model) return;
    const change = target.clone().multiply(now.invert());
    for (const index of model.bodies) {
      const node = this.bodies[index].root;
      node.updateMatrix();
      node.matrix.premultiply(change).decompose(node.position, node.quaternion, node.scale);
    }
    this.changed(true);
  }

  /** The model of a name. */
  model(name: string): ModelValue | undefined {
    return this.value?.models.find((model) => model.name === name);
  }

  /** The bodies of a model, or the one of a link. */
  nodes(model: string, link?: string): BodyNode[] {
    return this.bodies.filter(
      (n) => n.entity.model === model && (link === undefined || n.entity.link === link),
    );
  }

  /** The box in the world around some bodies. */
  worldBox(nodes: BodyNode[] = this.bodies): THREE.Box3 {
    const box = new THREE.Box3();
    for (const node of nodes) {
      const own = node.box();
      node.root.updateWorldMatrix(true, false);
      if (own.isEmpty())
        box.expandByPoint(new THREE.Vector3().setFromMatrixPosition(node.root.matrixWorld));
      else box.union(own.applyMatrix4(node.root.matrixWorld));
    }
    return box;
  }

  /** Turn a mode on or off, for all or for one model. */
  setMode(mode: Mode, on: boolean, model?: string): void {
    this.modes.set(mode, on, model);
    this.applyModes();
  }

  /** How many bodies show a mode's overlay. */
  count(mode: Mode): number {
    return this.bodies.filter((node) => node.shows(mode)).length;
  }

  private applyModes(): void {
    const sizes = new Map<string, number>();
    for (const node of this.bodies) {
      const name = node.entity.model;
      if (!sizes.has(name)) {
        const size = this.worldBox(this.nodes(name)).getSize(new THREE.Vector3()).length();
        sizes.set(
          name,
          Number.isFinite(size) && size > 0 ? Math.min(size, LARGEST_MODEL_M) : BARE_MODEL_M,
        );
      }
      node.apply(this.modes, sizes.get(name) as number);
    }
    this.changed(true);
  }

  /** Several meshes that come at once cost one look at the modes. */
  private later(): void {
    if (this.refreshing) return;
    this.refreshing = true;
    setTimeout(() => {
      this.refreshing = false;
      this.applyModes();
      this.loadListeners.forEach((listener) => listener());
    }, 60);
  }
}

function jointsByChild(value: PageScene): Map<number, JointValue[]> {
  const found = new Map<number, JointValue[]>();
  for (const joint of value.joints)
    found.set(joint.child, [...(found.get(joint.child) ?? []), joint]);
  return found;
}

/** The matrix of a pose. */
export function matrixOf(pose: Pose): THREE.Matrix4 {
  const place = new THREE.Vector3(pose[0], pose[1], pose[2]);
  const turn = new THREE.Quaternion(pose[3], pose[4], pose[5], pose[6]);
  return new THREE.Matrix4().compose(place, turn, new THREE.Vector3(1, 1, 1));
}

/** The pose of a rigid matrix. */
export function poseOf(matrix: THREE.Matrix4): Pose {
  const place = new THREE.Vector3();
  const turn = new THREE.Quaternion();
  matrix.decompose(place, turn, new THREE.Vector3());
  return [place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w];
}

function moveIfNew(object: THREE.Object3D, poses: Float32Array, at: number): boolean {
  const { position: p, quaternion: q } = object;
  if (Number.isNaN(poses[at])) return false;
  const same =
    Math.abs(p.x - poses[at]) + Math.abs(p.y - poses[at + 1]) + Math.abs(p.z - poses[at + 2]) <
      1e-6 &&
    Math.abs(q.x - poses[at + 3]) +
      Math.abs(q.y - poses[at + 4]) +
      Math.abs(q.z - poses[at + 5]) +
      Math.abs(q.w - poses[at + 6]) <
      1e-6;
  if (!same) place(object, poses, at);
  return !same;
}
