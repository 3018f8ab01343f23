/** Odometry: where something was, with as many arrows as Keep says. */
import * as THREE from 'three';
import type { JsonObject } from '../json';
import { Covariance, covarianceProperties, type Uncertain } from './covariance';
import type { Drawing, Drawer, Site } from './display';
import { arrayMatrix, numbers, part, poseMatrix } from './message_fields';
import { num } from './properties';
import { PoseShapes, shapeProperties } from './instanced_shapes';

/** RViz's Odometry. */
export const ODOMETRY: Drawing = {
  ownPose: true,
  properties: [
    num('Position Tolerance', 0.1, 'A new arrow after so many metres.', { min: 0 }),
    num('Angle Tolerance', 0.1, 'A new arrow after so many radians.', { min: 0 }),
    num('Keep', 100, 'How many arrows stay.', { min: 0, max: 10000 }),
    ...shapeProperties('Arrow', 'Shape/'),
    ...covarianceProperties(),
  ],
  make: (site) => new OdometryDrawer(site),
};

class OdometryDrawer implements Drawer {
  private readonly shapes: PoseShapes;
  private readonly covariance: Covariance;
  private kept: Uncertain[] = [];

  constructor(private readonly site: Site) {
    this.shapes = new PoseShapes(site.root, site.props, 'Shape/');
    this.covariance = new Covariance(site.root, site.props);
  }

  take(value: JsonObject): void {
    const { frames, status, props } = this.site;
    const frame = arrayMatrix(value.pose);
    if (!frame)
      return status(
        'Transform',
        'error',
        `No transform from [${String(value.frame)}] to [${frames.fixed}]`,
      );
    status('Transform', 'ok', 'Transform OK');
    const message = part(value, 'message');
    const pose = frame.multiply(poseMatrix(part(message, 'pose').pose));
    const last = this.kept[this.kept.length - 1];
    if (last && this.isNear(last.pose, pose)) return;
    this.kept.push({ pose, values: numbers(part(message, 'pose').covariance) });
    this.kept = this.kept.slice(-Math.max(1, props.num('Keep')));
    this.draw();
  }

  changed(): void {
    this.shapes.restyle();
    this.covariance.restyle();
    this.kept = this.kept.slice(-Math.max(1, this.site.props.num('Keep')));
    this.draw();
  }

  clear(): void {
    this.kept = [];
    this.draw();
  }

  dispose(): void {
    this.shapes.dispose();
  }

  counts(): Record<string, number> {
    return { arrows: this.shapes.count, covariances: this.covariance.count };
  }

  private isNear(a: THREE.Matrix4, b: THREE.Matrix4): boolean {
    const [p, q] = [
      new THREE.Vector3().setFromMatrixPosition(a),
      new THREE.Vector3().setFromMatrixPosition(b),
    ];
    const [s, t] = [
      new THREE.Quaternion().setFromRotationMatrix(a),
      new THREE.Quaternion().setFromRotationMatrix(b),
    ];
    const { props } = this.site;
    return (
      p.distanceTo(q) < props.num('Position Tolerance') &&
      s.angleTo(t) < props.num('Angle Tolerance')
    );
  }

  private draw(): void {
    this.shapes.set(this.kept.map((each) => each.pose));
    this.covariance.set(this.kept);
  }
}
