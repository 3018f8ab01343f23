/** LaserScan, clouds and sensors of one number: points the server coloured, in pooled buffers. */
import * as THREE from 'three';
import { floats, type Frame } from '../binary_frame';
import type { JsonObject } from '../json';
import { place } from '../model/shapes';
import type { Drawing, Drawer, Site } from './display';
import { choice, colour, flag, num, text, type PropertySpec } from './properties';

const STYLES = ['Points', 'Squares', 'Flat Squares', 'Spheres', 'Boxes'] as const;
const PACKED = 29;
const POSE_BYTES = 32;
const CUBE_BYTES = 8;
const LEVELS = 65535;
const MOST_FRAMES = 200;
const SERVER = { server: true };

const COMMON: PropertySpec[] = [
  choice('Style', 'Flat Squares', STYLES, 'How a point is drawn.'),
  num('Size (m)', 0.01, 'Size of a point, metres.', { min: 0.0001 }),
  num('Size (Pixels)', 3, 'Size of a point in the style Points.', { min: 1, max: 100 }),
  num('Alpha', 1, 'How opaque the points are, 0 to 1.', { min: 0, max: 1 }),
  num('Decay Time', 0, 'How long points stay, seconds; 0 until the next ones come.', { min: 0 }),
  choice(
    'Color Transformer',
    '',
    ['', 'Intensity', 'AxisColor', 'RGB8', 'FlatColor'],
    'Where the colour comes from; empty: what the fields offer.',
    SERVER,
  ),
  text('Channel Name', 'intensity', 'The field that gives the colour.', SERVER),
  flag('Use rainbow', true, 'A rainbow in place of two colours.', SERVER),
  flag('Invert Rainbow', false, 'The rainbow the other way round.', SERVER),
  colour('Min Color', '0; 0; 0', 'The colour of the least intensity.', SERVER),
  colour('Max Color', '255; 255; 255', 'The colour of the greatest intensity.', SERVER),
  flag('Autocompute Intensity Bounds', true, 'Take the bounds from each message.', SERVER),
  num('Min Intensity', 0, 'The lower bound.', SERVER),
  num('Max Intensity', 4096, 'The upper bound.', SERVER),
  choice('Axis', 'Z', ['X', 'Y', 'Z'], 'The axis of AxisColor.', SERVER),
  flag('Autocompute Value Bounds', true, 'Take the bounds of AxisColor from each message.', SERVER),
  num('Autocompute Value Bounds/Min Value', -10, 'The lower bound of AxisColor.', SERVER),
  num('Autocompute Value Bounds/Max Value', 10, 'The upper bound of AxisColor.', SERVER),
  flag('Use Fixed Frame', true, 'AxisColor along the axes of the fixed frame.', SERVER),
  colour('Color', '255; 255; 255', 'The colour of FlatColor.', SERVER),
  num(
    'Point Budget',
    100000,
    'Most points of one message that are sent to the page, evenly chosen.',
    { min: 1, ...SERVER },
  ),
];

/** Points whose properties begin with other values than usual, and that have more of them. */
function points(values: JsonObject = {}, extra: PropertySpec[] = []): Drawing {
  const properties = COMMON.map((spec) => ({ ...spec, value: values[spec.path] ?? spec.value }));
  return {
    ownPose: true,
    properties: [...properties, ...extra],
    make: (site) => new PointsDrawer(site),
  };
}

/** A sensor of one number: a point whose colour tells it, between bounds as RViz has them. */
function reading(channel: string, least: number, most: number, inverted = false): Drawing {
  return points({
    'Channel Name': channel,
    'Invert Rainbow': inverted,
    'Autocompute Intensity Bounds': false,
    'Min Intensity': least,
    'Max Intensity': most,
  });
}

/** RViz's LaserScan. */
export const LASER_SCAN = points({ 'Size (m)': 0.03 });

/** RViz's PointCloud and PointCloud2. */
export const POINT_CLOUD = points();

