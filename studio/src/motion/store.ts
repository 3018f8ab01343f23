/** What panel and display share: the robot, where it is and shall be, its scene and its planned path. */
import type { Channel } from '../channel';
import type { Connection } from '../connection';
import type { GraphValue, MotionRobot } from '../generated/messages';
import { list } from '../displays/message_fields';
import { inOneLine } from '../errors';
import { isObject, type Json, type JsonObject } from '../json';
import { pathOf, robotState, type PlannedPath } from './messages';
import { Player } from './player';
import { groupOf, Kinematics, type Positions } from './robot';

export type Change = 'robot' | 'current' | 'query' | 'scene' | 'path' | 'play' | 'look';
export type Query = 'start' | 'goal';

const RETRY_MS = 2000;
const LOOK_MS = 120;
const PLAN_SERVICE = 'plan_kinematic_path';
const MOST_PAIRS = 3;

/** One state that a person asks about. */
export interface QueryState {
  /** Null for the start where the robot is. */
  positions: Positions | null;
  /** Links and objects that collide there. */
  colliding: Set<string>;
  /** Which of them, in words; empty when nothing collides. */
  collisions: string;
  shown: boolean;
}

/** Names as the display's properties have them. */
export interface MotionNames {
  namespace: string;
  description: string;
  scene_topic: string;
  path_topic: string;
}

const NAMES: MotionNames = {
  namespace: '',
  description: 'robot_description',
  scene_topic: 'monitored_planning_scene',
  path_topic: 'display_planned_path',
};

/** The motion planning of one connection. */
export class MotionStore {
  robot: MotionRobot | null = null;
  kinematics: Kinematics | null = null;
  /** Why there is no robot or no scene. */
  problem = '';
  group = '';
  current: Positions = {};
  readonly start: QueryState = {
    positions: null,
    colliding: new Set(),
    collisions: '',
    shown: false,
  };
  readonly goal: QueryState = {
    positions: null,
    colliding: new Set(),
    collisions: '',
    shown: true,
  };
  objects: JsonObject[] = [];
  attached: JsonObject[] = [];
  readonly player = new Player();
  /** The object of the scene that is being moved. */
  chosen = '';
  collisionAware = true;
  approximate = false;
  /** What inverse kinematics said last; empty when it went well. */
  ikProblem = '';
  private names = NAMES;
  private users = 0;
  private channels: Channel[] = [];
  /** Counts readings of the robot: the answer to an older one is late. */
  private reading = 0;
  /** Planning services on the graph now, and those that were since the robot was asked for. */
  private offered: ReadonlySet<string> = new Set();
  private heard = new Set<string>();
  private timer = 0;
  private looking = 0;
  private readonly listeners = new Set<(what: Change) => void>();

  constructor(readonly connection: Connection) {}

