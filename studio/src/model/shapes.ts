/** Shapes of the scene value as three.js meshes. */
import * as THREE from 'three';
import { loadMesh } from './assets';
import { primitive } from './geometry';
import { flat, material, type Look, type Surface } from './materials';
import type { PageShape } from '../generated/messages';
import type { Pose } from './pose';

const PLAIN: Look = { wireframe: false, transparent: false };
const GROUND: Surface = { diffuse: [0.78, 0.79, 0.8, 1], specular: [0, 0, 0, 1] };

/** Write a pose into an object; it keeps it until it is set again. */
export function place(object: THREE.Object3D, pose: ArrayLike<number>, at = 0): void {
  object.position.set(pose[at], pose[at + 1], pose[at + 2]);
  object.quaternion.set(pose[at + 3], pose[at + 4], pose[at + 5], pose[at + 6]);
}

/** Place an object once and for all: its matrix is not looked at again. */
export function fix(object: THREE.Object3D, pose: Pose, scale?: ArrayLike<number>): void {
  place(object, pose);
  if (scale) object.scale.set(scale[0], scale[1], scale[2]);
  object.updateMatrix();
  object.matrixAutoUpdate = false;
}

/** One shape: a group with a mesh, or several once a mesh file has come. */
export class ShapeNode {
  readonly root = new THREE.Group();
  private readonly meshes: { mesh: THREE.Mesh; value: Surface | null }[] = [];
  private look: Look = PLAIN;
  private paint: THREE.Material | null = null;

  /**
   * @param changed is called when something came that must be drawn.
   * @param paint one material for all, in place of the shape's own (collisions).
   */
  constructor(
    readonly value: PageShape,
    private readonly changed: () => void,
    paint: THREE.Material | null = null,
  ) {
    this.paint = paint;
    this.root.name = value.name;
    fix(this.root, value.pose);
    this.build();
  }

  /** Swap materials for a view mode. */
  setLook(look: Look, paint: THREE.Material | null = null): void {
    this.look = look;
    this.paint = paint;
    for (const item of this.meshes) item.mesh.material = this.materialOf(item.value);
  }

  /** Points of the shape's box, in the frame of the body, are joined to a box. */
  expand(box: THREE.Box3): void {
    const geometry = this.value.geometry;
    if (geometry.type === 'plane') return;
    for (const { mesh } of this.meshes) {
      const own = mesh.geometry.boundingBox;
      if (!own) continue;
      const matrix = new THREE.Matrix4().multiplyMatrices(this.root.matrix, mesh.matrix);
      box.union(own.clone().applyMatrix4(matrix));
    }
  }

  private build(): void {
    const geometry = this.value.geometry;
    if (geometry.type === 'mesh') {
      for (const part of geometry.parts) {
        void loadMesh(part.key).then((loaded) => {
          this.add(loaded, geometry.scale, this.value.material ?? part.material);
          this.changed();
        });
      }
      return;
    }
    const found = primitive(geometry);
    if (!found) return;
    let own: Surface | null = this.value.material;
    if (geometry.type === 'missing') own = { diffuse: [0.9, 0.1, 0.1, 1] };
    if (geometry.type === 'plane' && !own) own = GROUND;
    this.add(found.geometry, found.scale, own);
  }

  private add(
    geometry: THREE.BufferGeometry,
    scale: ArrayLike<number>,
    value: Surface | null,
  ): void {
    const mesh = new THREE.Mesh(geometry, this.materialOf(value));
    mesh.castShadow = this.value.cast_shadows !== false && this.value.geometry.type !== 'plane';
    mesh.receiveShadow = true;
    fix(mesh, [0, 0, 0, 0, 0, 0, 1], scale);
    this.meshes.push({ mesh, value });
    this.root.add(mesh);
  }

  private materialOf(value: Surface | null): THREE.Material {
    if (this.paint) return this.paint;
    const ground = this.value.geometry.type === 'plane';
    return material(value, this.value.transparency || 0, { ...this.look, ground }, this.changed);
  }
}

/** Orange, see-through: Gazebo's way to show what collides. */
export const collisionPaint = (): THREE.Material => flat([1.0, 0.5, 0.05], 0.5);
