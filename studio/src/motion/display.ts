/** MotionPlanning: the robot, ghosts of start and goal, the planned path and the planning scene. */
import * as THREE from 'three';
import type { Drawing, Drawer, Site } from '../displays/display';
import { choice, colour, flag, num, text } from '../displays/properties';
import { Ghost, paint } from './ghost';
import { Inverse } from './inverse_kinematics';
import { SceneObjects } from './object_drawing';
import { DISPLAY_TIMES } from './player';
import { groupOf, tipOf, type Positions } from './robot';
import { SixDof } from './six_dof';
import { standing } from './robot_pose';
import { motionStore, type Change, type MotionStore, type Query } from './store';

const RED: [number, number, number] = [1, 0.1, 0.1];
const MOST_TRAIL = 60;
const GHOST_ALPHA = 0.55;

/** RViz's MotionPlanning of moveit_rviz_plugin. */
export const MOTION_PLANNING: Drawing = {
  properties: [
    text('Move Group Namespace', '', 'Of the move_group that is spoken with.'),
    text(
      'Robot Description',
      'robot_description',
      'The parameter with the URDF; the SRDF is beside it.',
    ),
    text('Planning Scene Topic', 'monitored_planning_scene', 'Where move_group tells its scene.'),
    flag('Scene Geometry/Show Scene Geometry', true, 'Whether objects are drawn.'),
    num('Scene Geometry/Scene Alpha', 0.9, 'How opaque objects are, 0 to 1.', { min: 0, max: 1 }),
    colour(
      'Scene Geometry/Scene Color',
      '50; 230; 50',
      'Of objects without a colour of their own.',
    ),
    flag('Scene Robot/Show Robot Visual', true, 'Whether the robot is drawn where it is.'),
    num('Scene Robot/Robot Alpha', 1, 'How opaque it is, 0 to 1.', { min: 0, max: 1 }),
    colour('Scene Robot/Attached Body Color', '150; 50; 150', 'Of what the robot holds.'),
    text(
      'Planning Request/Planning Group',
      '',
      'The group that is planned for; the first one if empty.',
    ),
    flag('Planning Request/Query Start State', false, 'Whether the start is shown.'),
    flag('Planning Request/Query Goal State', true, 'Whether the goal is shown.'),
    num(
      'Planning Request/Interactive Marker Size',
      0,
      "Of the goal's handles, m; 0 for one that fits the robot.",
      { min: 0 },
    ),
    colour('Planning Request/Start State Color', '0; 255; 0', 'Of the start.'),
    colour('Planning Request/Goal State Color', '250; 128; 0', 'Of the goal.'),
    colour('Planning Request/Colliding Link Color', '255; 0; 0', 'Of links that collide.'),
    text('Planned Path/Trajectory Topic', 'display_planned_path', 'Where planned paths come from.'),
    flag('Planned Path/Show Robot Visual', true, 'Whether the robot of the path is drawn.'),
    num('Planned Path/Robot Alpha', 0.5, 'How opaque it is, 0 to 1.', { min: 0, max: 1 }),
    choice(
      'Planned Path/State Display Time',
      '3x',
      DISPLAY_TIMES,
      'Speed, REALTIME, or seconds for each state.',
    ),
    flag('Planned Path/Loop Animation', false, 'Whether it begins again at its end.'),
    flag('Planned Path/Show Trail', false, 'Whether all of its states are drawn.'),
  ],
  make: (site) => new MotionDrawer(site),
};

class MotionDrawer implements Drawer {
  private readonly store: MotionStore;
  private readonly stops: (() => void)[];
  private readonly inverse: Inverse;
  private readonly objects: SceneObjects;
  private readonly base = new THREE.Group();
  private leave: (() => void) | null = null;
  private ghosts: Record<'robot' | 'start' | 'goal' | 'path', Ghost> | null = null;
  private trail: Ghost[] = [];
  private marker: SixDof | null = null;
  private markerLink = '';
  private lastPose = new THREE.Matrix4();

  constructor(private readonly site: Site) {
    this.store = motionStore(site.connection);
    this.inverse = new Inverse(this.store, () => this.tellInverse());
    this.objects = new SceneObjects(site, this.store);
    site.root.add(this.base, this.objects.root);
    this.stops = [
      this.store.watch((what) => this.heard(what)),
      site.frames.onMoved(() => this.follow()),
      site.view.beforeDraw((now) => this.animate(now)),
    ];
    this.leave = this.store.use();
    if (this.store.robot) this.build();
  }

