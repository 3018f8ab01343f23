/** One link as the page draws it: its shapes and what view modes lay over them. */
import * as THREE from 'three';
import { MODES, type Mode, type ModeSet } from './view_modes';
import { overlay, type Subject } from './overlays';
import type { JointValue, PageBody } from '../generated/messages';
import { place, ShapeNode } from './shapes';

/** What a click on something hits. */
export interface Entity {
  model: string;
  link: string;
  body: string;
}

/** A body of the scene; its group carries the pose. */
export class BodyNode {
  readonly root = new THREE.Group();
  readonly visuals = new THREE.Group();
  readonly shapes: ShapeNode[];
  private readonly overlays = new Map<Mode, THREE.Object3D | null>();
  private grey = false;

  constructor(
    readonly value: PageBody,
    readonly entity: Entity,
    readonly joints: JointValue[],
    readonly isStatic: boolean,
    private readonly changed: () => void,
  ) {
    this.root.name = value.name;
    this.root.userData.entity = entity;
    this.shapes = value.visuals.map((shape) => new ShapeNode(shape, () => this.refresh()));
    // three complains when it is given none, as for links without visuals.
    for (const shape of this.shapes) this.visuals.add(shape.root);
    this.root.add(this.visuals);
    place(this.root, value.pose);
  }

  /** The box around the visuals (or collisions, where there are none) in the body's frame. */
  box(): THREE.Box3 {
    const box = new THREE.Box3();
    this.shapes.forEach((shape) => shape.expand(box));
    if (box.isEmpty()) {
      this.value.collisions.forEach((shape) => new ShapeNode(shape, () => undefined).expand(box));
    }
    return box;
  }

  /** Show what the modes say; `size` is the diagonal of the model's box. */
  apply(modes: ModeSet, size: number): void {
    const name = this.entity.model;
    const look = {
      wireframe: modes.isOn('wireframe', name),
      transparent: modes.isOn('transparent', name),
    };
    const paint = this.grey ? GREY : null;
    this.shapes.forEach((shape) => shape.setLook(look, paint));
    for (const mode of Object.keys(MODES) as Mode[])
      this.toggle(mode, modes.isOn(mode, name), size);
  }

  /** Draw in plain white-grey, RViz's sign for a link without a transform. */
  setLost(lost: boolean): void {
    if (lost === this.grey) return;
    this.grey = lost;
    this.shapes.forEach((shape) =>
      shape.setLook({ wireframe: false, transparent: false }, lost ? GREY : null),
    );
  }

  /** How many overlays of a mode this body shows. */
  shows(mode: Mode): boolean {
    return Boolean(this.overlays.get(mode));
  }

  /** Remove a drawn overlay so that it is drawn anew. */
  private drop(mode: Mode): void {
    const drawn = this.overlays.get(mode);
    if (drawn) this.root.remove(drawn);
    this.overlays.delete(mode);
  }

  private toggle(mode: Mode, on: boolean, size: number): void {
    if (!on) {
      this.drop(mode);
      return;
    }
    if (this.overlays.has(mode)) return;
    const drawn = overlay(mode, this.subject(size));
    this.overlays.set(mode, drawn);
    if (drawn) this.root.add(drawn);
  }

  private subject(size: number): Subject {
    const { value: body, joints, isStatic, changed } = this;
    return { body, joints, isStatic, size, box: this.box(), changed };
  }

  /** A mesh came: boxes drawn before were too small. */
  private refresh(): void {
    this.drop('boxes');
    this.changed();
  }
}

const GREY = new THREE.MeshPhongMaterial({
  color: new THREE.Color(0.85, 0.85, 0.85),
  side: THREE.DoubleSide,
});
