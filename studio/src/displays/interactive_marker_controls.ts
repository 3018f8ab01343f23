/** The controls of interactive markers: what they look like and how they are dragged. */
import * as THREE from 'three';
import { arrowGeometry, joined, shared } from '../model/geometry';
import type { InteractiveMarkerControl } from '../generated/messages';

export const MENU = 1,
  BUTTON = 2,
  MOVE_AXIS = 3,
  MOVE_PLANE = 4,
  ROTATE_AXIS = 5,
  MOVE_ROTATE = 6,
  MOVE_3D = 7,
  ROTATE_3D = 8,
  MOVE_ROTATE_3D = 9;

/** Can this mode be dragged? */
export const isDragged = (mode: number): boolean => mode >= MOVE_AXIS;

/** The direction a control acts along, in the marker's frame: its orientation's x axis. */
export function controlAxis(control: InteractiveMarkerControl): THREE.Vector3 {
  const { x, y, z, w } = control.orientation;
  const turn = new THREE.Quaternion(x, y, z, w);
  if (turn.lengthSq() < 1e-9) turn.identity();
  return new THREE.Vector3(1, 0, 0).applyQuaternion(turn.normalize());
}

/** The handle of a control without markers of its own: arrows both ways, or a ring. */
export function defaultHandle(control: InteractiveMarkerControl, size: number): THREE.Mesh | null {
  const mode = control.interaction_mode;
  if (mode < MOVE_AXIS) return null;
  const axis = controlAxis(control);
  const geometry = mode === MOVE_AXIS ? arrows() : mode >= MOVE_3D ? cube() : ring();
  const paint = new THREE.MeshPhongMaterial({
    side: THREE.DoubleSide,
    transparent: true,
    opacity: 0.8,
  });
  paint.color.setRGB(Math.abs(axis.x) || 0.15, Math.abs(axis.y) || 0.15, Math.abs(axis.z) || 0.15);
  const mesh = new THREE.Mesh(geometry, paint);
  mesh.quaternion.setFromUnitVectors(new THREE.Vector3(1, 0, 0), axis);
  mesh.scale.setScalar(size / 2);
  return mesh;
}

const arrows = (): THREE.BufferGeometry =>
  shared('control arrows', () =>
    joined([
      arrowGeometry(0.3, 0.08, 0.3, 0.18).translate(0.55, 0, 0),
      arrowGeometry(0.3, 0.08, 0.3, 0.18).translate(0.55, 0, 0).rotateZ(Math.PI),
    ]),
  );
const ring = (): THREE.BufferGeometry =>
  shared('control ring', () => new THREE.RingGeometry(0.85, 1.08, 48).rotateY(Math.PI / 2));
const cube = (): THREE.BufferGeometry =>
  shared('control cube', () => new THREE.BoxGeometry(0.6, 0.6, 0.6));

/** A drag that began: turns rays into poses of the marker (matrices in the fixed frame). */
export class ControlDrag {
  private readonly origin: THREE.Vector3;
  private readonly axis: THREE.Vector3;
  private readonly plane = new THREE.Plane();
  private readonly from: THREE.Vector3 | null;

  constructor(
    private readonly mode: number,
    private readonly start: THREE.Matrix4,
    axis: THREE.Vector3,
    ray: THREE.Ray,
  ) {
    this.origin = new THREE.Vector3().setFromMatrixPosition(start);
    this.axis = axis.clone().normalize();
    const facing = mode === MOVE_3D || mode === MOVE_ROTATE_3D || mode === ROTATE_3D;
    this.plane.setFromNormalAndCoplanarPoint(
      facing ? ray.direction.clone().negate() : this.axis,
      this.origin,
    );
    this.from = this.point(ray);
  }

  /** The pose for a ray of the pointer; null where the ray says nothing. */
  pose(ray: THREE.Ray): THREE.Matrix4 | null {
    const to = this.point(ray);
    if (!to || !this.from) return null;
    if (this.mode === ROTATE_AXIS || this.mode === ROTATE_3D) return this.turned(to);
    if (this.mode === MOVE_ROTATE)
      return this.turned(
        to,
        to.clone().sub(this.origin).length() - this.from.clone().sub(this.origin).length(),
      );
    return this.moved(to.clone().sub(this.from));
  }

  private moved(by: THREE.Vector3): THREE.Matrix4 {
    return new THREE.Matrix4().makeTranslation(by).multiply(this.start);
  }

  private turned(to: THREE.Vector3, outwards = 0): THREE.Matrix4 {
    const a = (this.from as THREE.Vector3).clone().sub(this.origin);
    const b = to.clone().sub(this.origin);
    const normal = this.plane.normal;
    const angle = Math.atan2(normal.dot(a.clone().cross(b)), a.dot(b));
    const turn = new THREE.Matrix4().makeRotationAxis(normal, angle);
    const result = this.start.clone().setPosition(0, 0, 0).premultiply(turn);
    return result.setPosition(this.origin.clone().addScaledVector(b.normalize(), outwards));
  }

  /** On the axis for moves along it, else on the plane. */
  private point(ray: THREE.Ray): THREE.Vector3 | null {
    if (this.mode !== MOVE_AXIS) return ray.intersectPlane(this.plane, new THREE.Vector3());
    const between = this.origin.clone().sub(ray.origin);
    const b = this.axis.dot(ray.direction);
    const denominator = 1 - b * b;
    if (denominator < 1e-6) return null;
    const along = (b * ray.direction.dot(between) - this.axis.dot(between)) / denominator;
    return this.origin.clone().addScaledVector(this.axis, along);
  }
}
