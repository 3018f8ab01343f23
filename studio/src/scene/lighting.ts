/** Lights, shadows, background and sky, with Gazebo's values or a lamp of our own. */
import * as THREE from 'three';
import type { LightValue, PageScene } from '../generated/messages';

const SHADOW_PIXELS = 2048;
const SHADOW_REACH_M = 56;
/** three divides by pi what an old Phong model does not. */
const FULL = Math.PI;

/** What is needed of a light to draw it. */
type Lamp = Omit<LightValue, 'intensity' | 'spot_outer_angle_rad'>;

const STUDIO: Lamp = {
  name: 'key',
  type: 'directional',
  pose: [4, -3, 8, 0, 0, 0, 1],
  direction: [-0.5, 0.35, -0.8],
  diffuse: [0.6, 0.6, 0.6],
  specular: [0.15, 0.15, 0.15],
  range_m: 0,
  cast_shadows: true,
};
const FILL: Lamp = {
  name: 'fill',
  type: 'directional',
  pose: [0, 0, 10, 0, 0, 0, 1],
  direction: [0.5, -0.5, -0.25],
  diffuse: [0.16, 0.17, 0.19],
  specular: [0, 0, 0],
  range_m: 0,
  cast_shadows: false,
};

/** What a view without a world's own light and background is lit with. */
export interface Surroundings {
  lights: Lamp[];
  ambient: number[];
  background: number[];
  sky: boolean;
  shadows: boolean;
}

/** RViz's dark grey room, lit from the eye. */
export const ROOM: Surroundings = {
  lights: [],
  ambient: [0.45, 0.45, 0.45],
  background: [48 / 255, 48 / 255, 48 / 255],
  sky: false,
  shadows: true,
};

/** The surroundings a world names. */
export function surroundings(value: PageScene): Surroundings {
  const { lights, ambient, background, sky, shadows } = value;
  return { lights, ambient, background, sky, shadows };
}

/** All lamps of a view. */
export class Lighting {
  readonly root = new THREE.Group();
  private readonly ambient = new THREE.HemisphereLight();
  private readonly dome = skyDome();
  private suns: THREE.DirectionalLight[] = [];
  private allowed = true;
  /** Whether a world file has said how its scene looks. */
  ofWorld = false;

  constructor(private readonly scene: THREE.Scene) {
    this.root.name = 'lights';
    this.ambient.position.set(0, 0, 1);
    this.dome.visible = false;
    scene.add(this.root, this.dome);
    this.set(ROOM);
  }

  /** Take the lights of a world; without any, two lamps of a studio. */
  set(value: Surroundings): void {
    this.ofWorld = value !== ROOM;
    this.root.clear();
    this.suns = [];
    const [r, g, b] = value.ambient;
    this.ambient.color.setRGB(r, g, b);
    this.ambient.groundColor.setRGB(r * 0.82, g * 0.8, b * 0.78);
    this.ambient.intensity = FULL;
    this.root.add(this.ambient);
    const lights = value.lights.length ? value.lights : [STUDIO, FILL];
    for (const light of lights) this.root.add(...this.lamp(light, value.shadows));
    const [br, bg, bb] = value.background;
    this.scene.background = new THREE.Color(br, bg, bb);
    this.dome.visible = value.sky;
    this.allow(this.allowed);
  }

  /** Shadows at all: quality and the view menu decide. */
  allow(shadows: boolean): void {
    this.allowed = shadows;
    for (const sun of this.suns) sun.castShadow = shadows;
  }

  /** Keep the shadow's square and the sky around what is looked at. */
  aim(focal: THREE.Vector3, distance: number): void {
    const reach = Math.min(SHADOW_REACH_M, Math.max(1.2, distance * 1.2));
    for (const sun of this.suns) {
      const direction = sun.userData.direction as THREE.Vector3;
      const step = (2 * reach) / SHADOW_PIXELS;
      sun.target.position.copy(focal).divideScalar(step).round().multiplyScalar(step);
      sun.position.copy(sun.target.position).addScaledVector(direction, -4 * reach);
      const camera = sun.shadow.camera;
      if (camera.right !== reach) {
        Object.assign(camera, {
          left: -reach,
          right: reach,
          top: reach,
          bottom: -reach,
          near: 0.1,
          far: 8 * reach,
        });
        camera.updateProjectionMatrix();
      }
    }
    this.dome.position.set(focal.x, focal.y, 0);
  }

  private lamp(light: Lamp, shadows: boolean): THREE.Object3D[] {
    const [r, g, b] = light.diffuse;
    const colour = new THREE.Color(r, g, b);
    const place = new THREE.Vector3(light.pose[0], light.pose[1], light.pose[2]);
    const direction = new THREE.Vector3(...light.direction).normalize();
    if (light.type === 'point') {
      const lamp = new THREE.PointLight(colour, FULL, light.range_m, 0);
      lamp.position.copy(place);
      return [lamp];
    }
    if (light.type === 'spot') {
      const lamp = new THREE.SpotLight(colour, FULL, light.range_m, 0.6, 0.4, 0);
      lamp.position.copy(place);
      lamp.target.position.copy(place).add(direction);
      return [lamp, lamp.target];
    }
    return this.sun(colour, direction, shadows && light.cast_shadows);
  }

  private sun(colour: THREE.Color, direction: THREE.Vector3, shadows: boolean): THREE.Object3D[] {
    const lamp = new THREE.DirectionalLight(colour, FULL);
    lamp.userData.direction = direction;
    lamp.position.copy(direction).multiplyScalar(-20);
    if (shadows && !this.suns.length) {
      lamp.shadow.mapSize.set(SHADOW_PIXELS, SHADOW_PIXELS);
      lamp.shadow.bias = -0.0004;
      lamp.shadow.normalBias = 0.01;
      this.suns.push(lamp);
    }
    return [lamp, lamp.target];
  }
}

/** A clear day's sky: paler towards the horizon. */
function skyDome(): THREE.Mesh {
  const material = new THREE.ShaderMaterial({
    side: THREE.BackSide,
    depthWrite: false,
    depthTest: false,
    vertexShader:
      'varying vec3 v; void main() { v = position; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }',
    fragmentShader: `varying vec3 v;
      void main() {
        float up = normalize(v).z;
        vec3 sky = mix(vec3(0.80, 0.87, 0.94), vec3(0.33, 0.55, 0.82), smoothstep(0.0, 0.55, up));
        vec3 ground = vec3(0.62, 0.66, 0.69);
        gl_FragColor = vec4(mix(ground, sky, smoothstep(-0.06, 0.02, up)), 1.0);
      }`,
  });
  const dome = new THREE.Mesh(new THREE.SphereGeometry(400, 24, 16).rotateX(Math.PI / 2), material);
  dome.name = 'sky';
  dome.frustumCulled = false;
  dome.renderOrder = -100;
  return dome;
}
