/** All markers of a display: instanced pools by shape and opacity, and single objects. */
import * as THREE from 'three';
import type { Marker } from '../generated/messages';
import {
  solidGeometry,
  instancesOf,
  singleOf,
  type Instance,
  type Single,
  type Solid,
} from './marker_shapes';
import { poseMatrix, seconds } from './message_fields';
import { InstancePool } from './instanced_shapes';

interface Kept {
  marker: Marker;
  base: THREE.Matrix4;
  single: Single | null;
  instances: Instance[];
  /** When it goes, by the page's clock; Infinity for those that stay. */
  until_ms: number;
}

const ADD = 0,
  DELETE = 2,
  DELETE_ALL = 3;
const TINT = new THREE.Color();

/** Keeps markers by namespace and id. */
export class MarkerSet {
  private readonly kept = new Map<string, Kept>();
  private readonly pools = new Map<string, InstancePool>();
  private readonly paints = new Map<string, THREE.MeshPhongMaterial>();
  private stale = false;

  constructor(
    private readonly root: THREE.Object3D,
    private readonly changed: () => void,
    private readonly shows: (namespace: string) => boolean = () => true,
  ) {}

  get size(): number {
    return this.kept.size;
  }

  /** Take a marker; `base` is where its header's frame is. Returns what is wrong with it. */
  take(marker: Marker, base: THREE.Matrix4): string | null {
    const key = `${marker.ns}/${marker.id}`;
    if (marker.action === DELETE_ALL) {
      this.clear();
      return null;
    }
    if (marker.action === DELETE) {
      this.remove(key);
      return null;
    }
    if (marker.action !== ADD) return `Unknown action ${marker.action}`;
    this.remove(key);
    const problem = wrong(marker);
    const instances = instancesOf(marker, base);
    const single = instances.length ? null : singleOf(marker, this.changed);
    const life = seconds(marker.lifetime);
    const until_ms = life > 0 ? performance.now() + life * 1000 : Infinity;
    this.kept.set(key, { marker, base, single, instances, until_ms });
    if (single) {
      single.object.applyMatrix4(base.clone().multiply(poseMatrix(marker.pose)));
      single.object.visible = this.shows(marker.ns);
      this.root.add(single.object);
    }
    this.stale = true;
    return problem;
  }

  /** Show or hide namespaces anew. */
  refresh(): void {
    for (const { single, marker } of this.kept.values()) {
      if (single) single.object.visible = this.shows(marker.ns);
    }
    this.stale = true;
  }

  /** Before a frame: let old markers go, fill the pools. Returns when it must be called again, ms. */
  tick(now = performance.now()): number {
    let next = Infinity;
    this.kept.forEach((each, key) => {
      if (each.until_ms <= now) this.remove(key);
      else next = Math.min(next, each.until_ms);
    });
    if (this.stale) this.fill();
    return next - now;
  }

  namespaces(): string[] {
    return [...new Set([...this.kept.values()].map((each) => each.marker.ns))];
  }

  /** How many markers of each type are kept, by the number of the type. */
  counts(): Record<string, number> {
    const found: Record<string, number> = { markers: this.kept.size, drawCalls: this.pools.size };
    this.kept.forEach(
      ({ marker }) => (found[`type${marker.type}`] = (found[`type${marker.type}`] ?? 0) + 1),
    );
    return found;
  }

  clear(): void {
    [...this.kept.keys()].forEach((key) => this.remove(key));
    this.fill();
  }

  dispose(): void {
    this.clear();
    this.pools.forEach((pool) => pool.dispose());
    this.paints.forEach((paint) => paint.dispose());
  }

  private remove(key: string): void {
    const old = this.kept.get(key);
    if (!old) return;
    this.kept.delete(key);
    this.stale = true;
    if (!old.single) return;
    this.root.remove(old.single.object);
    old.single.free();
  }

  private fill(): void {
    this.stale = false;
    this.pools.forEach((pool) => pool.begin());
    this.kept.forEach(({ marker, instances }) => {
      if (!this.shows(marker.ns)) return;
      for (const { solid, matrix, colour } of instances) {
        this.pool(solid, colour.a).put(matrix, TINT.setRGB(colour.r, colour.g, colour.b));
      }
    });
    this.pools.forEach((pool) => pool.end());
  }

  private pool(solid: Solid, alpha: number): InstancePool {
    const opacity = Math.round(Math.max(0, Math.min(1, alpha)) * 20) / 20;
    const key = `${solid} ${opacity}`;
    let found = this.pools.get(key);
    if (!found) {
      const paint = new THREE.MeshPhongMaterial({
        opacity,
        transparent: opacity < 1,
        depthWrite: opacity === 1,
      });
      this.paints.set(key, paint);
      found = new InstancePool(this.root, solidGeometry(solid), paint);
      this.pools.set(key, found);
    }
    return found;
  }
}

/** What RViz would warn of. */
function wrong({
  scale,
  color,
  type,
  ns,
  id,
  points,
  mesh,
  mesh_resource: resource,
}: Marker): string | null {
  const name = `${ns}/${id}`;
  if (color.a === 0 && type !== 10 && !(points.length && type >= 4))
    return `Marker ${name} is invisible: its color.a is 0`;
  if (type <= 3 && !points.length && scale.x * scale.y * scale.z === 0)
    return `Marker ${name}: scale contains 0.0 in x, y or z`;
  if ((type === 4 || type === 5) && scale.x === 0)
    return `Marker ${name}: scale.x is 0, the line has no width`;
  if (type === 10 && !mesh?.length) return `Marker ${name}: could not load [${resource}]`;
  if (type > 11) return `Marker ${name}: unknown type ${type}`;
  return null;
}
