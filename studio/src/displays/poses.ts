/** Pose, PoseArray, PoseWithCovariance and PointStamped. */
import * as THREE from 'three';
import { unit } from '../model/geometry';
import type { JsonObject } from '../json';
import { Covariance, covarianceProperties } from './covariance';
import type { Drawing, Drawer, Site } from './display';
import { list, numbers, part, poseMatrix, vector } from './message_fields';
import { colour, num, type Properties } from './properties';
import { InstancePool, PoseShapes, shapeProperties } from './instanced_shapes';

/** RViz's Pose. */
export const POSE: Drawing = {
  properties: shapeProperties('Arrow'),
  make: (site) => new PosesDrawer(site, (message) => [poseMatrix(message.pose)]),
};

/** RViz's PoseArray. */
export const POSE_ARRAY: Drawing = {
  properties: [
    ...shapeProperties('Arrow (Flat)', '', true),
    num('Arrow Length', 0.3, 'Length of a flat arrow, metres.', { min: 0 }),
  ],
  make: (site) =>
    new PosesDrawer(
      site,
      (message) => list(message, 'poses').map((pose) => poseMatrix(pose as never)),
      null,
      'Arrow Length',
    ),
};

/** Nav2's ParticleCloud: the likelier a particle the longer its arrow. */
export const PARTICLE_CLOUD: Drawing = {
  properties: [
    ...shapeProperties('Arrow (Flat)', '', true),
    num('Min Arrow Length', 0.02, 'Length of the least likely one, metres.', { min: 0 }),
    num('Max Arrow Length', 0.3, 'Length of the likeliest one, metres.', { min: 0.001 }),
  ],
  make: (site) =>
    new PosesDrawer(site, (message) => particles(message, site.props), null, 'Max Arrow Length'),
};

function particles(message: JsonObject, props: Properties): THREE.Matrix4[] {
  const found = list<{ pose: JsonObject; weight: number }>(message, 'particles');
  const most = found.reduce((top, each) => Math.max(top, each.weight), 0) || 1;
  const [least_m, most_m] = [props.num('Min Arrow Length'), props.num('Max Arrow Length')];
  return found.map(({ pose, weight }) => {
    const part = Math.max(least_m / most_m, weight / most);
    return poseMatrix(pose).scale(new THREE.Vector3(part, part, part));
  });
}

/** RViz's PoseWithCovariance. */
export const POSE_WITH_COVARIANCE: Drawing = {
  properties: [...shapeProperties('Arrow'), ...covarianceProperties()],
  make: (site) =>
    new PosesDrawer(
      site,
      (message) => [poseMatrix(part(message, 'pose').pose)],
      (message) => numbers(part(message, 'pose').covariance),
    ),
};

class PosesDrawer implements Drawer {
  private readonly shapes: PoseShapes;
  private readonly covariance: Covariance | null;
  private last: JsonObject | null = null;

  constructor(
    site: Site,
    private readonly posesOf: (message: JsonObject) => THREE.Matrix4[],
    private readonly covarianceOf: ((message: JsonObject) => number[]) | null = null,
    flatLength = '',
  ) {
    this.shapes = new PoseShapes(site.root, site.props, '', flatLength);
    this.covariance = covarianceOf ? new Covariance(site.root, site.props) : null;
  }

  take(value: JsonObject): void {
    this.last = part(value, 'message');
    this.draw();
  }

  changed(): void {
    this.shapes.restyle();
    this.covariance?.restyle();
    this.draw();
  }

  clear(): void {
    this.last = null;
    this.draw();
  }

  dispose(): void {
    this.shapes.dispose();
  }

  counts(): Record<string, number> {
    return { poses: this.shapes.count, covariances: this.covariance?.count ?? 0 };
  }

  private draw(): void {
    const poses = this.last ? this.posesOf(this.last) : [];
    this.shapes.set(poses);
    if (!this.covariance || !this.covarianceOf) return;
    this.covariance.set(
      this.last ? [{ pose: poses[0], values: this.covarianceOf(this.last) }] : [],
    );
  }
}

/** RViz's PointStamped. */
export const POINT_STAMPED: Drawing = {
  ownPose: true,
  properties: [
    colour('Color', '204; 41; 204', 'Colour of the balls.'),
    num('Alpha', 1, 'How opaque the balls are, 0 to 1.', { min: 0, max: 1 }),
    num('Radius', 0.2, 'Radius of the balls, metres.', { min: 0.001 }),
    num('History Length', 1, 'How many points stay.', { min: 1, max: 100000 }),
  ],
  make(site) {
    const paint = new THREE.MeshPhongMaterial();
    const pool = new InstancePool(site.root, unit.ball(), paint);
    let points: THREE.Vector3[] = [];
    const draw = (): void => {
      const radius = site.props.num('Radius');
      pool.begin();
      for (const { x, y, z } of points)
        pool.put(new THREE.Matrix4().makeScale(radius, radius, radius).setPosition(x, y, z));
      pool.end();
    };
    return {
      take(value) {
        const { frames, status } = site;
        const pose = value.pose;
        if (!Array.isArray(pose))
          return status(
            'Transform',
            'error',
            `No transform from [${String(value.frame)}] to [${frames.fixed}]`,
          );
        const [x, y, z, qx, qy, qz, qw] = pose as number[];
        const point = vector(part(value, 'message').point).applyQuaternion(
          new THREE.Quaternion(qx, qy, qz, qw),
        );
        points.push(point.add(new THREE.Vector3(x, y, z)));
        points = points.slice(-Math.max(1, site.props.num('History Length')));
        status('Transform', 'ok', 'Transform OK');
        draw();
      },
      changed() {
        paint.color.setRGB(...site.props.colour('Color'));
        paint.opacity = site.props.num('Alpha');
        paint.transparent = paint.opacity < 1;
        draw();
      },
      clear() {
        points = [];
        draw();
      },
      dispose: () => pool.dispose(),
      counts: () => ({ points: points.length }),
    };
  },
};
