/** Meshes and textures by key, read once and shared by all views of the page. */
import * as THREE from 'three';
import { serverPath } from '../server_path';
import { unit } from './geometry';

const HEADER_BYTES = 16;
const HAS_UV = 1;

const meshes = new Map<string, Promise<THREE.BufferGeometry>>();
const textures = new Map<string, THREE.Texture>();

/** Where meshes and textures come from in place of the server. */
export interface AssetSource {
  mesh(key: string): Promise<THREE.BufferGeometry>;
  /** A picture whose first row is the lowest. */
  texture(key: string): Promise<ImageBitmap>;
}

let source: AssetSource | null = null;

/** Take meshes and textures from somewhere else than the server. */
export function useAssets(given: AssetSource): void {
  source = given;
}

/** Read a mesh of the server: header, positions, normals, texture coordinates, corners. */
export function readMesh(buffer: ArrayBuffer): THREE.BufferGeometry {
  const [vertices, corners, flags] = new Uint32Array(buffer, 0, 4);
  const geometry = new THREE.BufferGeometry();
  let at = HEADER_BYTES;
  const floats = (count: number): Float32Array => {
    const view = new Float32Array(buffer, at, count);
    at += 4 * count;
    return view;
  };
  geometry.setAttribute('position', new THREE.BufferAttribute(floats(3 * vertices), 3));
  geometry.setAttribute('normal', new THREE.BufferAttribute(floats(3 * vertices), 3));
  if (flags & HAS_UV)
    geometry.setAttribute('uv', new THREE.BufferAttribute(floats(2 * vertices), 2));
  geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(buffer, at, corners), 1));
  geometry.computeBoundingBox();
  geometry.computeBoundingSphere();
  return geometry;
}

/** Fetch a mesh part; one that cannot be fetched is a box of 0.2 m. */
export function loadMesh(key: string): Promise<THREE.BufferGeometry> {
  let found = meshes.get(key);
  if (!found) {
    found = source ? source.mesh(key) : fetchMesh(key);
    meshes.set(key, found);
  }
  return found;
}

async function fetchMesh(key: string): Promise<THREE.BufferGeometry> {
  const answer = await fetch(serverPath(`/mesh/${encodeURIComponent(key)}`));
  if (!answer.ok) {
    console.warn(`mesh ${key}: the server answered ${answer.status}`);
    meshes.delete(key);
    return unit.box();
  }
  return readMesh(await answer.arrayBuffer());
}

/** Return a texture that fills itself in; `done` is called when there is something new to draw. */
export function loadTexture(key: string, u: number, v: number, done: () => void): THREE.Texture {
  const name = `${key} ${u} ${v}`;
  let found = textures.get(name);
  if (!found) {
    found = source ? texture(source.texture(key), done) : fetchTexture(key, done);
    found.wrapS = found.wrapT = THREE.RepeatWrapping;
    found.repeat.set(1 / (u || 1), 1 / (v || 1));
    found.colorSpace = THREE.NoColorSpace;
    found.anisotropy = 4;
    textures.set(name, found);
  } else if (!found.image) {
    const waiting = found;
    const poll = (): void => void (waiting.image ? done() : setTimeout(poll, 100));
    poll();
  }
  return found;
}

function fetchTexture(key: string, done: () => void): THREE.Texture {
  return new THREE.TextureLoader().load(serverPath(`/texture/${encodeURIComponent(key)}`), done);
}

function texture(picture: Promise<ImageBitmap>, done: () => void): THREE.Texture {
  const made = new THREE.Texture();
  made.flipY = false;
  void picture.then((image) => {
    made.image = image;
    made.needsUpdate = true;
    done();
  });
  return made;
}