/** RViz's DepthCloud. */
export const DEPTH_CLOUD = points({}, [
  {
    path: 'Color Image Topic',
    kind: 'topic',
    value: '',
    types: ['sensor_msgs/Image'],
    about: 'The image that gives the colours.',
    server: true,
  },
]);

/** RViz's FluidPressure, pascals. */
export const FLUID_PRESSURE = reading('fluid_pressure', 98000, 105000);

/** RViz's Illuminance, lux. */
export const ILLUMINANCE = reading('illuminance', 0, 1000);

/** RViz's RelativeHumidity, 0 to 1. */
export const RELATIVE_HUMIDITY = reading('relative_humidity', 0, 1);

/** RViz's Temperature, degrees Celsius: red is hot. */
export const TEMPERATURE = reading('temperature', 0, 100, true);

const VERTEX = `
  attribute vec4 tint; uniform float size, pixels, scale, alpha; varying vec4 shade;
  void main() {
    vec4 eye = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * eye;
    gl_PointSize = pixels > 0.0 ? pixels : clamp(size * scale * projectionMatrix[1][1] / gl_Position.w, 1.5, 200.0);
    shade = vec4(tint.rgb, tint.a * alpha);
  }`;
const FRAGMENT = `
  uniform int form; varying vec4 shade;
  void main() {
    vec3 colour = shade.rgb; vec2 p = gl_PointCoord * 2.0 - 1.0;
    if (form == 1) { float r = dot(p, p); if (r > 1.0) discard; colour *= 0.55 + 0.45 * sqrt(1.0 - r); }
    if (form == 2) { colour *= p.y < -0.45 ? 1.0 : (p.x > 0.45 ? 0.6 : 0.8); }
    gl_FragColor = vec4(colour, shade.a);
  }`;

/** The points of one message. */
class Cloud {
  readonly points: THREE.Points;
  born = 0;
  private capacity = 0;
  private packed = false;

  constructor(material: THREE.Material) {
    this.points = new THREE.Points(new THREE.BufferGeometry(), material);
    this.points.frustumCulled = false;
  }

  take(frame: Frame, pose: ArrayLike<number>): void {
    const count = frame.count;
    const packed = frame.kind === PACKED;
    if (count > this.capacity || packed !== this.packed) this.grow(count, packed);
    const geometry = this.points.geometry;
    const position = geometry.getAttribute('position') as THREE.BufferAttribute;
    const tint = geometry.getAttribute('tint') as THREE.BufferAttribute;
    place(this.points, pose);
    this.points.scale.set(1, 1, 1);
    const begin = packed ? POSE_BYTES + CUBE_BYTES : POSE_BYTES;
    if (packed) {
      this.stretch(frame);
      (position.array as Uint16Array).set(
        new Uint16Array(frame.buffer, frame.offset + begin + count * 4, count * 3),
      );
    } else {
      (position.array as Float32Array).set(floats(frame, count * 3, begin));
    }
    (tint.array as Uint8Array).set(
      new Uint8Array(frame.buffer, frame.offset + begin + (packed ? 0 : count * 12), count * 4),
    );
    for (const [attribute, used] of [
      [position, count * 3],
      [tint, count * 4],
    ] as const) {
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, used);
      attribute.needsUpdate = true;
    }
    geometry.setDrawRange(0, count);
    this.points.visible = true;
  }

  dispose(): void {
    this.points.geometry.dispose();
  }

  /** Packed positions are levels 0 to 1 of the cloud's cube. */
  private stretch(frame: Frame): void {
    const [origin, step] = floats(frame, 2, POSE_BYTES);
    this.points.position.add(
      new THREE.Vector3(origin, origin, origin).applyQuaternion(this.points.quaternion),
    );
    this.points.scale.setScalar(step * LEVELS);
  }

  private grow(count: number, packed: boolean): void {
    this.packed = packed;
    this.capacity = Math.ceil(count * 1.25) + 64;
    this.points.geometry.dispose();
    const geometry = new THREE.BufferGeometry();
    const values = packed
      ? new Uint16Array(this.capacity * 3)
      : new Float32Array(this.capacity * 3);
    const position = new THREE.BufferAttribute(values, 3, packed);
    const tint = new THREE.BufferAttribute(new Uint8Array(this.capacity * 4), 4, true);
    geometry.setAttribute('position', position.setUsage(THREE.DynamicDrawUsage));
    geometry.setAttribute('tint', tint.setUsage(THREE.DynamicDrawUsage));
    // Known to be everywhere: three would look at every point of every message to sort the clouds.
    geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), Infinity);
    this.points.geometry = geometry;
  }
}

