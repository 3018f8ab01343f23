/** The shapes of visualization_msgs/Marker: what is instanced and what is drawn one by one. */
import * as THREE from 'three';
import { loadMesh } from '../model/assets';
import { arrowGeometry, shared, unit } from '../model/geometry';
import { material } from '../model/materials';
import type { ColorRGBA, Marker, Vector3 } from '../generated/messages';
import { freeLabel, label } from '../scene/labels';
import { strip, WideLines } from './lines';
import { poseMatrix } from './message_fields';

export const ARROW = 0,
  CUBE = 1,
  SPHERE = 2,
  CYLINDER = 3,
  LINE_STRIP = 4,
  LINE_LIST = 5,
  CUBE_LIST = 6,
  SPHERE_LIST = 7,
  POINTS = 8,
  TEXT = 9,
  MESH = 10,
  TRIANGLES = 11;

/** One instance: which pool, where, in which colour. */
export interface Instance {
  solid: Solid;
  matrix: THREE.Matrix4;
  colour: ColorRGBA;
}
export type Solid = 'cube' | 'sphere' | 'cylinder' | 'arrow' | 'square' | 'ball';

/** The geometry of a pool; unit sizes as markers scale them (diameters, not radii). */
export function solidGeometry(solid: Solid): THREE.BufferGeometry {
  switch (solid) {
    case 'cube':
      return unit.box();
    case 'sphere':
      return shared('marker sphere', () =>
        new THREE.SphereGeometry(0.5, 24, 16).rotateX(Math.PI / 2),
      );
    case 'ball':
      return shared('marker ball', () => new THREE.IcosahedronGeometry(0.5, 1));
    case 'cylinder':
      return shared('marker cylinder', () =>
        new THREE.CylinderGeometry(0.5, 0.5, 1, 28).rotateX(Math.PI / 2),
      );
    case 'square':
      return shared('marker square', () => new THREE.BoxGeometry(1, 1, 1e-3));
    case 'arrow':
      return shared('marker arrow', () => arrowGeometry(0.77, 0.5, 0.23, 1));
  }
}

/** The instances of a marker, in the frame its base pose is in; none for other types. */
export function instancesOf(marker: Marker, base: THREE.Matrix4): Instance[] {
  const at = base.clone().multiply(poseMatrix(marker.pose));
  const { scale, color } = marker;
  const one = (solid: Solid, size: Vector3): Instance[] => [
    { solid, matrix: at.clone().scale(new THREE.Vector3(size.x, size.y, size.z)), colour: color },
  ];
  const all = (solid: Solid, size: Vector3): Instance[] =>
    marker.points.map((point, index) => ({
      solid,
      matrix: at
        .clone()
        .multiply(
          new THREE.Matrix4()
            .makeScale(size.x, size.y, size.z)
            .setPosition(point.x, point.y, point.z),
        ),
      colour: marker.colors[index] ?? color,
    }));
  switch (marker.type) {
    case CUBE:
      return one('cube', scale);
    case SPHERE:
      return one('sphere', scale);
    case CYLINDER:
      return one('cylinder', scale);
    case ARROW:
      return marker.points.length >= 2 ? [] : one('arrow', scale);
    case CUBE_LIST:
      return all('cube', scale);
    case SPHERE_LIST:
      return all('ball', scale);
    case POINTS:
      return all('square', { x: scale.x, y: scale.y, z: 1 });
    default:
      return [];
  }
}

/** What a marker is drawn with when it cannot be instanced. */
export interface Single {
  object: THREE.Object3D;
  free(): void;
}

/** Draw a marker by itself, in its own frame; null for a type that is not known. */
export function singleOf(marker: Marker, changed: () => void): Single | null {
  switch (marker.type) {
    case ARROW:
      return pointArrow(marker);
    case LINE_STRIP:
      return lines(marker, strip(marker.points), pairs(marker));
    case LINE_LIST:
      return lines(
        marker,
        marker.points.flatMap(({ x, y, z }) => [x, y, z]),
        marker.colors,
      );
    case TEXT:
      return text(marker);
    case MESH:
      return mesh(marker, changed);
    case TRIANGLES:
      return triangles(marker);
    default:
      return null;
  }
}

