/** Where a view looks before anybody has chosen: at the robots, which fill the picture. */
import * as THREE from 'three';
import type { Display } from '../displays/display';
import { DISPLAY_ROWS } from '../generated/displays';
import type { PageScene } from '../generated/messages';
import type { Assembly } from '../model/assembly';
import type { ViewState } from './cameras';
import { frameBox, freeYaw, subjectsOf } from './framing';
import type { View } from './view';

/** Robots are still spawned, and meshes still come, for a while after the first picture. */
const SETTLED_MS = 3000;
const LOOKS = 4;

/** Moves the camera at first; ends when a person, a file or a layout has moved it. */
export class FirstLook {
  private ended = false;
  private placed: ViewState | null = null;
  private aim: (() => THREE.Box3) | null = null;
  private walls: THREE.Object3D[] = [];
  private looksAtRobots = false;
  private readonly unwatch: () => void;
  private timer = 0;

  constructor(
    private readonly view: View,
    private readonly assembly: Assembly,
  ) {
    this.unwatch = assembly.onLoaded(() => this.look());
  }

  /** Nothing is moved any more. */
  end(): void {
    this.ended = true;
    clearTimeout(this.timer);
    this.unwatch();
  }

  /** Look as a world's file says; answers whether that was done. */
  take(state: Partial<ViewState>): boolean {
    if (this.isOver()) return false;
    this.view.rig.set(state);
    this.end();
    return true;
  }

  /** Look at a box, whoever has looked elsewhere before. */
  at(aim: () => THREE.Box3): void {
    this.placed = this.view.rig.state;
    this.start(aim);
  }

  /** Look at the robots of a world. */
  atWorld(scene: PageScene): void {
    if (this.isOver()) return;
    const { models, areRobots } = subjectsOf(scene.models, scene.joints);
    // What came before the robot was spawned is not what one wants to see.
    if (models.length === 0 || (this.looksAtRobots && this.aim)) return;
    this.looksAtRobots = areRobots;
    const names = models.map((model) => model.name);
    const nodesOf = (name: string) => this.assembly.nodes(name);
    const fixed = scene.models.filter((model) => model.static).map((model) => model.name);
    this.walls = fixed.flatMap(nodesOf).map((node) => node.root);
    this.start(() => this.assembly.worldBox(names.flatMap(nodesOf)));
  }

  /** Look at the robots that displays show, as soon as their links have places. */
  atRobots(displays: readonly Display[]): void {
    if (this.isOver() || this.aim) return;
    const robots = displays.filter((each) => each.enabled && isPlaced(each));
    if (robots.length === 0) return;
    this.start(() => {
      const box = new THREE.Box3();
      for (const each of robots) {
        each.root.updateWorldMatrix(true, true);
        box.union(new THREE.Box3().setFromObject(each.root));
      }
      return box;
    });
  }

  private start(aim: () => THREE.Box3): void {
    this.aim = aim;
    this.look();
    clearTimeout(this.timer);
    let left = LOOKS;
    const again = (): void => {
      this.look();
      left -= 1;
      if (left > 0 && !this.isOver()) this.timer = window.setTimeout(again, SETTLED_MS / LOOKS);
    };
    this.timer = window.setTimeout(again, SETTLED_MS / LOOKS);
  }

  private look(): void {
    if (this.isOver() || !this.aim) return;
    const { rig } = this.view;
    const box = this.aim();
    const fov = rig.perspective.fov;
    const plain = frameBox(box, rig.state, fov, rig.aspect);
    if (!plain) return;
    const middle = new THREE.Vector3(...plain.focal);
    const eye = { ...rig.state, distance: plain.distance };
    const yaw = freeYaw(middle, eye, this.view.camera, this.walls);
    const framed = frameBox(box, { ...rig.state, yaw }, fov, rig.aspect) ?? plain;
    if (this.placed && !isOther(this.placed, { ...rig.state, ...framed, yaw })) return;
    rig.set({ ...framed, yaw });
    this.placed = rig.state;
  }

  /** Whether somebody else has moved the camera. */
  private isOver(): boolean {
    const { rig } = this.view;
    const moved = this.placed ? rig.state !== this.placed : rig.touched;
    if (moved && !this.ended) this.end();
    return this.ended;
  }
}

/** Whether a display shows a robot where it is. Without any tf one stands in its root link's frame, which is as good. */
function isPlaced(robot: Display): boolean {
  const { name } = robot.kind;
  if (name === DISPLAY_ROWS.MotionPlanning.name)
    return robot.status.get('Move Group')?.level === 'ok';
  if (name !== DISPLAY_ROWS.RobotModel.name || robot.status.get('URDF')?.level !== 'ok')
    return false;
  const hasTf = robot.stage.frames.infos.length > 0;
  return robot.status.get('Transform')?.level === 'ok' || (!hasTf && robot.stage.frames.settled);
}

/** A robot that settles on its wheels needs no new look. */
function isOther(old: ViewState, next: ViewState): boolean {
  const away = new THREE.Vector3(...old.focal).distanceTo(new THREE.Vector3(...next.focal));
  return (
    away > 0.05 * old.distance ||
    Math.abs(next.distance - old.distance) > 0.08 * old.distance ||
    Math.abs(next.yaw - old.yaw) > 1e-3
  );
}
