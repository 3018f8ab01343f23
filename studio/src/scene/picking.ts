/** What lies under the pointer. */
import * as THREE from 'three';
import type { Entity } from '../model/body';
import type { View } from './view';

/** Something that was hit. */
export interface Hit {
  object: THREE.Object3D;
  point: THREE.Vector3;
  entity: Entity | null;
}

const GROUND = new THREE.Plane(new THREE.Vector3(0, 0, 1), 0);

/** The nearest visible thing on a ray; overlays, tools, lights and grids are looked through. */
export function pick(view: View, clientX: number, clientY: number): Hit | null {
  const caster = new THREE.Raycaster();
  caster.ray.copy(view.ray(clientX, clientY));
  caster.camera = view.camera;
  caster.params.Points = { threshold: 0.03 };
  caster.params.Line = { threshold: 0.02 };
  const found: THREE.Intersection[] = [];
  visit(view.scene, (object) => caster.intersectObject(object, false, found));
  found.sort((a, b) => a.distance - b.distance);
  const first = found.find((hit) => hit.distance > 0);
  return first
    ? { object: first.object, point: first.point, entity: entityOf(first.object) }
    : null;
}

/** The point of the ground (z = 0 of the fixed frame) under the pointer; null above the horizon. */
export function groundPoint(
  view: View,
  clientX: number,
  clientY: number,
  height = 0,
): THREE.Vector3 | null {
  GROUND.constant = -height;
  return view.ray(clientX, clientY).intersectPlane(GROUND, new THREE.Vector3());
}

/** The entity an object is part of. */
export function entityOf(object: THREE.Object3D): Entity | null {
  for (let at: THREE.Object3D | null = object; at; at = at.parent) {
    if (at.userData.entity) return at.userData.entity as Entity;
  }
  return null;
}

function visit(object: THREE.Object3D, look: (object: THREE.Object3D) => void): void {
  if (!object.visible || object.userData.overlay || NAMES.has(object.name)) return;
  if (object instanceof THREE.Mesh || object instanceof THREE.Points) look(object);
  for (const child of object.children) visit(child, look);
}

const NAMES = new Set(['hands', 'grid', 'sky', 'lights']);
