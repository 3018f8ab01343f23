/** Effort: arrows and rings at the joints, as large as their effort of the limit. */
import * as THREE from 'three';
import { arrowGeometry, joined, shared } from '../model/geometry';
import { matrixOf } from '../model/assembly';
import type { JointValue, PageScene } from '../generated/messages';
import type { JsonObject } from '../json';
import { asCallError } from '../errors';
import type { Drawing, Drawer, Site } from './display';
import { numbers, part, list } from './message_fields';
import { flag, num, text } from './properties';
import { InstancePool } from './instanced_shapes';

/** RViz's Effort. */
export const EFFORT: Drawing = {
  ownPose: true,
  properties: [
    num('Alpha', 1, 'How opaque the arrows are, 0 to 1.', { min: 0, max: 1 }),
    num('Width', 0.02, 'Width of the arrows, metres.', { min: 0.001 }),
    num('Scale', 1, 'Size of an arrow at the limit, metres.', { min: 0.001 }),
    text('Robot Description', 'robot_description', 'The parameter with the URDF.'),
    text('TF Prefix', '', 'Put before the names of the links.'),
    flag('Joints/All Enabled', true, 'All joints on or off.'),
  ],
  make: (site) => new EffortDrawer(site),
};

class EffortDrawer implements Drawer {
  private readonly paint = new THREE.MeshPhongMaterial();
  private readonly pool: InstancePool;
  private joints = new Map<string, { joint: JointValue; frame: string }>();
  private last: JsonObject | null = null;

  constructor(private readonly site: Site) {
    const geometry = shared('effort', () =>
      joined([
        arrowGeometry(0.75, 0.04, 0.25, 0.09),
        new THREE.TorusGeometry(0.4, 0.03, 8, 40, 1.6 * Math.PI).rotateY(Math.PI / 2),
      ]),
    );
    this.pool = new InstancePool(site.root, geometry, this.paint);
  }

  take(value: JsonObject): void {
    this.last = part(value, 'message');
    this.draw();
  }

  changed(path: string): void {
    this.paint.opacity = this.site.props.num('Alpha');
    this.paint.transparent = this.paint.opacity < 1;
    if (['', 'Robot Description', 'TF Prefix'].includes(path)) void this.load();
    this.draw();
  }

  clear(): void {
    this.last = null;
    this.draw();
  }

  dispose(): void {
    this.pool.dispose();
  }

  counts(): Record<string, number> {
    return { joints: this.joints.size, arrows: this.pool.count };
  }

  private async load(): Promise<void> {
    const { connection, props, graph, status, offer } = this.site;
    const prefix = props.text('TF Prefix');
    const topic = '/robot_description';
    const isTopic = graph.value.topics.some((each) => each.name === topic);
    const source: JsonObject = isTopic ? { topic } : { parameter: props.text('Robot Description') };
    try {
      const scene = (await connection.call('robot.get', {
        ...source,
        tf_prefix: prefix,
      })) as unknown as PageScene;
      const moving = scene.joints.filter((joint) => joint.type !== 'fixed');
      this.joints = new Map(
        moving.map((joint) => [
          joint.name,
          { joint, frame: (prefix ? `${prefix}/` : '') + scene.bodies[joint.child].link },
        ]),
      );
      moving.forEach((joint) =>
        offer(flag(`Joints/${joint.name}`, true, `The effort of ${joint.name}.`)),
      );
      status('URDF', 'ok', 'URDF parsed OK');
      this.draw();
    } catch (problem) {
      status('URDF', 'error', asCallError(problem).message);
    }
  }

  private draw(): void {
    this.pool.begin();
    const names = this.last ? list<string>(this.last, 'name') : [];
    const efforts = numbers(this.last?.effort);
    if (names.length && !efforts.length)
      this.site.status('Efforts', 'warn', 'The joint states hold no efforts');
    else if (names.length) this.site.status('Efforts', 'ok', `${efforts.length} efforts`);
    names.forEach((name, index) => this.put(name, efforts[index] ?? 0));
    this.pool.end();
  }

  private put(name: string, effort: number): void {
    const { props, frames } = this.site;
    const found = this.joints.get(name);
    if (!found || !props.flag('Joints/All Enabled') || props.get(`Joints/${name}`) === false)
      return;
    const at = frames.at(found.frame);
    if (at < 0 || !Number.isFinite(effort)) return;
    const share = Math.min(
      1,
      Math.abs(effort) / (found.joint.effort || Math.max(Math.abs(effort), 1)),
    );
    const size = props.num('Scale') * share;
    if (size < 1e-4) return;
    const pose = matrixOf([...frames.poses.subarray(at, at + 7)] as never).multiply(
      matrixOf(found.joint.pose),
    );
    const axis = new THREE.Vector3(...found.joint.axis)
      .multiplyScalar(effort < 0 ? -1 : 1)
      .normalize();
    const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(1, 0, 0), axis);
    pose
      .multiply(new THREE.Matrix4().makeRotationFromQuaternion(turn))
      .scale(new THREE.Vector3(size, size, size));
    this.pool.put(pose, new THREE.Color(Math.min(1, 2 * share), Math.min(1, 2 - 2 * share), 0));
  }
}
