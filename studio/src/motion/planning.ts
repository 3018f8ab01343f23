/** What the buttons do: plan, execute, both, stop. */
import { list } from '../displays/message_fields';
import { CallError, inOneLine } from '../errors';
import type { GraphStore } from '../graph_store';
import { isObject, numberOf, type Json, type JsonObject } from '../json';
import { jointGoal, outcomeOf, pathOf, poseMessage, robotState, type Outcome } from './messages';
import type { GoalState, MotionRobot } from '../generated/messages';
import { groupOf, tipOf } from './robot';
import type { MotionStore } from './store';

/** What a person sets before planning. */
export interface PlanOptions {
  pipeline: string;
  planner: string;
  time_s: number;
  attempts: number;
  velocity: number;
  acceleration: number;
  cartesian: boolean;
}

/** What the result line says. */
export interface Report {
  level: 'busy' | 'ok' | 'warn' | 'error';
  text: string;
}

const OVER = /succeeded|aborted|rejected|cancel(l)?ed|preempted|recalled|lost/i;
const STRAIGHT_STEP_M = 0.01;
const SLACK_S = 5;

/** Speaks with move_group's actions. */
export class Planning {
  /** The plan that Execute executes, once; null before, after a failure and for another group. */
  plan: Json = null;
  busy = '';
  /** Counts what was begun and stopped: an answer to something older comes too late. */
  private turn = 0;
  private cancel: (() => void) | null = null;

  constructor(
    private readonly store: MotionStore,
    private readonly graph: GraphStore,
    private readonly options: PlanOptions,
    private readonly report: (report: Report) => void,
  ) {}

  /** Plan, and execute what was planned if wanted. */
  async run(execute: boolean): Promise<void> {
    const { robot } = this.store;
    if (!robot || this.busy) return;
    if (this.options.cartesian) return this.straight(robot, execute);
    this.plan = null;
    const goal = {
      request: this.request(robot, execute),
      planning_options: {
        plan_only: !execute,
        planning_scene_diff: { is_diff: true, robot_state: { is_diff: true } },
      },
    };
    this.begin(execute ? 'Planning and executing …' : 'Planning …');
    const began = performance.now();
    await this.act('MoveGroup', ['move_action', 'move_group'], goal, (result, outcome) => {
      const path = pathOf([result.planned_trajectory ?? null], result.trajectory_start);
      if (outcome.ok && path.points.length && !execute)
        this.plan = result.planned_trajectory ?? null;
      if (path.points.length) this.store.setPath(path);
      const took = numberOf(result, 'planning_time') || (performance.now() - began) / 1000;
      if (!outcome.ok) this.fail(outcome.text);
      else if (!path.points.length) this.end('ok', 'The robot is where it shall go.');
      else
        this.end(
          'ok',
          `${execute ? 'Executed' : 'Planned'}: ${outcome.text}, planned in ${took.toFixed(3)} s, ${path.points.length} points, ${lastOf(path.times_s).toFixed(2)} s of motion`,
        );
    });
  }

  /** Execute the last plan. As in RViz that can be done once: the robot is elsewhere then. */
  async execute(): Promise<void> {
    const trajectory = this.plan;
    if (this.busy || !trajectory) return;
    this.plan = null;
    this.begin('Executing …');
    await this.act(
      'ExecuteTrajectory',
      ['execute_trajectory'],
      { trajectory },
      (_result, outcome) => {
        if (outcome.ok) this.end('ok', `Executed: ${outcome.text}`);
        else this.fail(outcome.text);
      },
    );
  }

  /** Cancel what goes on; the robot stops. */
  stop(): void {
    const { store } = this;
    this.turn += 1;
    this.cancel?.();
    store.connection
      .call('topic.publish', {
        topic: store.name('trajectory_execution_event'),
        type: 'std_msgs/msg/String',
        message: { data: 'stop' },
      })
      .catch((problem: unknown) => this.fail(inOneLine(problem)));
    this.end('warn', 'Stopped.');
  }

  /** The plan was for another group. */
  drop(): void {
    this.plan = null;
    this.store.setPath(null);
  }

  /** Forget the plan. */
  clear(): void {
    this.drop();
    this.end('ok', '');
  }

