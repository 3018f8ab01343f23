/** Navigation: goals, waypoints, what the robot says of its way, and Nav2's lifecycle. */
import '../styles/navigation.css';
import type { Channel } from '../channel';
import type { Connection } from '../connection';
import { part, vector } from '../displays/message_fields';
import { isObject, numberOf, textOf, type Json, type JsonObject } from '../json';
import type { PanelHost } from '../panel';
import { BasePanel } from '../panels/base';
import { onGoal } from '../tools/goal_takers';
import { download } from '../widgets/download';
import { button, fillSelect, h, notice, select, setText, toggle, toolbar } from '../widgets/dom';
import { robots, server, type Mode } from './drivers';
import { Lifecycle } from './lifecycle';
import { Marks } from './waypoint_markers';
import { Trip, type Standing } from './goal_sequence';
import { asYaml, waypointOf, WaypointList, type Waypoint } from './waypoints';

const HINT = 'Press Waypoint mode, then set waypoints with 2D Nav Goal in RViz.';
const COUNT = ['State', 'Distance', 'ETA', 'Time taken', 'Recoveries', 'Waypoint'] as const;
type Value = (typeof COUNT)[number];

/** RViz's panel Navigation 2, for move_base too. */
export class NavigationPanel extends BasePanel {
  readonly title = 'Navigation';
  private robot = '';
  private trip: Trip | null = null;
  private goal: Waypoint | null = null;
  private recovery: Channel | null = null;
  private recoveries = 0;
  private began_ms = 0;
  private readonly marks = new Marks();
  private readonly list = new WaypointList(() => this.listChanged());
  private readonly lifecycle: Lifecycle;
  private readonly robotChoice = select('Robot', [], '', (robot) => this.use(robot));
  private readonly modeButton = toggle('Waypoint mode', false, () => this.modeChanged(), {
    title: 'Goals of RViz go into the list of waypoints',
  });
  private readonly values = new Map<Value, HTMLElement>(
    COUNT.map((name) => [name, h('output', { 'aria-label': name }, '–')]),
  );
  private readonly text = h('p', {
    class: 'dim',
    role: 'status',
    'aria-label': 'What the robot says',
  });
  private readonly none = notice('No move_base and no Nav2 runs on this graph.');
  private readonly body = h('div', { class: 'navigation-body' });
  private readonly loops = h('input', {
    type: 'number',
    class: 'small',
    min: 0,
    max: 1000,
    value: 0,
    'aria-label': 'Repetitions',
    title: 'How often the waypoints are driven to again',
  });
  private readonly cancelButton = button('Cancel', () => this.trip?.cancel(), {
    icon: 'stop',
    class: 'danger',
    title: 'Cancel what is driven to',
  });
  private readonly followButton = button('Follow waypoints', () => this.start('follow'), {
    icon: 'play',
    class: 'primary',
    title: 'One after the other, stopping at each',
  });
  private readonly throughButton = button('Navigate through poses', () => this.start('through'), {
    icon: 'send',
    title: 'One way through all of them, without a stop',
  });

  constructor(connection: Connection, host: PanelHost) {
    super(connection, host);
    const told = (text: string): void => host.tell(text);
    this.lifecycle = new Lifecycle(connection, host.graph, {
      visible: () => this.visible,
      fail: (problem) => host.fail(problem),
      told,
    });
    this.build();
    this.list.hint = HINT;
    this.atEnd(host.graph.watch(() => this.look()));
    this.atEnd(onGoal((goal) => this.takeGoal(goal)));
    this.atEnd(() => this.lifecycle.dispose());
    this.atEnd(() => this.marks.dispose());
    // No robot drives on without the button that stops it.
    this.atEnd(() => this.trip?.cancel());
    this.listChanged();
  }

  override open(params: JsonObject): void {
    this.robot = textOf(params, 'robot') || this.robot;
    const kept = Array.isArray(params.waypoints)
      ? (params.waypoints as unknown as Waypoint[])
      : null;
    if (kept) this.list.replace(kept);
    this.loops.value = String(numberOf(params, 'loops', Number(this.loops.value)));
    if (params.mode === true) this.modeButton.setAttribute('aria-pressed', 'true');
    this.look();
  }

  override state(): JsonObject {
    return {
      robot: this.robot,
      waypoints: this.list.items as unknown as Json,
      loops: Number(this.loops.value),
      mode: this.collecting,
    };
  }

  private get collecting(): boolean {
    return this.modeButton.getAttribute('aria-pressed') === 'true';
  }

  private build(): void {
    const file = button('Save', () => download('waypoints.yaml', asYaml(this.list.items)), {
      icon: 'save',
      title: "Save the waypoints as Nav2's file",
    });
    this.element.classList.add('navigation');
    this.body.append(
      this.lifecycle.element,
      h(
        'section',
        { 'aria-label': 'Way' },
        h(
          'dl',
          { class: 'navigation-values' },
          ...COUNT.flatMap((name) => [h('dt', {}, name), h('dd', {}, this.values.get(name))]),
        ),
        this.text,
        h('div', { class: 'button-row' }, this.cancelButton),
      ),
      h(
        'section',
        { 'aria-label': 'Waypoints' },
        h('div', { class: 'button-row' }, this.modeButton, this.followButton, this.throughButton),
        this.list.element,
        h(
          'div',
          { class: 'button-row' },
          h('label', {}, h('span', { class: 'dim' }, 'Repeat '), this.loops),
          file,
          button('Clear', () => this.list.replace([]), {
            icon: 'clear',
            title: 'Delete all waypoints',
          }),
        ),
      ),
    );
    this.loops.addEventListener('change', () => this.host.touched());
    this.element.append(
      toolbar(
        'Navigation',
        h('label', {}, h('span', { class: 'dim' }, 'Robot '), this.robotChoice),
      ),
      this.none,
      this.body,
    );
    this.cancelButton.disabled = true;
  }