  changed(path: string): void {
    const { props } = this.site;
    this.store.setNames({
      namespace: props.text('Move Group Namespace'),
      description: props.text('Robot Description'),
      scene_topic: props.text('Planning Scene Topic'),
      path_topic: props.text('Planned Path/Trajectory Topic'),
    });
    const { player, start, goal } = this.store;
    const is = (name: string): boolean => path === '' || path === name;
    if (is('Planning Request/Query Start State'))
      start.shown = props.flag('Planning Request/Query Start State');
    if (is('Planning Request/Query Goal State'))
      goal.shown = props.flag('Planning Request/Query Goal State');
    if (is('Planned Path/Loop Animation')) player.loop = props.flag('Planned Path/Loop Animation');
    if (is('Planned Path/Show Trail')) player.trail = props.flag('Planned Path/Show Trail');
    if (
      is('Planned Path/State Display Time') &&
      !player.setDisplayTime(props.text('Planned Path/State Display Time'))
    ) {
      this.site.status(
        'State Display Time',
        'error',
        `'${props.text('Planned Path/State Display Time')}' is neither a speed (3x), REALTIME nor a time (0.05 s)`,
      );
    }
    const group = props.text('Planning Request/Planning Group');
    if (is('Planning Request/Planning Group') && group && group !== this.store.group)
      this.store.setGroup(group);
    if (is('Planning Request/Interactive Marker Size')) this.dropMarker();
    this.store.tell('play');
    this.store.tell('look');
    this.objects.draw();
  }

  clear(): void {
    this.follow();
  }

  shown(visible: boolean): void {
    this.leave?.();
    this.leave = visible ? this.store.use() : null;
  }

  dispose(): void {
    this.stops.forEach((stop) => stop());
    this.leave?.();
    this.objects.dispose();
  }

  counts(): Record<string, number> {
    const { ghosts, store } = this;
    const links = (ghost?: Ghost): number =>
      ghost?.root.visible ? ghost.bodies.filter((body) => body.root.visible).length : 0;
    const red = ghosts
      ? ghosts.goal.bodies.filter((body) => store.goal.colliding.has(body.entity.link)).length
      : 0;
    return {
      links: links(ghosts?.robot),
      start: links(ghosts?.start),
      goal: links(ghosts?.goal),
      path: links(ghosts?.path),
      trail: this.trail.length,
      red,
      marker: this.marker?.root.visible ? 1 : 0,
      objects: this.objects.count,
      attached: this.objects.attachedCount,
    };
  }

  private heard(what: Change): void {
    if (what === 'robot') this.build();
    if (what === 'scene') this.objects.draw();
    if (what === 'path') this.drawTrail();
    if (this.ghosts) this.draw(what);
    this.site.view.moved();
  }

  private build(): void {
    const { robot, problem } = this.store;
    if (problem) this.site.status('Move Group', this.store.isWaiting ? 'warn' : 'error', problem);
    this.base.clear();
    this.dropMarker();
    this.trail = [];
    this.ghosts = null;
    if (!robot) return this.objects.dispose();
    if (!problem)
      this.site.status(
        'Move Group',
        'ok',
        `${robot.node} plans for ${robot.groups.map((group) => group.name).join(', ')}`,
      );
    const make = (name: string): Ghost => {
      const ghost = new Ghost(robot.scene, name, () => this.site.view.moved());
      this.base.add(ghost.root);
      return ghost;
    };
    this.ghosts = {
      robot: make('scene robot'),
      start: make('query start'),
      goal: make('query goal'),
      path: make('planned path'),
    };
    this.site.frames.setRobotRoot(robot.root);
    this.follow();
    this.draw('robot');
    this.objects.draw();
  }

  /** Stand where tf has the robot. */
  private follow(): void {
    const { frames, status } = this.site;
    const { robot } = this.store;
    if (!robot) return;
    const pose = standing(frames, this.store);
    status(
      'Transform',
      pose ? 'ok' : 'error',
      pose ? 'Transform OK' : `No transform from [${robot.root}] to [${frames.fixed}]`,
    );
    this.base.visible = pose !== null;
    if (!pose) return;
    pose.decompose(this.base.position, this.base.quaternion, this.base.scale);
    this.objects.follow();
    if (!pose.equals(this.lastPose)) this.site.view.moved();
    this.lastPose = pose;
  }

  private draw(what: Change): void {
    const { ghosts, store, site } = this;
    if (!ghosts || !store.kinematics || !store.robot) return;
    const { props } = site;
    const all = what === 'robot' || what === 'look' || what === 'query';
    if (all || what === 'current') this.place(ghosts.robot, store.current);
    if (all || what === 'current') this.drawQueries();
    if (all || what === 'scene' || what === 'current') this.objects.follow();
    if (what === 'robot' || what === 'look') {
      const alpha = props.num('Scene Robot/Robot Alpha');
      ghosts.robot.root.visible = props.flag('Scene Robot/Show Robot Visual');
      ghosts.robot.look(null, () => (alpha < 0.99 ? paint([0.7, 0.7, 0.7], alpha) : null));
    }
    this.drawPath();
  }

