/** Geometries of the scene value, shared between equal shapes; unit solids are scaled by their mesh. */
import * as THREE from 'three';
import type { PageGeometry } from '../generated/messages';
import type { Vector } from './pose';

const cache = new Map<string, THREE.BufferGeometry>();

/** Return the one geometry of this name, made at first use and never disposed. */
export function shared(name: string, make: () => THREE.BufferGeometry): THREE.BufferGeometry {
  let found = cache.get(name);
  if (!found) {
    found = make();
    found.computeBoundingBox();
    found.computeBoundingSphere();
    cache.set(name, found);
  }
  return found;
}

/** Unit solids, z up, centred: box 1 m, sphere and cylinder of radius 1, cylinder and cone 1 m long. */
export const unit = {
  box: () => shared('box', () => new THREE.BoxGeometry(1, 1, 1)),
  sphere: () => shared('sphere', () => new THREE.SphereGeometry(1, 32, 20).rotateX(Math.PI / 2)),
  ball: () => shared('ball', () => new THREE.IcosahedronGeometry(1, 2)),
  cylinder: () =>
    shared('cylinder', () => new THREE.CylinderGeometry(1, 1, 1, 40).rotateX(Math.PI / 2)),
  cone: () => shared('cone', () => new THREE.ConeGeometry(1, 1, 32).rotateX(Math.PI / 2)),
  rod: () => shared('rod', () => new THREE.CylinderGeometry(1, 1, 1, 12).rotateX(Math.PI / 2)),
  edges: () => shared('edges', () => new THREE.EdgesGeometry(new THREE.BoxGeometry(1, 1, 1))),
};

/** An arrow along +x: shaft, then head; total length shaft + head. */
export function arrowGeometry(
  shaftLength: number,
  shaftRadius: number,
  headLength: number,
  headRadius: number,
): THREE.BufferGeometry {
  const shaft = new THREE.CylinderGeometry(shaftRadius, shaftRadius, shaftLength, 12);
  shaft.rotateZ(-Math.PI / 2).translate(shaftLength / 2, 0, 0);
  const head = new THREE.ConeGeometry(headRadius, headLength, 16);
  head.rotateZ(-Math.PI / 2).translate(shaftLength + headLength / 2, 0, 0);
  return joined([shaft, head]);
}

/** A flat arrow along +x in the plane of x and y: few triangles, for thousands of poses. */
export function flatArrowGeometry(length: number): THREE.BufferGeometry {
  const [half, wide, neck] = [length * 0.02, length * 0.14, length * 0.7];
  const corners = [0, -half, neck, -half, neck, half, 0, half, neck, -wide, length, 0, neck, wide];
  const places = new Float32Array((corners.length / 2) * 3);
  for (let i = 0; i < corners.length / 2; i++)
    places.set([corners[2 * i], corners[2 * i + 1], 0], 3 * i);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(places, 3));
  geometry.setAttribute(
    'normal',
    new THREE.BufferAttribute(
      new Float32Array(places.length).map((_, i) => Number(i % 3 === 2)),
      3,
    ),
  );
  geometry.setIndex([0, 1, 2, 0, 2, 3, 4, 5, 6]);
  return geometry;
}

/** Three coloured axes of a length and radius, in one geometry with vertex colours. */
export function axesGeometry(length: number, radius: number): THREE.BufferGeometry {
  const parts = AXIS_COLOURS.map((colour, axis) => {
    const rod = new THREE.CylinderGeometry(radius, radius, length, 10).translate(0, length / 2, 0);
    if (axis === 0) rod.rotateZ(-Math.PI / 2);
    if (axis === 2) rod.rotateX(Math.PI / 2);
    return painted(rod, colour);
  });
  return joined(parts);
}

/** Red, green and blue of x, y and z, the same as in the headless pictures. */
export const AXIS_COLOURS: Vector[] = [
  [0.9, 0.1, 0.1],
  [0.1, 0.75, 0.1],
  [0.15, 0.25, 1.0],
];

/** Give every vertex of a geometry one colour. */
export function painted(geometry: THREE.BufferGeometry, colour: Vector): THREE.BufferGeometry {
  const count = geometry.getAttribute('position').count;
  const colours = new Float32Array(count * 3);
  for (let i = 0; i < count; i++) colours.set(colour, i * 3);
  geometry.setAttribute('color', new THREE.BufferAttribute(colours, 3));
  return geometry;
}

/** Join geometries of equal attributes (position, normal and maybe colour) into one. */
export function joined(parts: THREE.BufferGeometry[]): THREE.BufferGeometry {
  const flat = parts.map((part) => (part.index ? part.toNonIndexed() : part));
  const result = new THREE.BufferGeometry();
  const names = ['position', 'normal', 'color'].filter((name) =>
    flat.every((p) => p.hasAttribute(name)),
  );
  for (const name of names) {
    const arrays = flat.map((part) => part.getAttribute(name).array as Float32Array);
    const all = new Float32Array(arrays.reduce((sum, array) => sum + array.length, 0));
    let at = 0;
    for (const array of arrays) {
      all.set(array, at);
      at += array.length;
    }
    result.setAttribute(name, new THREE.BufferAttribute(all, 3));
  }
  parts.forEach((part) => part.dispose());
  return result;
}

/** Geometry and scale of a primitive; a mesh or a missing mesh has its own way. */
export function primitive(
  value: PageGeometry,
): { geometry: THREE.BufferGeometry; scale: Vector } | null {
  switch (value.type) {
    case 'box':
      return { geometry: unit.box(), scale: value.size };
    case 'sphere':
      return { geometry: unit.sphere(), scale: [value.radius, value.radius, value.radius] };
    case 'ellipsoid':
      return { geometry: unit.sphere(), scale: value.radii };
    case 'cylinder':
      return { geometry: unit.cylinder(), scale: [value.radius, value.radius, value.length] };
    case 'cone':
      return { geometry: unit.cone(), scale: [value.radius, value.radius, value.length] };
    case 'capsule':
      return { geometry: capsule(value.radius, value.length), scale: [1, 1, 1] };
    case 'plane':
      return {
        geometry: plane(value.normal),
        scale: [value.size[0] || 100, value.size[1] || 100, 1],
      };
    case 'missing':
      return { geometry: unit.box(), scale: [0.2, 0.2, 0.2] };
    default:
      return null;
  }
}

function capsule(radius: number, length: number): THREE.BufferGeometry {
  return shared(`capsule ${radius} ${length}`, () =>
    new THREE.CapsuleGeometry(radius, length, 8, 24).rotateX(Math.PI / 2),
  );
}

function plane(normal: Vector): THREE.BufferGeometry {
  const up = new THREE.Vector3(...normal);
  if (up.lengthSq() === 0) up.set(0, 0, 1);
  up.normalize();
  return shared(`plane ${up.toArray().join(' ')}`, () => {
    const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), up);
    return new THREE.PlaneGeometry(1, 1).applyQuaternion(turn);
  });
}
