/** Lines of a width in metres or pixels, in buffers that are kept. */
import * as THREE from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';

/** Thin lines (one pixel) that grow as they need. */
export class ThinLines {
  readonly object: THREE.LineSegments;
  private readonly material = new THREE.LineBasicMaterial();

  constructor(parent: THREE.Object3D) {
    this.object = new THREE.LineSegments(new THREE.BufferGeometry(), this.material);
    this.object.frustumCulled = false;
    this.object.visible = false;
    parent.add(this.object);
  }

  paint(colour: [number, number, number], alpha: number): void {
    this.material.color.setRGB(...colour);
    this.material.opacity = alpha;
    this.material.transparent = alpha < 1;
  }

  /** Pairs of points, three numbers each. */
  set(points: readonly number[]): void {
    const old = this.object.geometry.getAttribute('position') as THREE.BufferAttribute | undefined;
    if (!old || old.array.length < points.length) {
      this.object.geometry.dispose();
      this.object.geometry = new THREE.BufferGeometry();
      const array = new Float32Array(Math.ceil(points.length * 1.5));
      this.object.geometry.setAttribute(
        'position',
        new THREE.BufferAttribute(array, 3).setUsage(THREE.DynamicDrawUsage),
      );
    }
    const attribute = this.object.geometry.getAttribute('position') as THREE.BufferAttribute;
    (attribute.array as Float32Array).set(points);
    attribute.needsUpdate = true;
    this.object.geometry.setDrawRange(0, points.length / 3);
    this.object.visible = points.length > 0;
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.material.dispose();
  }
}

/** Lines of a width in metres. */
export class WideLines {
  readonly object: LineSegments2;
  private readonly material = new LineMaterial({ worldUnits: true, linewidth: 0.03 });

  constructor(parent: THREE.Object3D) {
    this.object = new LineSegments2(new LineSegmentsGeometry(), this.material);
    this.object.frustumCulled = false;
    this.object.visible = false;
    this.object.raycast = () => undefined;
    parent.add(this.object);
  }

  paint(colour: [number, number, number], alpha: number, width_m: number): void {
    this.material.color.setRGB(...colour);
    this.material.opacity = alpha;
    this.material.transparent = alpha < 1;
    this.material.linewidth = Math.max(width_m, 1e-4);
  }

  /** Pairs of points; colours of the points (three numbers each), or one colour for all. */
  set(points: readonly number[], colours: readonly number[] | null = null): void {
    this.object.visible = points.length > 0;
    if (!points.length) return;
    this.object.geometry.dispose();
    const geometry = new LineSegmentsGeometry();
    geometry.setPositions(points as number[]);
    if (colours) geometry.setColors(colours as number[]);
    if (this.material.vertexColors !== Boolean(colours)) {
      this.material.vertexColors = Boolean(colours);
      this.material.needsUpdate = true;
    }
    this.object.geometry = geometry;
  }

  dispose(): void {
    this.object.parent?.remove(this.object);
    this.object.geometry.dispose();
    this.material.dispose();
  }
}

/** The pairs of points of a strip. */
export function strip(
  points: readonly { x: number; y: number; z: number }[],
  closed = false,
): number[] {
  const found: number[] = [];
  for (let i = 1; i < points.length; i++) push(found, points[i - 1], points[i]);
  if (closed && points.length > 2) push(found, points[points.length - 1], points[0]);
  return found;
}

function push(into: number[], ...points: { x: number; y: number; z: number }[]): void {
  for (const { x, y, z } of points) into.push(x, y, z);
}
