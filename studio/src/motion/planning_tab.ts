/** The tab Planning: group, start and goal, the buttons, and what planning is given. */
import type { Connection } from '../connection';
import { inOneLine } from '../errors';
import type { GraphStore } from '../graph_store';
import { isObject, numberOf, textOf, type JsonObject } from '../json';
import { button, checkbox, fillSelect, h, select } from '../widgets/dom';
import { PathBar } from './path_bar';
import { Planning, plannersOf, type PlanOptions, type Report } from './planning';
import type { MotionRobot } from '../generated/messages';
import { groupOf, randomPositions, type Positions } from './robot';
import type { MotionStore, Query } from './store';

const CURRENT = '<current>',
  RANDOM = '<random>',
  VALID = '<random valid>',
  SAME_START = '<same as start>',
  SAME_GOAL = '<same as goal>',
  PREVIOUS = '<previous>',
  OTHER = '';
const MOST_TRIES = 100;
const DEFAULTS: PlanOptions = {
  pipeline: '',
  planner: '',
  time_s: 5,
  attempts: 10,
  velocity: 0.1,
  acceleration: 0.1,
  cartesian: false,
};

/** What the tab tells its panel. */
export interface PlanningHost {
  connection: Connection;
  graph: GraphStore;
  touched(): void;
  report(report: Report): void;
}

/** RViz's tabs Context and Planning. */
export class PlanningTab {
  readonly element = h('div', { class: 'scroll motion-page' });
  readonly planning: Planning;
  private readonly options: PlanOptions = { ...DEFAULTS };
  private readonly group: HTMLSelectElement;
  private readonly states: Record<Query, HTMLSelectElement>;
  private readonly planner: HTMLSelectElement;
  private readonly commands: Record<
    'plan' | 'execute' | 'both' | 'stop' | 'clear',
    HTMLButtonElement
  >;
  private readonly path: PathBar;
  private readonly shown: Record<Query, HTMLLabelElement>;
  /** Where the last plan began. */
  private previous: Positions | null = null;
  private readonly fields = h('div', { class: 'form-grid motion-form' });
  private scaled = false;
  private plannersFor = '';

  constructor(
    private readonly store: MotionStore,
    private readonly host: PlanningHost,
  ) {
    this.planning = new Planning(store, host.graph, this.options, (report) => {
      this.refreshCommands();
      host.report(report);
    });
    this.group = select('Planning group', [], '', (name) => {
      this.planning.drop();
      store.setGroup(name);
      host.touched();
    });
    this.states = {
      start: select('Start state', [], CURRENT, (name) => void this.choose('start', name)),
      goal: select('Goal state', [], CURRENT, (name) => void this.choose('goal', name)),
    };
    const shown = (query: Query): HTMLLabelElement =>
      checkbox(
        'shown',
        store[query].shown,
        (on) => store.show(query, on),
        `Show the ${query} as a ghost`,
      );
    this.shown = { start: shown('start'), goal: shown('goal') };
    this.planner = select('Planner', [['', '<default>']], '', (value) => this.choosePlanner(value));
    this.commands = {
      plan: button('Plan', () => this.run(false), {
        class: 'primary',
        title: 'Plan a path from start to goal',
      }),
      execute: button('Execute', () => void this.planning.execute(), {
        title: 'Execute the planned path',
      }),
      both: button('Plan & Execute', () => this.run(true), {
        title: 'Plan from where the robot is, and execute at once',
      }),
      stop: button('Stop', () => this.planning.stop(), { icon: 'stop', title: 'Stop the robot' }),
      clear: button('Clear', () => this.planning.clear(), {
        icon: 'clear',
        title: 'Forget the planned path',
      }),
    };
    this.path = new PathBar(store);
    this.element.append(
      h(
        'div',
        { class: 'motion-commands', role: 'group', 'aria-label': 'Commands' },
        ...Object.values(this.commands),
      ),
      this.path.element,
      this.fields,
    );
    this.fill();
    this.refresh();
  }

