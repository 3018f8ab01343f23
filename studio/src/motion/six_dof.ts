/** A marker of six degrees of freedom that the tool Interact drags: of a goal, of an object. */
import * as THREE from 'three';
import { FEEDBACK, type Handle } from '../displays/interactive_markers';
import {
  ControlDrag,
  controlAxis,
  defaultHandle,
  MOVE_AXIS,
  ROTATE_AXIS,
} from '../displays/interactive_marker_controls';
import type { InteractiveMarkerControl, Quaternion } from '../generated/messages';

const HALF = Math.SQRT1_2;
/** Orientations that turn x to x, z and y, as in the tutorials of interactive markers. */
const AXES: readonly [string, Quaternion][] = [
  ['x', { x: HALF, y: 0, z: 0, w: HALF }],
  ['z', { x: 0, y: HALF, z: 0, w: HALF }],
  ['y', { x: 0, y: 0, z: HALF, w: HALF }],
];

/** What a drag does. */
export interface SixDofHost {
  /** The marker was moved to a pose of the frame it lies in. */
  moved(pose: THREE.Matrix4): void;
  released(): void;
  redraw(): void;
}

/** Arrows and rings; lies in a parent whose frame its poses are of. */
export class SixDof {
  readonly root = new THREE.Group();
  held = false;

  constructor(
    readonly name: string,
    private readonly size: number,
    private readonly host: SixDofHost,
  ) {
    this.root.name = name;
    for (const [axis, orientation] of AXES) {
      for (const mode of [MOVE_AXIS, ROTATE_AXIS])
        this.root.add(this.control(axis, orientation, mode));
    }
  }

  /** Stand at a pose, unless somebody holds it. */
  place(pose: THREE.Matrix4): void {
    if (!this.held) pose.decompose(this.root.position, this.root.quaternion, this.root.scale);
  }

  private control(axis: string, orientation: Quaternion, mode: number): THREE.Object3D {
    const name = `${mode === MOVE_AXIS ? 'move' : 'rotate'}_${axis}`;
    const control: InteractiveMarkerControl = {
      name,
      orientation,
      orientation_mode: 0,
      interaction_mode: mode,
      always_visible: false,
      markers: [],
      independent_marker_orientation: false,
      description: '',
    };
    const group = new THREE.Group();
    group.name = name;
    group.userData.interact = this.handle(control);
    const mesh = defaultHandle(control, this.size);
    if (mesh) group.add(mesh);
    return group;
  }

  private handle(control: InteractiveMarkerControl): Handle {
    return {
      marker: { name: this.name, menu_entries: [] },
      control,
      begin: (ray) => {
        this.held = true;
        this.root.updateWorldMatrix(true, false);
        const axis = controlAxis(control).applyQuaternion(
          new THREE.Quaternion().setFromRotationMatrix(this.root.matrixWorld),
        );
        return new ControlDrag(control.interaction_mode, this.root.matrixWorld.clone(), axis, ray);
      },
      moveTo: (pose) => {
        const local = (
          this.root.parent?.matrixWorld.clone().invert() ?? new THREE.Matrix4()
        ).multiply(pose);
        local.decompose(this.root.position, this.root.quaternion, this.root.scale);
        this.host.moved(local);
        this.host.redraw();
      },
      send: (event) => {
        if (event !== FEEDBACK.MOUSE_UP) return;
        this.held = false;
        this.host.released();
      },
    };
  }
}