  /** Be told of changes. Returns what ends it. */
  watch(listener: (what: Change) => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  tell(what: Change): void {
    for (const listener of this.listeners) listener(what);
  }

  /** Follow the move_group while somebody looks. Returns what ends it. */
  use(): () => void {
    this.users += 1;
    if (this.users === 1) void this.load();
    let over = false;
    return () => {
      if (over) return;
      over = true;
      this.users -= 1;
      if (!this.users) this.stop();
    };
  }

  /** Take other names; the robot is read again. */
  setNames(names: Partial<MotionNames>): void {
    const next = { ...this.names, ...names };
    if (JSON.stringify(next) === JSON.stringify(this.names)) return;
    this.names = next;
    if (this.users) void this.load();
  }

  /** A name of this move_group. */
  name(plain: string): string {
    return plain.startsWith('/') ? plain : (this.robot?.prefix ?? '/') + plain;
  }

  /** Call a service of this move_group. */
  async service(
    name: string,
    kind: string,
    request: JsonObject,
    timeout_s = 10,
  ): Promise<JsonObject> {
    const answer = await this.connection.call('service.call', {
      service: this.name(name),
      type: `moveit_msgs/srv/${kind}`,
      request,
      timeout_s,
    });
    return isObject(answer) ? answer : {};
  }

  /** Plan for another group. */
  setGroup(name: string): void {
    this.group = name;
    this.goal.positions = null;
    this.start.positions = null;
    this.tell('robot');
    this.changedQuery();
  }

  /** Where a state is: what was asked for on top of where the robot is. */
  positions(query: Query): Positions {
    return { ...this.current, ...this[query].positions };
  }

  /** Change a state that is asked about; null for a start where the robot is. */
  setQuery(query: Query, positions: Positions | null): void {
    const own = new Set(this.robot && groupOf(this.robot, this.group)?.variables);
    this[query].positions =
      positions && Object.fromEntries(Object.entries(positions).filter(([name]) => own.has(name)));
    this.ikProblem = '';
    this.changedQuery();
  }

  show(query: Query, on: boolean): void {
    this[query].shown = on;
    this.tell('look');
    this.lookSoon();
  }

  /** Take a path to be shown. */
  setPath(path: PlannedPath | null): void {
    this.player.load(path);
    this.tell('path');
  }

  /** Whether a state is valid, and the pairs that collide there. */
  async validity(
    robot: MotionRobot,
    positions: Positions,
  ): Promise<{ valid: boolean; pairs: [string, string][] }> {
    const answer = await this.service('check_state_validity', 'GetStateValidity', {
      group_name: this.group,
      robot_state: robotState(robot, positions),
    });
    const pairs = list<JsonObject>(answer, 'contacts').map((one): [string, string] => [
      String(one.contact_body_1),
      String(one.contact_body_2),
    ]);
    return { valid: answer.valid === true, pairs };
  }

  /** Who is on the graph now: a move_group that was there may have ended. */
  follow(graph: GraphValue): void {
    const names = graph.services.map((each) => each.name);
    this.offered = new Set(names.filter((name) => name.endsWith(`/${PLAN_SERVICE}`)));
    for (const name of this.offered) this.heard.add(name);
    this.leaveEnded();
  }

  /** Read the robot anew when its move_group has ended, be it while the robot was read. */
  private leaveEnded(): void {
    const name = this.name(PLAN_SERVICE);
    if (this.robot && this.users && this.heard.has(name) && !this.offered.has(name))
      void this.load();
  }

  /** Read the robot; tried again while there is none. */
  private async load(): Promise<void> {
    this.stop();
    const reading = ++this.reading;
    this.heard = new Set(this.offered);
    const { namespace, description } = this.names;
    try {
      const value = await this.connection.call('motion.robot', { namespace, description });
      if (this.users && reading === this.reading) this.adopt(value as unknown as MotionRobot);
    } catch (problem) {
      if (reading !== this.reading) return;
      this.robot = null;
      this.lose(problem);
    }
  }

  private again(): void {
    clearTimeout(this.timer);
    if (this.users) this.timer = window.setTimeout(() => void this.load(), RETRY_MS);
  }

  private adopt(robot: MotionRobot): void {
    this.problem = '';
    this.robot = robot;
    this.kinematics = new Kinematics(robot);
    this.current = { ...robot.defaults };
    if (!groupOf(robot, this.group)) this.group = robot.groups[0]?.name ?? '';
    const lost = (problem: unknown): void => this.lose(problem);
    this.channels = [
      this.connection.open(
        'motion.scene',
        { topic: this.name(this.names.scene_topic), service: this.name('get_planning_scene') },
        {
          onData: (value) => this.takeScene(value),
          onFailed: lost,
          onEnded: (problem) => problem && lost(problem),
        },
      ),
      this.connection.open(
        'motion.path',
        { topic: this.name(this.names.path_topic) },
        {
          onData: (value) => {
            if (isObject(value))
              this.setPath(pathOf(list<Json>(value, 'trajectory'), value.trajectory_start));
          },
          onFailed: lost,
          onEnded: (problem) => problem && lost(problem),
        },
      ),
    ];
    this.tell('robot');
    this.leaveEnded();
  }

  private lose(problem: unknown): void {
    this.problem = inOneLine(problem);
    this.tell('robot');
    this.again();
  }

  /** Whether the problem is only that nobody plans yet: a launch starts move_group late. */
  get isWaiting(): boolean {
    return this.robot === null && this.problem.startsWith('no move_group is running');
  }

  private takeScene(value: Json): void {
    if (!isObject(value)) return;
    const before = JSON.stringify(this.current);
    Object.assign(this.current, value.positions);
    if (Array.isArray(value.objects)) {
      this.objects = list<JsonObject>(value, 'objects');
      this.attached = list<JsonObject>(value, 'attached');
      this.tell('scene');
      this.lookSoon();
    }
    if (JSON.stringify(this.current) === before) return;
    this.tell('current');
    this.lookSoon();
  }

  private changedQuery(): void {
    this.tell('query');
    this.lookSoon();
  }

  /** See what collides, a moment after the last change. */
  private lookSoon(): void {
    clearTimeout(this.looking);
    this.looking = window.setTimeout(() => {
      for (const query of ['start', 'goal'] as const)
        if (this[query].shown && this.robot) void this.look(query, this.robot);
    }, LOOK_MS);
  }

  private async look(query: Query, robot: MotionRobot): Promise<void> {
    const state = this[query];
    const positions = this.positions(query);
    try {
      const { pairs } = await this.validity(robot, positions);
      const more = pairs.length > MOST_PAIRS ? ` and ${pairs.length - MOST_PAIRS} more` : '';
      state.colliding = new Set(pairs.flat());
      state.collisions =
        pairs
          .slice(0, MOST_PAIRS)
          .map(([one, other]) => `${one} collides with ${other}`)
          .join(', ') + more;
    } catch (problem) {
      state.colliding = new Set();
      state.collisions = `nobody says what collides: ${inOneLine(problem)}`;
    }
    this.tell('look');
  }

  private stop(): void {
    clearTimeout(this.timer);
    this.channels.forEach((channel) => channel.close());
    this.channels = [];
  }
}

const stores = new WeakMap<Connection, MotionStore>();

/** The one of a connection. */
export function motionStore(connection: Connection): MotionStore {
  let found = stores.get(connection);
  if (!found) {
    found = new MotionStore(connection);
    stores.set(connection, found);
  }
  return found;
}