  private drawQueries(): void {
    const { ghosts, store, site } = this;
    const group = store.robot && groupOf(store.robot, store.group);
    if (!ghosts || !group) return;
    const links = new Set(group.links);
    const red = paint(site.props.colour('Planning Request/Colliding Link Color') ?? RED, 0.8);
    const names: [Query, string][] = [
      ['start', 'Planning Request/Start State Color'],
      ['goal', 'Planning Request/Goal State Color'],
    ];
    for (const [query, property] of names) {
      const ghost = ghosts[query];
      ghost.root.visible = store[query].shown;
      if (!store[query].shown) continue;
      this.place(ghost, store.positions(query));
      const own = paint(site.props.colour(property), GHOST_ALPHA);
      ghost.look(links, (link) => (store[query].colliding.has(link) ? red : own));
    }
    this.drawMarker();
  }

  /** The goal's handles, at the tip. */
  private drawMarker(): void {
    const { store } = this;
    const { robot, kinematics } = store;
    const group = robot ? groupOf(robot, store.group) : undefined;
    // Fingers that move apart have no one pose that inverse kinematics could reach.
    const link = group?.is_chain ? tipOf(group) : '';
    const pose = link ? kinematics?.pose(link, store.positions('goal')) : null;
    if (link !== this.markerLink) this.dropMarker();
    this.markerLink = link;
    if (pose && !this.marker) {
      this.marker = new SixDof('goal', this.markerSize(), {
        moved: (wanted) => this.inverse.ask(this.markerLink, wanted),
        released: () => this.site.view.invalidate(true),
        redraw: () => this.site.view.invalidate(true),
      });
      this.base.add(this.marker.root);
    }
    if (!this.marker || !pose) return;
    this.marker.root.visible = store.goal.shown;
    // Where inverse kinematics failed the handles stay at what was wanted.
    if (!store.ikProblem) this.marker.place(pose);
  }

  private markerSize(): number {
    const given = this.site.props.num('Planning Request/Interactive Marker Size');
    if (given > 0) return given;
    const box = new THREE.Box3();
    for (const pose of this.store.kinematics?.poses(this.store.current) ?? [])
      box.expandByPoint(new THREE.Vector3().setFromMatrixPosition(pose));
    return Math.max(0.12, Math.min(0.6, box.getSize(new THREE.Vector3()).length() * 0.3));
  }

  private dropMarker(): void {
    this.marker?.root.removeFromParent();
    this.marker = null;
  }

  private tellInverse(): void {
    const { ikProblem } = this.store;
    this.site.status(
      'Inverse Kinematics',
      ikProblem ? 'warn' : 'ok',
      ikProblem || 'A solution was found',
    );
    this.store.tell('look');
  }

  private drawPath(): void {
    const { ghosts, store, site } = this;
    if (!ghosts || !store.robot) return;
    const positions = store.player.positions();
    ghosts.path.root.visible =
      positions !== null && site.props.flag('Planned Path/Show Robot Visual');
    if (!positions) return;
    this.place(ghosts.path, positions);
    const own = paint([0.75, 0.78, 0.85], site.props.num('Planned Path/Robot Alpha'));
    ghosts.path.look(new Set(groupOf(store.robot, store.group)?.links), () => own);
    if (store.player.trail !== this.trail.length > 0) this.drawTrail();
  }

  private drawTrail(): void {
    this.trail.forEach((ghost) => ghost.root.removeFromParent());
    this.trail = [];
    const { player, robot, group } = this.store;
    if (!robot || !player.trail || !player.path) return;
    const { points } = player.path;
    const every = Math.ceil(points.length / MOST_TRAIL);
    const links = new Set(groupOf(robot, group)?.links);
    const own = paint([0.75, 0.78, 0.85], 0.25);
    for (let at = 0; at < points.length; at += every) {
      const ghost = new Ghost(robot.scene, 'trail', () => this.site.view.moved());
      ghost.look(links, () => own);
      this.place(ghost, points[at]);
      this.base.add(ghost.root);
      this.trail.push(ghost);
    }
  }

  private place(ghost: Ghost, positions: Positions): void {
    if (this.store.kinematics) ghost.place(this.store.kinematics.poses(positions));
  }

  private animate(now: number): void {
    const { player } = this.store;
    if (!player.playing || !this.ghosts) return;
    player.tick(now);
    this.store.tell('play');
  }
}
