/** What cannot be seen of a body: collisions, inertia, mass centre, joints, frame, bounding box. */
import * as THREE from 'three';
import { arrowGeometry, axesGeometry, joined, shared, unit } from './geometry';
import { flat } from './materials';
import type { Mode } from './view_modes';
import type { JointValue, PageBody } from '../generated/messages';
import type { Pose } from './pose';
import { collisionPaint, fix, ShapeNode } from './shapes';

const INERTIA = [0.6, 0.2, 0.85];
const MASS = [1.0, 0.85, 0.0];
const JOINT = [0.0, 0.7, 0.75];
const STILL = [0.55, 0.58, 0.62];
const BOX = [0.95, 0.95, 0.95];

/** What an overlay is drawn from; `size` is the diagonal of the model's box in metres. */
export interface Subject {
  body: PageBody;
  joints: JointValue[];
  isStatic: boolean;
  size: number;
  box: THREE.Box3;
  changed: () => void;
}

/** Draw one overlay of a body, in the body's frame; null where there is nothing to draw. */
export function overlay(mode: Mode, subject: Subject): THREE.Object3D | null {
  const painters: Partial<Record<Mode, (subject: Subject) => THREE.Object3D | null>> = {
    collisions,
    inertias,
    com: massCentre,
    joints: jointAxes,
    frames: frameAxes,
    boxes: boundingBox,
  };
  const found = painters[mode]?.(subject) ?? null;
  if (found) {
    found.name = mode;
    found.renderOrder = 10;
    found.traverse((item) => (item.userData.overlay = true));
  }
  return found;
}

function collisions({ body, changed }: Subject): THREE.Object3D | null {
  const group = new THREE.Group();
  for (const shape of body.collisions) {
    if (shape.geometry.type === 'plane') continue;
    group.add(new ShapeNode({ ...shape, cast_shadows: false }, changed, collisionPaint()).root);
  }
  return group.children.length ? group : null;
}

function inertias({ body, isStatic }: Subject): THREE.Object3D | null {
  const inertial = body.inertial;
  if (!inertial?.box || isStatic) return null;
  const group = new THREE.Group();
  const fill = new THREE.Mesh(unit.box(), flat(INERTIA, 0.3));
  const edges = new THREE.LineSegments(unit.edges(), line(INERTIA, false));
  for (const part of [fill, edges]) fix(part, inertial.box_pose ?? inertial.pose, inertial.box);
  group.add(fill, edges);
  return group;
}

function massCentre({ body, isStatic, size }: Subject): THREE.Object3D | null {
  if (!body.inertial || isStatic) return null;
  const ball = new THREE.Mesh(unit.ball(), flat(MASS, 1, false));
  const radius = 0.014 * size;
  fix(ball, body.inertial.pose, [radius, radius, radius]);
  ball.renderOrder = 12;
  return ball;
}

function frameAxes({ size }: Subject): THREE.Object3D {
  const paint = shinesThrough();
  const axes = new THREE.Mesh(
    shared('axes', () => axesGeometry(1, 0.025)),
    paint,
  );
  const length = 0.08 * size;
  fix(axes, [0, 0, 0, 0, 0, 0, 1], [length, length, length]);
  axes.renderOrder = 11;
  return axes;
}

function boundingBox({ box }: Subject): THREE.Object3D | null {
  return box.isEmpty() ? null : boxLines(box, BOX);
}

function jointAxes({ joints, size }: Subject): THREE.Object3D | null {
  const group = new THREE.Group();
  for (const joint of joints) {
    const mark = new THREE.Mesh(
      jointShape(joint.type),
      flat(joint.type === 'fixed' ? STILL : JOINT, 0.9, false),
    );
    const turn = new THREE.Quaternion().setFromUnitVectors(
      new THREE.Vector3(1, 0, 0),
      new THREE.Vector3(...(joint.axis ?? [1, 0, 0])).normalize(),
    );
    const frame = new THREE.Group();
    fix(frame, joint.pose);
    const length = 0.14 * size;
    fix(mark, [0, 0, 0, turn.x, turn.y, turn.z, turn.w] as Pose, [length, length, length]);
    mark.renderOrder = 12;
    frame.add(mark);
    group.add(frame);
  }
  return group.children.length ? group : null;
}

/** Turning joints: an arrow and a ring; sliding: an arrow both ways; fixed: a cube; ball: a ball. */
function jointShape(type: string): THREE.BufferGeometry {
  return shared(`joint ${type}`, () => {
    if (type === 'fixed') return new THREE.BoxGeometry(0.12, 0.12, 0.12);
    if (type === 'ball' || type === 'floating') return new THREE.SphereGeometry(0.15, 16, 12);
    const arrow = arrowGeometry(0.8, 0.03, 0.2, 0.075);
    if (type === 'prismatic' || type === 'planar') {
      return joined([arrow, arrowGeometry(0.8, 0.03, 0.2, 0.075).rotateZ(Math.PI)]);
    }
    const arc = type === 'continuous' ? 2 * Math.PI : 1.6 * Math.PI;
    return joined([arrow, new THREE.TorusGeometry(0.3, 0.025, 8, 40, arc).rotateY(Math.PI / 2)]);
  });
}

let through: THREE.MeshBasicMaterial | null = null;

function shinesThrough(): THREE.MeshBasicMaterial {
  through ??= new THREE.MeshBasicMaterial({
    vertexColors: true,
    depthTest: false,
    transparent: true,
  });
  return through;
}

const lines = new Map<string, THREE.LineBasicMaterial>();

function line(colour: number[], depth = true): THREE.LineBasicMaterial {
  const key = `${colour.join()} ${depth}`;
  let found = lines.get(key);
  if (!found) {
    found = new THREE.LineBasicMaterial({
      color: new THREE.Color(colour[0], colour[1], colour[2]),
      depthTest: depth,
      transparent: !depth,
    });
    lines.set(key, found);
  }
  return found;
}

/** The twelve edges of a box, in its own frame. */
export function boxLines(box: THREE.Box3, colour: number[]): THREE.LineSegments {
  const edges = new THREE.LineSegments(unit.edges(), line(colour));
  const centre = box.getCenter(new THREE.Vector3());
  const size = box.getSize(new THREE.Vector3()).addScalar(1e-3);
  fix(edges, [centre.x, centre.y, centre.z, 0, 0, 0, 1], size.toArray());
  edges.userData.overlay = true;
  return edges;
}