  /** The tip goes straight to where it shall be. */
  private async straight(robot: MotionRobot, execute: boolean): Promise<void> {
    const { store, options } = this;
    const tip = tipOf(groupOf(robot, store.group));
    const pose = store.kinematics?.pose(tip, store.positions('goal'));
    if (!pose) return this.fail(`The group ${store.group} has no tip that could go straight.`);
    this.plan = null;
    this.begin('Planning a straight path …');
    const { turn } = this;
    try {
      const answer = await store.service(
        'compute_cartesian_path',
        'GetCartesianPath',
        {
          header: { frame_id: store.kinematics?.isMobile ? robot.frame : robot.root },
          start_state: this.startState(robot, execute),
          group_name: store.group,
          link_name: tip,
          waypoints: [poseMessage(pose)],
          max_step: STRAIGHT_STEP_M,
          avoid_collisions: true,
          max_velocity_scaling_factor: options.velocity,
          max_acceleration_scaling_factor: options.acceleration,
        },
        options.time_s + SLACK_S,
      );
      if (turn !== this.turn) return;
      this.takeStraight(answer);
    } catch (problem) {
      if (turn === this.turn) this.fail(inOneLine(problem));
      return;
    }
    if (execute && this.plan) await this.execute();
  }

  private takeStraight(answer: JsonObject): void {
    const outcome = outcomeOf(answer);
    const percent = `${(100 * numberOf(answer, 'fraction')).toFixed(1)} % of the Cartesian path`;
    const path = pathOf([answer.solution ?? null], answer.start_state);
    if (path.points.length > 1) this.store.setPath(path);
    if (outcome.ok && numberOf(answer, 'fraction') >= 1) {
      this.plan = answer.solution ?? null;
      this.end('ok', `Planned ${percent}: ${outcome.text}`);
    } else
      this.fail(
        `Achieved ${percent}: ${outcome.ok ? outcome.why || 'nobody says why not all of it' : outcome.text}`,
      );
  }

  private request(robot: MotionRobot, execute: boolean): JsonObject {
    const { store, options } = this;
    return {
      group_name: store.group,
      pipeline_id: options.pipeline,
      planner_id: options.planner,
      num_planning_attempts: options.attempts,
      allowed_planning_time: options.time_s,
      max_velocity_scaling_factor: options.velocity,
      max_acceleration_scaling_factor: options.acceleration,
      start_state: this.startState(robot, execute),
      goal_constraints: [
        jointGoal(store.positions('goal'), groupOf(robot, store.group)?.variables ?? []),
      ],
    };
  }

  /** What is executed at once begins where the robot is, as in RViz. */
  private startState(robot: MotionRobot, execute: boolean): JsonObject {
    const { positions } = this.store.start;
    return positions && !execute
      ? robotState(robot, this.store.positions('start'))
      : { is_diff: true };
  }

  /** Send a goal and wait for its result. */
  private act(
    kind: string,
    names: string[],
    goal: JsonObject,
    done: (result: JsonObject, outcome: Outcome) => void,
  ): Promise<void> {
    const { store, graph } = this;
    const known = new Set(graph.value.actions.map((each) => each.name));
    const action =
      names.map((name) => store.name(name)).find((name) => known.has(name)) ?? store.name(names[0]);
    return new Promise((resolve) => {
      let over = false;
      const finish = (tell: () => void): void => {
        if (over) return;
        over = true;
        this.cancel = null;
        tell();
        resolve();
      };
      const lost = (problem: CallError | null): void =>
        finish(() => this.fail(inOneLine(problem ?? new CallError(`${action} gave no result.`))));
      const channel = store.connection.open(
        'action',
        { action, type: `moveit_msgs/action/${kind}`, goal },
        {
          onData: (value) => {
            const { state, text, result } = value as unknown as GoalState;
            if (!OVER.test(state)) return;
            if (isObject(result)) finish(() => done(result, outcomeOf(result)));
            else finish(() => this.fail(text || state));
            channel.close();
          },
          onFailed: lost,
          onEnded: lost,
        },
      );
      this.cancel = () => {
        channel.close();
        finish(() => undefined);
      };
    });
  }

  private begin(text: string): void {
    this.busy = text;
    this.report({ level: 'busy', text });
  }

  private end(level: 'ok' | 'warn' | 'error', text: string): void {
    this.busy = '';
    this.report({ level, text });
  }

  private fail(text: string): void {
    this.end('error', text);
  }
}

/** Planners by pipeline, as `query_planner_interface` tells: rows of pipeline, planner and text. */
export async function plannersOf(
  store: MotionStore,
): Promise<{ pipeline: string; planner: string }[]> {
  const answer = await store.service('query_planner_interface', 'QueryPlannerInterfaces', {});
  const found: { pipeline: string; planner: string }[] = [];
  for (const item of list<JsonObject>(answer, 'planner_interfaces')) {
    const pipeline = String(item.pipeline_id ?? '');
    const own = new RegExp(`^${store.group}\\[(.*)\\]$`);
    const ids = list<string>(item, 'planner_ids');
    const ofGroup = ids.map((id) => own.exec(id)?.[1]).filter((id): id is string => Boolean(id));
    for (const planner of ofGroup.length ? ofGroup : ids.filter((id) => !id.includes('[')))
      found.push({ pipeline, planner });
  }
  return found;
}

function lastOf(values: readonly number[]): number {
  return values[values.length - 1] ?? 0;
}