class PointsDrawer implements Drawer {
  private readonly material = new THREE.ShaderMaterial({
    uniforms: {
      size: { value: 0.01 },
      pixels: { value: 0 },
      scale: { value: 1 },
      alpha: { value: 1 },
      form: { value: 0 },
    },
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
  });
  private readonly living: Cloud[] = [];
  private readonly spare: Cloud[] = [];
  private readonly stop: () => void;

  constructor(private readonly site: Site) {
    this.stop = site.view.beforeDraw(() => this.tick());
  }

  frame(frame: Frame): void {
    const pose = floats(frame, 8);
    const { frames, status, view } = this.site;
    if (Number.isNaN(pose[0])) {
      status('Transform', 'error', `No transform to [${frames.fixed}]`);
      return;
    }
    status('Transform', 'ok', 'Transform OK');
    status(
      'Points',
      frame.count ? 'ok' : 'warn',
      `Showing [${frame.count}]${pose[7] > frame.count ? ` of [${pose[7]}]` : ''} points from [1] messages`,
    );
    const cloud = this.next();
    cloud.take(frame, pose);
    cloud.born = performance.now();
    view.invalidate();
  }

  changed(): void {
    const { props, view } = this.site;
    const style = props.text('Style');
    const uniforms = this.material.uniforms;
    uniforms.size.value = props.num('Size (m)');
    uniforms.pixels.value =
      style === 'Points' ? props.num('Size (Pixels)') * view.renderer.getPixelRatio() : 0;
    uniforms.form.value = style === 'Spheres' ? 1 : style === 'Boxes' ? 2 : 0;
    uniforms.alpha.value = props.num('Alpha');
    this.material.transparent = props.num('Alpha') < 1;
    this.material.depthWrite = props.num('Alpha') >= 1;
  }

  clear(): void {
    while (this.living.length) this.retire();
  }

  dispose(): void {
    this.stop();
    this.spare.forEach((cloud) => cloud.dispose());
    this.material.dispose();
  }

  counts(): Record<string, number> {
    const points = this.living.reduce(
      (sum, cloud) => sum + cloud.points.geometry.drawRange.count,
      0,
    );
    return { points, clouds: this.living.length };
  }

  /** A cloud to fill: the one that is shown, or with a decay time one more. */
  private next(): Cloud {
    const decay = this.site.props.num('Decay Time');
    if (decay <= 0) while (this.living.length > 1) this.retire();
    if (decay <= 0 && this.living.length) return this.living[0];
    if (this.living.length >= MOST_FRAMES) this.retire();
    const cloud = this.spare.pop() ?? new Cloud(this.material);
    this.living.push(cloud);
    this.site.root.add(cloud.points);
    return cloud;
  }

  private retire(): void {
    const cloud = this.living.shift();
    if (!cloud) return;
    this.site.root.remove(cloud.points);
    if (this.spare.length < MOST_FRAMES) this.spare.push(cloud);
  }

  private tick(): void {
    const { view, props } = this.site;
    this.material.uniforms.scale.value =
      (view.host.clientHeight * view.renderer.getPixelRatio()) / 2;
    const decay = props.num('Decay Time') * 1000;
    if (!decay) return;
    const now = performance.now();
    while (this.living.length && now - this.living[0].born > decay) this.retire();
    if (this.living.length) view.wakeIn(Math.max(30, decay - (now - this.living[0].born)));
  }
}