function rgb({ r, g, b }: ColorRGBA): [number, number, number] {
  return [r, g, b];
}

function phong(colour: ColorRGBA): THREE.MeshPhongMaterial {
  const made = new THREE.MeshPhongMaterial({
    opacity: colour.a,
    transparent: colour.a < 0.9998,
    side: THREE.DoubleSide,
  });
  made.color.setRGB(...rgb(colour));
  made.depthWrite = !made.transparent;
  return made;
}

/** From the first point to the second: scale.x is the shaft's diameter, y the head's, z its length. */
function pointArrow({ points, scale, color }: Marker): Single {
  const from = new THREE.Vector3(points[0].x, points[0].y, points[0].z);
  const along = new THREE.Vector3(points[1].x, points[1].y, points[1].z).sub(from);
  const length = Math.max(along.length(), 1e-6);
  const head = Math.min(scale.z || length * 0.23, length);
  const geometry = arrowGeometry(length - head, scale.x / 2, head, scale.y / 2);
  const object = new THREE.Mesh(geometry, phong(color));
  object.position.copy(from);
  object.quaternion.setFromUnitVectors(new THREE.Vector3(1, 0, 0), along.normalize());
  return { object, free: () => [geometry, object.material].forEach((each) => each.dispose()) };
}

function pairs({ colors, points }: Marker): ColorRGBA[] {
  if (colors.length !== points.length) return [];
  return colors.slice(1).flatMap((colour, index) => [colors[index], colour]);
}

function lines(
  { scale, color, ...marker }: Marker,
  points: number[],
  colours: readonly ColorRGBA[],
): Single {
  const object = new THREE.Group();
  const drawn = new WideLines(object);
  const own = colours.length * 3 === points.length && colours.length > 0;
  drawn.paint(own ? [1, 1, 1] : rgb(color), own ? (marker.colors[0]?.a ?? 1) : color.a, scale.x);
  drawn.set(
    points.length % 6 ? points.slice(0, points.length - (points.length % 6)) : points,
    own ? colours.flatMap(rgb) : null,
  );
  return { object, free: () => drawn.dispose() };
}

function text({ text: words, scale, color }: Marker): Single {
  const object = label(words || ' ', {
    height: scale.z * 1.25,
    colour: rgb(color),
    alpha: color.a,
  });
  return { object, free: () => freeLabel(object) };
}

function mesh(marker: Marker, changed: () => void): Single {
  const object = new THREE.Group();
  const { x, y, z } = marker.scale;
  const owned: THREE.Material[] = [];
  for (const part of marker.mesh ?? []) {
    const embedded = marker.mesh_use_embedded_materials && marker.color.a === 0;
    const paint =
      marker.mesh_use_embedded_materials && (embedded || marker.color.a > 0)
        ? material(part.material, 0, { wireframe: false, transparent: false }, changed)
        : phong(marker.color);
    if (!marker.mesh_use_embedded_materials) owned.push(paint);
    void loadMesh(part.key).then((geometry) => {
      const node = new THREE.Mesh(geometry, paint);
      node.scale.set(x, y, z);
      object.add(node);
      changed();
    });
  }
  return { object, free: () => owned.forEach((each) => each.dispose()) };
}

function triangles({ points, colors, color, scale }: Marker): Single {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute(
    'position',
    new THREE.Float32BufferAttribute(
      points.flatMap(({ x, y, z }) => [x, y, z]),
      3,
    ),
  );
  const paint = phong(colors.length ? { r: 1, g: 1, b: 1, a: colors[0].a } : color);
  if (colors.length) {
    const each =
      colors.length === points.length ? colors : colors.flatMap((one) => [one, one, one]);
    geometry.setAttribute('color', new THREE.Float32BufferAttribute(each.flatMap(rgb), 3));
    paint.vertexColors = true;
  }
  geometry.computeVertexNormals();
  const object = new THREE.Mesh(geometry, paint);
  object.scale.set(scale.x || 1, scale.y || 1, scale.z || 1);
  return { object, free: () => [geometry, paint].forEach((each) => each.dispose()) };
}