  /** Take what a layout kept. */
  open(params: JsonObject): void {
    const { options } = this;
    const kept = isObject(params.options) ? params.options : {};
    for (const name of ['time_s', 'attempts', 'velocity', 'acceleration'] as const)
      options[name] = numberOf(kept, name, options[name]);
    options.pipeline = textOf(kept, 'pipeline');
    options.planner = textOf(kept, 'planner');
    options.cartesian = kept.cartesian === true;
    this.scaled ||= 'velocity' in kept;
    if (textOf(params, 'group')) this.store.group = textOf(params, 'group');
    this.fill();
  }

  state(): JsonObject {
    return { options: { ...this.options }, group: this.store.group };
  }

  /** The robot or the group is another one. */
  refresh(): void {
    const { robot, group } = this.store;
    fillSelect(this.group, robot?.groups.map((each) => each.name) ?? [], group);
    if (robot && !this.scaled) {
      this.scaled = true;
      this.options.velocity = robot.velocity_scaling;
      this.options.acceleration = robot.acceleration_scaling;
      this.fill();
    }
    this.fillStates();
    this.refreshCommands();
    if (robot && this.plannersFor !== `${robot.node} ${group}`) {
      this.plannersFor = `${robot.node} ${group}`;
      void this.fillPlanners();
    }
  }

  /** The animation moved on. */
  refreshPath(): void {
    this.path.refresh();
    this.refreshCommands();
  }

  /** A state was changed, shown or hidden by other means. */
  refreshQuery(): void {
    for (const query of ['start', 'goal'] as const) {
      (this.shown[query].querySelector('input') as HTMLInputElement).checked =
        this.store[query].shown;
      const chosen = this.states[query];
      const named = this.robotStates()[chosen.value];
      if (
        named &&
        Object.entries(named).every(
          ([name, value]) => Math.abs(this.store.positions(query)[name] - value) < 1e-6,
        )
      )
        continue;
      chosen.value = this.store[query].positions === null ? CURRENT : OTHER;
    }
  }

  private run(execute: boolean): void {
    this.previous = execute ? { ...this.store.current } : this.store.positions('start');
    void this.planning.run(execute);
  }

  private refreshCommands(): void {
    const { plan, execute, both, stop, clear } = this.commands;
    const busy = Boolean(this.planning.busy);
    plan.disabled = both.disabled = busy || !this.store.robot;
    execute.disabled = busy || !this.planning.plan || !this.store.robot;
    stop.disabled = !this.store.robot;
    clear.disabled = busy || !this.store.player.path;
  }

  private robotStates(): Record<string, Positions> {
    const { robot, group } = this.store;
    return (robot && groupOf(robot, group)?.states) ?? {};
  }

  private fillStates(): void {
    const named = Object.keys(this.robotStates());
    const common = [CURRENT, VALID, RANDOM];
    for (const [query, same] of [
      ['start', SAME_GOAL],
      ['goal', SAME_START],
    ] as const) {
      const options = [
        [OTHER, '(as shown)'] as const,
        ...[...common, same, PREVIOUS, ...named].map((name) => [name, name] as const),
      ];
      fillSelect(this.states[query], options, this.states[query].value || CURRENT);
    }
    this.refreshQuery();
  }

  private async choose(query: Query, name: string): Promise<void> {
    const { store } = this;
    const other: Query = query === 'goal' ? 'start' : 'goal';
    if (name === OTHER || !store.robot) return;
    if (name === CURRENT) store.setQuery(query, query === 'start' ? null : { ...store.current });
    else if (name === RANDOM) store.setQuery(query, randomPositions(store.robot, store.group));
    else if (name === VALID) await this.randomValid(query, store.robot);
    else if (name === SAME_START || name === SAME_GOAL)
      store.setQuery(query, store.positions(other));
    else if (name === PREVIOUS) store.setQuery(query, this.previous);
    else store.setQuery(query, { ...store.positions(query), ...this.robotStates()[name] });
    if (name in this.robotStates()) this.states[query].value = name;
  }

