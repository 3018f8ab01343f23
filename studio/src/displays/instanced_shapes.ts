/** Many equal things at once: pools that grow, and the arrows and axes of RViz's Shape property. */
import * as THREE from 'three';
import { arrowGeometry, axesGeometry, flatArrowGeometry } from '../model/geometry';
import { choice, colour, num, type Properties, type PropertySpec } from './properties';

/** Instances of one geometry; grows by doubling, never shrinks. */
export class InstancePool {
  private mesh: THREE.InstancedMesh | null = null;
  private used = 0;

  constructor(
    private readonly parent: THREE.Object3D,
    private geometry: THREE.BufferGeometry,
    private readonly paint: THREE.Material,
    private readonly tell: (mesh: THREE.InstancedMesh) => void = () => undefined,
  ) {}

  get count(): number {
    return this.used;
  }

  /** Begin anew; what is put from now on is what is shown at `end`. */
  begin(): void {
    this.used = 0;
  }

  put(matrix: THREE.Matrix4, tint?: THREE.Color): void {
    const mesh = this.room();
    mesh.setMatrixAt(this.used, matrix);
    if (tint) mesh.setColorAt(this.used, tint);
    this.used += 1;
  }

  end(): void {
    if (!this.mesh) return;
    this.mesh.count = this.used;
    this.mesh.visible = this.used > 0;
    this.mesh.instanceMatrix.needsUpdate = true;
    if (this.mesh.instanceColor) this.mesh.instanceColor.needsUpdate = true;
  }

  /** Take another geometry (its properties changed). */
  reshape(geometry: THREE.BufferGeometry): void {
    this.geometry.dispose();
    this.geometry = geometry;
    if (this.mesh) this.mesh.geometry = geometry;
  }

  dispose(): void {
    if (this.mesh) {
      this.parent.remove(this.mesh);
      this.mesh.dispose();
    }
    this.mesh = null;
  }

  private room(): THREE.InstancedMesh {
    const capacity = this.mesh?.instanceMatrix.count ?? 0;
    if (this.mesh && this.used < capacity) return this.mesh;
    const next = new THREE.InstancedMesh(this.geometry, this.paint, Math.max(8, capacity * 2));
    next.frustumCulled = false;
    // Known to be everywhere: three would look at all instances whenever one moved.
    next.boundingSphere = new THREE.Sphere(new THREE.Vector3(), Infinity);
    this.tell(next);
    if (this.mesh) {
      next.instanceMatrix.array.set(this.mesh.instanceMatrix.array);
      if (this.mesh.instanceColor) {
        next.setColorAt(0, WHITE);
        next.instanceColor?.array.set(this.mesh.instanceColor.array);
      }
      this.dispose();
    }
    this.mesh = next;
    this.parent.add(next);
    return next;
  }
}

const WHITE = new THREE.Color(1, 1, 1);

/** RViz's properties of an arrow or axes, under a prefix such as `Shape/`. */
export function shapeProperties(
  shape: 'Arrow' | 'Axes' | 'Arrow (Flat)',
  prefix = '',
  flat = false,
): PropertySpec[] {
  const options = flat ? ['Arrow (Flat)', 'Arrow (3D)', 'Axes'] : ['Arrow', 'Axes'];
  return [
    choice(prefix ? prefix.slice(0, -1) : 'Shape', shape, options, 'What is drawn at the pose.'),
    colour(`${prefix}Color`, '255; 25; 0', 'Colour of the arrow.'),
    num(`${prefix}Alpha`, 1, 'How opaque the arrow is, 0 to 1.', { min: 0, max: 1 }),
    num(`${prefix}Shaft Length`, flat ? 0.23 : 1, 'Length of the shaft, metres.', { min: 0 }),
    num(`${prefix}Shaft Radius`, flat ? 0.01 : 0.05, 'Radius of the shaft, metres.', { min: 0 }),
    num(`${prefix}Head Length`, flat ? 0.07 : 0.3, 'Length of the head, metres.', { min: 0 }),
    num(`${prefix}Head Radius`, flat ? 0.03 : 0.1, 'Radius of the head, metres.', { min: 0 }),
    num(`${prefix}Axes Length`, flat ? 0.3 : 1, 'Length of the axes, metres.', { min: 0 }),
    num(`${prefix}Axes Radius`, flat ? 0.01 : 0.1, 'Radius of the axes, metres.', { min: 0 }),
  ];
}

/**
 * Arrows or axes at any number of poses, by the properties of `shapeProperties`. Flat arrows have
 * the length of the property `flatLength`.
 */
export class PoseShapes {
  private readonly arrowPaint = new THREE.MeshPhongMaterial({ color: 0xffffff });
  private readonly flatPaint = new THREE.MeshBasicMaterial({ side: THREE.DoubleSide });
  private readonly axesPaint = new THREE.MeshPhongMaterial({ vertexColors: true });
  private readonly arrows: InstancePool;
  private readonly flat: InstancePool;
  private readonly axes: InstancePool;

  constructor(
    parent: THREE.Object3D,
    private readonly props: Properties,
    private readonly prefix = '',
    private readonly flatLength = '',
  ) {
    this.arrows = new InstancePool(parent, new THREE.BufferGeometry(), this.arrowPaint);
    this.flat = new InstancePool(parent, new THREE.BufferGeometry(), this.flatPaint);
    this.axes = new InstancePool(parent, new THREE.BufferGeometry(), this.axesPaint);
    this.restyle();
  }

  get count(): number {
    return this.arrows.count + this.flat.count + this.axes.count;
  }

  /** Take changed properties. */
  restyle(): void {
    const n = (name: string): number => Math.max(1e-4, this.props.num(this.prefix + name));
    const [r, g, b] = this.props.colour(`${this.prefix}Color`);
    const alpha = this.props.num(`${this.prefix}Alpha`);
    for (const paint of [this.arrowPaint, this.flatPaint]) {
      paint.color.setRGB(r, g, b);
      paint.opacity = alpha;
      paint.transparent = alpha < 1;
    }
    if (this.flatLength) this.flat.reshape(flatArrowGeometry(n(this.flatLength)));
    this.arrows.reshape(
      arrowGeometry(n('Shaft Length'), n('Shaft Radius'), n('Head Length'), n('Head Radius')),
    );
    this.axes.reshape(axesGeometry(n('Axes Length'), n('Axes Radius')));
  }

  /** Show these poses (matrices in the parent's frame). */
  set(poses: readonly THREE.Matrix4[]): void {
    const shape = this.props.text(this.prefix ? this.prefix.slice(0, -1) : 'Shape');
    const used =
      shape === 'Axes'
        ? this.axes
        : shape === 'Arrow (Flat)' && this.flatLength
          ? this.flat
          : this.arrows;
    for (const pool of [this.arrows, this.flat, this.axes]) {
      pool.begin();
      if (pool === used) poses.forEach((pose) => pool.put(pose));
      pool.end();
    }
  }

  dispose(): void {
    for (const pool of [this.arrows, this.flat, this.axes]) pool.dispose();
  }
}