  private look(): void {
    const found = robots(this.host.graph);
    const now = found.includes(this.robot) ? this.robot : (found[0] ?? this.robot);
    fillSelect(
      this.robotChoice,
      found.map((name) => [name, name || '/'] as const),
      now,
    );
    this.none.hidden = found.length > 0;
    this.body.hidden = found.length === 0 && this.trip === null;
    this.use(now);
  }

  private use(robot: string): void {
    if (robot !== this.robot) this.host.touched();
    this.robot = robot;
    this.lifecycle.use(robot);
    this.watchRecoveries();
    this.refresh();
  }

  /** move_base tells its recoveries on a topic of its own. */
  private watchRecoveries(): void {
    const topic = `${this.robot}/move_base/recovery_status`;
    if (this.recovery || this.host.graph.typeOf(topic) === undefined) return;
    this.recovery = this.stream(
      'topic.echo',
      { topic, rate_hz: 5 },
      {
        onData: (value) => {
          const number = isObject(value)
            ? numberOf(part(value, 'message'), 'current_recovery_number', 0)
            : 0;
          this.recoveries = number + 1;
          if (this.trip) this.say('Recoveries', String(this.recoveries));
        },
      },
    );
  }

  private takeGoal(pose: JsonObject): string {
    const waypoint = waypointOf(pose);
    if (this.collecting) {
      this.list.add(waypoint);
      return `waypoint ${this.list.items.length}`;
    }
    if (!server(this.host.graph, this.robot, 'goal')) return '';
    this.drive('goal', [waypoint]);
    return 'the panel Navigation';
  }

  private start(mode: Mode): void {
    this.drive(mode, [...this.list.items]);
  }

  private drive(mode: Mode, waypoints: readonly Waypoint[]): void {
    const own = server(this.host.graph, this.robot, mode);
    const found = own ?? server(this.host.graph, this.robot, 'goal');
    if (!found || !waypoints.length) return;
    this.trip?.cancel();
    this.goal = waypoints[waypoints.length - 1];
    this.recoveries = 0;
    this.began_ms = performance.now();
    COUNT.forEach((name) => this.say(name, '–'));
    const atOnce = own !== undefined && mode !== 'goal';
    const loops = mode === 'follow' ? Number(this.loops.value) : 0;
    const inList = mode !== 'goal';
    if (!inList) this.marks.show([...this.list.items, ...waypoints]);
    this.trip = new Trip(this.connection, found, waypoints, { atOnce, loops }, (standing) =>
      this.show(standing, inList),
    );
  }

  private show(standing: Standing, inList: boolean): void {
    const { progress, marks } = standing;
    this.say('State', standing.state.toLowerCase());
    setText(this.text, standing.text);
    const driving = marks.indexOf('driving');
    const target = (inList && driving >= 0 ? this.list.items[driving] : null) ?? this.goal;
    const straight =
      progress.position && target
        ? vector(progress.position as never)
            .setZ(0)
            .distanceTo(vector({ x: target.x, y: target.y, z: 0 }))
        : undefined;
    if (progress.distance_m !== undefined)
      this.say('Distance', `${progress.distance_m.toFixed(2)} m`);
    else if (straight !== undefined) this.say('Distance', `${straight.toFixed(2)} m straight`);
    if (progress.eta_s !== undefined) this.say('ETA', `${progress.eta_s.toFixed(0)} s`);
    this.say(
      'Time taken',
      `${(progress.taken_s ?? (performance.now() - this.began_ms) / 1000).toFixed(0)} s`,
    );
    this.say('Recoveries', String(progress.recoveries ?? this.recoveries));
    if (inList) {
      this.say(
        'Waypoint',
        driving >= 0
          ? `${driving + 1} of ${marks.length}`
          : `${marks.filter((mark) => mark === 'reached').length} of ${marks.length} reached`,
      );
      this.list.mark(marks);
    }
    if (standing.over) this.trip = null;
    this.refresh();
    if (standing.over && !inList) this.marks.show(this.list.items);
  }

  private say(name: Value, text: string): void {
    const element = this.values.get(name);
    if (element) setText(element, text);
  }

  private refresh(): void {
    const drives = this.trip !== null;
    this.cancelButton.disabled = !drives;
    const empty = this.list.items.length === 0;
    this.followButton.disabled = empty || drives || !server(this.host.graph, this.robot, 'goal');
    this.throughButton.disabled =
      empty || drives || !server(this.host.graph, this.robot, 'through');
    this.throughButton.hidden = !server(this.host.graph, this.robot, 'through');
  }

  private modeChanged(): void {
    this.list.draw();
    this.host.touched();
  }

  private listChanged(): void {
    this.list.draw();
    this.marks.show(this.list.items);
    this.refresh();
    this.host.touched();
  }
}
