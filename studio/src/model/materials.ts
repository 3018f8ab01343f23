/** Materials as Gazebo and RViz shade them: in display colours, Phong, without tone mapping. */
import * as THREE from 'three';
import { loadTexture } from './assets';
import type { MaterialValue } from '../generated/messages';

/** What is said of a surface: at least its colour. */
export type Surface = Pick<MaterialValue, 'diffuse'> & Partial<MaterialValue>;

const DEFAULT: Surface = { diffuse: [0.7, 0.7, 0.7, 1], specular: [0.1, 0.1, 0.1, 1] };
const TRANSPARENT_ALPHA = 0.4;

/** What a view mode does to the materials of a model. */
export interface Look {
  wireframe: boolean;
  transparent: boolean;
  /** Behind everything at the same depth: the ground under a grid. */
  ground?: boolean;
}

const made = new Map<string, THREE.MeshPhongMaterial>();

/** Return the one material of these values and this look; equal shapes share it. */
export function material(
  value: Surface | null,
  transparency: number,
  look: Look,
  changed: () => void,
): THREE.MeshPhongMaterial {
  const given = value ?? DEFAULT;
  const key = JSON.stringify([given, transparency, look]);
  let found = made.get(key);
  if (!found) {
    found = build(given, transparency, look, changed);
    made.set(key, found);
  }
  return found;
}

function build(
  value: Surface,
  transparency: number,
  look: Look,
  changed: () => void,
): THREE.MeshPhongMaterial {
  const [r, g, b, a = 1] = value.diffuse;
  const opacity = a * (1 - transparency) * (look.transparent ? TRANSPARENT_ALPHA : 1);
  const result = new THREE.MeshPhongMaterial({
    color: new THREE.Color(r, g, b),
    shininess: value.shininess || 20,
    opacity,
    transparent: opacity < 0.999,
    depthWrite: opacity > 0.6,
    wireframe: look.wireframe,
    side: THREE.DoubleSide,
    polygonOffset: look.ground ?? false,
    polygonOffsetFactor: 2,
    polygonOffsetUnits: 16,
  });
  giveAmbient(result, value);
  const [sr, sg, sb] = value.specular ?? [0.1, 0.1, 0.1];
  result.specular.setRGB(sr * 0.5, sg * 0.5, sb * 0.5);
  if (value.emissive)
    result.emissive.setRGB(value.emissive[0], value.emissive[1], value.emissive[2]);
  if (value.texture) {
    const [u, v] = value.texture_scale ?? [1, 1];
    result.map = loadTexture(value.texture, u, v, () => {
      result.needsUpdate = true;
      changed();
    });
  }
  return result;
}

/** Gazebo's ambient colour of a material is its own; three's Phong takes the diffuse one. */
function giveAmbient(target: THREE.MeshPhongMaterial, { ambient, diffuse }: Surface): void {
  const share = [0, 1, 2].map((i) =>
    ambient ? Math.min(ambient[i] / Math.max(diffuse[i], 0.02), 50) : 1,
  );
  target.onBeforeCompile = (shader) => {
    shader.uniforms.ambientShare = { value: new THREE.Vector3(share[0], share[1], share[2]) };
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', '#include <common>\nuniform vec3 ambientShare;')
      .replace(
        '#include <lights_fragment_begin>',
        '#include <lights_fragment_begin>\nirradiance *= ambientShare;',
      );
  };
  target.customProgramCacheKey = () => 'gazebo ambient';
}

const flats = new Map<string, THREE.MeshBasicMaterial>();

/** A colour without light, for overlays; `depth` false shines through everything in front. */
export function flat(colour: number[], opacity = 1, depth = true): THREE.MeshBasicMaterial {
  const key = JSON.stringify([colour, opacity, depth]);
  let found = flats.get(key);
  if (!found) {
    found = new THREE.MeshBasicMaterial({
      color: new THREE.Color(colour[0], colour[1], colour[2]),
      opacity,
      transparent: opacity < 1 || !depth,
      depthTest: depth,
      depthWrite: depth && opacity === 1,
    });
    flats.set(key, found);
  }
  return found;
}

/** RViz writes colours as '255; 85; 0'. */
export function parseColour(text: string): [number, number, number] {
  const numbers = text
    .split(/[;,\s]+/)
    .map(Number)
    .filter(Number.isFinite);
  if (numbers.length < 3) return [1, 1, 1];
  return [numbers[0] / 255, numbers[1] / 255, numbers[2] / 255];
}
