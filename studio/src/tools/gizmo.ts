/** Translate and Rotate: arrows and rings that move the selected model in the simulation. */
import * as THREE from 'three';
import { TransformControls } from 'three/addons/controls/TransformControls.js';
import { poseOf } from '../model/assembly';
import { pick } from '../scene/picking';
import type { Bench, Tool } from './tool';

const SNAP_M = 0.25;
const SNAP_RAD = Math.PI / 12;
/** After a drag the last pose must have reached the simulator before its poses count again. */
const SETTLE_MS = 250;

/** The tool for one of the two modes. */
export function gizmo(bench: Bench, mode: 'translate' | 'rotate'): Tool {
  const hand = new Gizmo(bench, mode);
  const name = mode === 'translate' ? 'Translate' : 'Rotate';
  return {
    name,
    key: mode[0],
    about: `${name} the selected model; Ctrl snaps.`,
    begin: () => hand.begin(),
    end: () => hand.end(),
    down: (event) => hand.isOver(event),
    move: () => hand.isBusy,
    up: () => hand.isBusy,
    click(event) {
      if (hand.isBusy) return;
      bench.world.selectEntity(pick(bench.view, event.clientX, event.clientY)?.entity ?? null);
    },
    keyDown: (event) => hand.snap(event.ctrlKey),
  };
}

class Gizmo {
  private readonly proxy = new THREE.Object3D();
  private controls: TransformControls | null = null;
  private camera: THREE.Camera | null = null;
  private stops: (() => void)[] = [];
  private model = '';
  private sending = false;
  private again = false;

  constructor(
    private readonly bench: Bench,
    private readonly mode: 'translate' | 'rotate',
  ) {}

  get isBusy(): boolean {
    return Boolean(this.controls?.dragging);
  }

  begin(): void {
    const { view, world, assembly } = this.bench;
    view.hands.add(this.proxy);
    this.build();
    this.stops = [
      world.onSelection(() => this.attach()),
      view.beforeDraw(() => {
        if (this.camera !== view.camera) this.build();
        const pose = this.isBusy || assembly.held ? null : assembly.modelPose(this.model);
        if (pose) pose.decompose(this.proxy.position, this.proxy.quaternion, this.proxy.scale);
      }),
    ];
    if (!world.selection) this.bench.say('Click a model to move it.');
  }

  end(): void {
    this.stops.forEach((stop) => stop());
    this.drop();
    this.proxy.removeFromParent();
    this.bench.view.invalidate(true);
  }

  /** Does the pointer grasp a handle? */
  isOver(event: PointerEvent): boolean {
    return event.button === 0 && Boolean(this.controls?.axis);
  }

  snap(on: boolean): boolean {
    this.controls?.setTranslationSnap(on ? SNAP_M : null);
    this.controls?.setRotationSnap(on ? SNAP_RAD : null);
    return false;
  }

  private build(): void {
    this.drop();
    const { view } = this.bench;
    this.camera = view.camera;
    const controls = new TransformControls(view.camera, view.canvas);
    controls.setMode(this.mode);
    controls.setSize(0.8);
    controls.addEventListener('change', () => view.invalidate(true));
    controls.addEventListener('objectChange', () => this.moved());
    controls.addEventListener('dragging-changed', (event) => this.held(Boolean(event.value)));
    view.hands.add(controls.getHelper());
    this.controls = controls;
    this.attach();
  }

  private drop(): void {
    this.controls?.detach();
    this.controls?.getHelper().removeFromParent();
    this.controls?.dispose();
    this.controls = null;
  }

  private attach(): void {
    const { world, assembly, view } = this.bench;
    this.model = world.selection?.model ?? '';
    const pose = assembly.modelPose(this.model);
    if (pose && this.controls) {
      pose.decompose(this.proxy.position, this.proxy.quaternion, this.proxy.scale);
      this.controls.attach(this.proxy);
    } else this.controls?.detach();
    view.invalidate(true);
  }

  private held(dragging: boolean): void {
    const { assembly } = this.bench;
    if (dragging) assembly.held = this.model;
    else {
      this.moved();
      setTimeout(() => {
        if (!this.isBusy) assembly.held = null;
      }, SETTLE_MS);
    }
  }

  private moved(): void {
    this.proxy.updateMatrix();
    this.bench.assembly.moveModel(this.model, this.proxy.matrix);
    const { x, y, z } = this.proxy.position;
    this.bench.say(`${this.model}: [${x.toFixed(3)}, ${y.toFixed(3)}, ${z.toFixed(3)}]`);
    void this.send();
  }

  /** One request at a time; what came meanwhile goes with the next. */
  private async send(): Promise<void> {
    if (this.sending) {
      this.again = true;
      return;
    }
    this.sending = true;
    this.again = false;
    try {
      this.proxy.updateMatrix();
      await this.bench.world.call('world.set_pose', {
        model: this.model,
        pose: poseOf(this.proxy.matrix),
      });
    } catch (problem) {
      this.bench.fail(problem);
    }
    this.sending = false;
    if (this.again) void this.send();
  }
}