  /** Until one collides with nothing. */
  private async randomValid(query: Query, robot: MotionRobot): Promise<void> {
    const { store } = this;
    try {
      for (let tries = 0; tries < MOST_TRIES; tries++) {
        const drawn = randomPositions(robot, store.group);
        if (!(await store.validity(robot, { ...store.current, ...drawn })).valid) continue;
        store.setQuery(query, drawn);
        return;
      }
      this.host.report({
        level: 'error',
        text: `None of ${MOST_TRIES} random states is free of collisions.`,
      });
    } catch (problem) {
      this.host.report({ level: 'error', text: inOneLine(problem) });
    }
  }

  private async fillPlanners(): Promise<void> {
    try {
      const rows = await plannersOf(this.store);
      const named = rows.map(
        ({ pipeline, planner }) => [`${pipeline}/${planner}`, `${planner} (${pipeline})`] as const,
      );
      fillSelect(this.planner, [['', '<default>'], ...named], '');
      this.planner.value = this.options.planner
        ? `${this.options.pipeline}/${this.options.planner}`
        : '';
    } catch (problem) {
      this.host.report({ level: 'error', text: inOneLine(problem) });
    }
  }

  private choosePlanner(value: string): void {
    const cut = value.indexOf('/');
    this.options.pipeline = cut < 0 ? '' : value.slice(0, cut);
    this.options.planner = value.slice(cut + 1);
    this.host.touched();
  }

  private fill(): void {
    const { store, options, host } = this;
    const row = (name: string, ...controls: HTMLElement[]): HTMLElement[] => [
      h('span', { class: 'dim' }, name),
      h('span', { class: 'motion-row' }, ...controls),
    ];
    this.fields.replaceChildren(
      ...row('Planning group', this.group),
      ...row('Start state', this.states.start, this.shown.start),
      ...row('Goal state', this.states.goal, this.shown.goal),
      ...row('Planner', this.planner),
      ...row('Planning time (s)', this.number('Planning time (s)', 'time_s', 0.01, 3600)),
      ...row('Planning attempts', this.number('Planning attempts', 'attempts', 1, 1000)),
      ...row('Velocity scaling', this.number('Velocity scaling', 'velocity', 0.01, 1)),
      ...row('Acceleration scaling', this.number('Acceleration scaling', 'acceleration', 0.01, 1)),
      h('span'),
      h(
        'span',
        { class: 'motion-checks' },
        checkbox(
          'Use Cartesian Path',
          options.cartesian,
          (on) => {
            options.cartesian = on;
            host.touched();
          },
          'The tip goes straight',
        ),
        checkbox(
          'Collision-aware IK',
          store.collisionAware,
          (on) => {
            store.collisionAware = on;
          },
          'Solutions that collide do not count',
        ),
        checkbox(
          'Approx IK Solutions',
          store.approximate,
          (on) => {
            store.approximate = on;
          },
          'Come as near as possible where no solution is',
        ),
      ),
    );
  }

  private number(
    label: string,
    name: 'time_s' | 'attempts' | 'velocity' | 'acceleration',
    min: number,
    max: number,
  ): HTMLInputElement {
    const step = name === 'attempts' ? 1 : 'any';
    const input = h('input', {
      type: 'number',
      class: 'small',
      'aria-label': label,
      min,
      max,
      step,
      on: {
        change: () => {
          const value = Number(input.value);
          this.options[name] = Math.min(
            max,
            Math.max(min, Number.isFinite(value) && value ? value : DEFAULTS[name]),
          );
          input.value = String(this.options[name]);
          this.host.touched();
        },
      },
    });
    input.value = String(this.options[name]);
    return input;
  }
}
