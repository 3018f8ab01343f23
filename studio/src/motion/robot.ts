/** The robot as move_group knows it, and where its links are at positions of its joints. */
import * as THREE from 'three';
import { matrixOf } from '../model/assembly';
import type {
  JointValue,
  MotionGroup,
  MotionJoint,
  MotionRobot,
  MotionVariable,
} from '../generated/messages';

/** Values by variable, rad or m. */
export type Positions = Record<string, number>;

const TURNING = new Set(['revolute', 'continuous']);

/** Forward kinematics of a scene value of kind robot. */
export class Kinematics {
  /** Where joints of several variables put the root: a mobile base. */
  private readonly base: MotionJoint | undefined;
  private readonly above = new Map<number, JointValue>();
  private readonly zero: THREE.Matrix4[];
  private readonly index: Map<string, number>;

  constructor(readonly robot: MotionRobot) {
    const { scene } = robot;
    this.zero = scene.bodies.map((body) => matrixOf(body.pose));
    this.index = new Map(scene.bodies.map((body, at) => [body.link, at]));
    for (const joint of scene.joints) if (joint.parent >= 0) this.above.set(joint.child, joint);
    this.base = robot.joints.find(
      (joint) => joint.child === robot.root && joint.variables.length > 1,
    );
  }

  /** Positions with what followers of joints take. */
  completed(positions: Positions): Positions {
    const all = { ...this.robot.defaults, ...positions };
    for (const mimic of this.robot.mimics)
      all[mimic.variable] = (all[mimic.leader] ?? 0) * mimic.factor + mimic.offset;
    return all;
  }

  /** `T_root_body` of all bodies; of `T_frame_body` of the planning frame where the base moves. */
  poses(positions: Positions): THREE.Matrix4[] {
    const all = this.completed(positions);
    const found: (THREE.Matrix4 | undefined)[] = this.zero.map(() => undefined);
    const place = (at: number): THREE.Matrix4 => {
      const known = found[at];
      if (known) return known;
      const joint = this.above.get(at);
      const made = joint
        ? place(joint.parent)
            .clone()
            .multiply(this.offset(joint))
            .multiply(motion(joint, all[joint.name] ?? 0))
        : this.basePose(all).multiply(this.zero[at]);
      found[at] = made;
      return made;
    };
    return this.zero.map((_, at) => place(at));
  }

  /** Where a link is, like `poses`. */
  pose(link: string, positions: Positions): THREE.Matrix4 | null {
    const at = this.index.get(link);
    return at === undefined ? null : this.poses(positions)[at];
  }

  /** Whether poses are in the planning frame, not in the root link. */
  get isMobile(): boolean {
    return this.base !== undefined;
  }

  private offset(joint: JointValue): THREE.Matrix4 {
    return this.zero[joint.parent].clone().invert().multiply(this.zero[joint.child]);
  }

  private basePose(positions: Positions): THREE.Matrix4 {
    if (!this.base) return new THREE.Matrix4();
    const values = this.base.variables.map((variable) => positions[variable.name] ?? 0);
    if (values.length === 3)
      return new THREE.Matrix4().makeRotationZ(values[2]).setPosition(values[0], values[1], 0);
    const [x, y, z, qx, qy, qz, qw] = values;
    const turn = new THREE.Quaternion(qx, qy, qz, qw);
    if (turn.lengthSq() < 1e-9) turn.identity();
    return new THREE.Matrix4().compose(
      new THREE.Vector3(x, y, z),
      turn.normalize(),
      new THREE.Vector3(1, 1, 1),
    );
  }
}

/** How a joint moves its child, in the child's frame at zero. */
function motion(joint: JointValue, value: number): THREE.Matrix4 {
  const axis = new THREE.Vector3(...joint.axis);
  const moved = new THREE.Matrix4();
  if (TURNING.has(joint.type)) moved.makeRotationAxis(axis.normalize(), value);
  else if (joint.type === 'prismatic')
    moved.makeTranslation(axis.normalize().multiplyScalar(value));
  else return moved;
  const at = matrixOf(joint.pose);
  return at.clone().multiply(moved).multiply(at.invert());
}

/** The group of a name. */
export function groupOf(robot: MotionRobot, name: string): MotionGroup | undefined {
  return robot.groups.find((group) => group.name === name);
}

/** The variables of a group with their limits. */
export function variablesOf(robot: MotionRobot, group: string): MotionVariable[] {
  const names = new Set(groupOf(robot, group)?.variables);
  return robot.joints
    .flatMap((joint) => joint.variables)
    .filter((variable) => names.has(variable.name));
}

/** Positions of a group's variables anywhere within their limits. */
export function randomPositions(robot: MotionRobot, group: string): Positions {
  const found: Positions = {};
  for (const { name, lower, upper } of variablesOf(robot, group)) {
    const low = lower ?? -Math.PI;
    found[name] = low + Math.random() * ((upper ?? Math.PI) - low);
  }
  return found;
}

/** The link whose pose a person drags: that of an end effector, else the last one of the group. */
export function tipOf(group: MotionGroup | undefined): string {
  return group?.effectors[0]?.link ?? group?.tips[0] ?? '';
}
