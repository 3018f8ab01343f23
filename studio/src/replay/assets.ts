/** Meshes and textures out of the recording. */
import * as THREE from 'three';
import type { AssetSource } from '../model/assets';
import { unit } from '../model/geometry';
import type { MeshHead, Recording } from './unpacking';

const NORMAL_STEPS = 63;
const UV_STEPS = 4096;

/** Where the scene of a replay has its meshes from. */
export function assetsOf(recording: Recording): AssetSource {
  const { meshes, textures } = recording.head;
  return {
    mesh: async (key) => (meshes[key] ? geometry(recording, meshes[key]) : unit.box()),
    texture: (key) =>
      createImageBitmap(new Blob([recording.raw(textures[key])]), { imageOrientation: 'flipY' }),
  };
}

function geometry(recording: Recording, head: MeshHead): THREE.BufferGeometry {
  const found = new THREE.BufferGeometry();
  const steps = recording.integers(head.vertices);
  const places = Float32Array.from(steps, (value, i) => head.low[i % 3] + value * head.step);
  found.setAttribute('position', new THREE.BufferAttribute(places, 3));
  const normals = unfolded(recording.integers(head.normals));
  found.setAttribute('normal', new THREE.BufferAttribute(normals, 3));
  if (head.uv) {
    const uv = Float32Array.from(recording.integers(head.uv), (value) => value / UV_STEPS);
    found.setAttribute('uv', new THREE.BufferAttribute(uv, 2));
  }
  found.setIndex(new THREE.BufferAttribute(Uint32Array.from(recording.integers(head.corners)), 1));
  found.computeBoundingBox();
  found.computeBoundingSphere();
  return found;
}

/** Unit vectors of pairs of numbers: a square folded into an octahedron. */
function unfolded(pairs: Float64Array): Float32Array {
  const found = new Float32Array((pairs.length / 2) * 3);
  const vector = new THREE.Vector3();
  for (let i = 0; i < pairs.length / 2; i++) {
    const [x, y] = [pairs[2 * i] / NORMAL_STEPS, pairs[2 * i + 1] / NORMAL_STEPS];
    const z = 1 - Math.abs(x) - Math.abs(y);
    vector.set(x, y, z);
    if (z < 0) vector.set((1 - Math.abs(y)) * sign(x), (1 - Math.abs(x)) * sign(y), z);
    vector.normalize().toArray(found, 3 * i);
  }
  return found;
}

const sign = (value: number): number => (value >= 0 ? 1 : -1);
