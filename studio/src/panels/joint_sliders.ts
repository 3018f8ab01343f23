/** Joint State Publisher: a slider for every joint that can move. */

import { isObject, numberOf, textOf, type Json, type JsonObject } from '../json';
import { button, h, notice, spacer, toggle, toolbar } from '../widgets/dom';
import { nameInput } from '../widgets/name_input';
import { BasePanel } from './base';

interface Joint {
  name: string;
  lower: number;
  upper: number;
  centre: number;
  slider: HTMLInputElement;
  number: HTMLInputElement;
}
interface Mimic {
  name: string;
  joint: string;
  multiplier: number;
  offset: number;
}

const PUBLISH_EVERY_MS = 100;
/** Publishers that are this panel, or stand for it. */
const OWN = /\/(_?studio|joint_state_publisher(_gui)?)[^/]*$/;
const MOVABLE = new Set(['revolute', 'continuous', 'prismatic']);

/** joint_state_publisher_gui. */
export class JointSliders extends BasePanel {
  readonly title = 'Joint State Publisher';
  private parameter = '/robot_description';
  private source = '';
  private topic = '/joint_states';
  private joints: Joint[] = [];
  private mimics: Mimic[] = [];
  private kept: JsonObject = {};
  /** Undecided until the robot is known: nobody's joint states shall be talked over by chance. */
  private publishing: boolean | null = null;
  private readonly publishButton = toggle(
    'Publish',
    false,
    (on) => {
      this.publishing = on;
      this.changed();
    },
    { icon: 'send', title: 'Publish the positions' },
  );
  private readonly topicInput: HTMLInputElement;
  private readonly body = h(
    'div',
    { class: 'scroll joints' },
    notice('Reading the robot description …'),
  );

  constructor(...args: ConstructorParameters<typeof BasePanel>) {
    super(...args);
    this.topicInput = nameInput({
      label: 'Joint state topic',
      value: this.topic,
      names: () => this.host.graph.topicsOf(['sensor_msgs/JointState']).map((each) => each.name),
      chosen: (name) => {
        this.topic = name || this.topic;
        this.host.touched();
      },
    });
    this.element.append(
      toolbar(
        'Joint state publisher',
        this.publishButton,
        button(
          'Randomize',
          () => this.setAll((joint) => joint.lower + Math.random() * (joint.upper - joint.lower)),
          { icon: 'random' },
        ),
        button('Center', () => this.setAll((joint) => joint.centre), { icon: 'centre' }),
        spacer(),
        h('span', {}, this.topicInput),
        button('', () => void this.load(), {
          icon: 'refresh',
          title: 'Read the robot description again',
        }),
      ),
      this.body,
    );
    const timer = setInterval(() => this.publish(), PUBLISH_EVERY_MS);
    this.atEnd(() => clearInterval(timer));
  }

  override open(params: JsonObject): void {
    this.parameter = textOf(params, 'parameter', this.parameter);
    this.source = textOf(params, 'source', this.source);
    this.topic = textOf(params, 'topic', this.topic);
    this.topicInput.value = this.topic;
    // joint_state_publisher_gui's own way from the sliders to it, which means nothing to a person.
    this.topicInput.hidden = this.topic.startsWith('/_gazelle/');
    if (typeof params.publish === 'boolean') this.publishing = params.publish;
    if (isObject(params.positions)) this.kept = params.positions;
    void this.load();
  }

  override state(): JsonObject {
    return {
      parameter: this.parameter,
      source: this.source,
      topic: this.topic,
      publish: this.publishing,
      positions: this.positions(),
    };
  }

  private positions(): JsonObject {
    return Object.fromEntries(this.joints.map((joint) => [joint.name, Number(joint.slider.value)]));
  }

  private async load(): Promise<void> {
    if (this.joints.length > 0) this.kept = this.positions();
    const params: JsonObject = this.source ? { topic: this.source } : { parameter: this.parameter };
    try {
      this.take(await this.connection.call('robot.get', params));
    } catch (problem) {
      this.body.replaceChildren(
        notice(`There is no robot description at ${this.source || this.parameter} yet.`),
        h(
          'div',
          { class: 'centred' },
          button('Read again', () => void this.load(), { icon: 'refresh' }),
        ),
      );
      if (this.visible) this.host.fail(problem);
    }
  }

  private take(scene: Json): void {
    const all = isObject(scene) && Array.isArray(scene.joints) ? scene.joints.filter(isObject) : [];
    const movable = all.filter((joint) => MOVABLE.has(textOf(joint, 'type')));
    this.mimics = movable.flatMap((joint) =>
      isObject(joint.mimic) ? [mimicOf(textOf(joint, 'name'), joint.mimic)] : [],
    );
    this.joints = movable
      .filter((joint) => !isObject(joint.mimic))
      .map((joint) => this.joint(joint));
    this.body.replaceChildren(
      ...this.joints.map((joint) =>
        h(
          'div',
          { class: 'joint-row' },
          h('span', { class: 'ellipsis', title: joint.name }, joint.name),
          joint.slider,
          joint.number,
        ),
      ),
    );
    if (this.joints.length === 0)
      this.body.append(notice('This robot has no joint that can move.'));
    this.decide();
    this.publish();
  }

  /** Begins to publish unless somebody else tells the joints' positions already. */
  private decide(): void {
    const others =
      this.host.graph.value.topics
        .find((each) => each.name === this.topic)
        ?.publishers.filter((name) => !OWN.test(name)) ?? [];
    this.publishing ??= others.length === 0;
    this.publishButton.setAttribute('aria-pressed', String(this.publishing));
    if (!this.publishing && others.length > 0) {
      this.body.prepend(
        h(
          'div',
          { class: 'hint-line' },
          `${others.join(', ')} publishes on ${this.topic}; press Publish to do so as well.`,
        ),
      );
    }
  }

  private joint(value: JsonObject): Joint {
    const name = textOf(value, 'name');
    const turning = textOf(value, 'type') === 'continuous';
    const lower = turning ? -Math.PI : numberOf(value, 'lower');
    const upper = turning ? Math.PI : numberOf(value, 'upper');
    const centre = lower > 0 || upper < 0 ? (lower + upper) / 2 : 0;
    const shown = { min: lower, max: upper, step: (upper - lower) / 10_000 || 0.001 };
    const slider = h('input', { type: 'range', ...shown, 'aria-label': name });
    const number = h('input', {
      type: 'number',
      min: lower,
      max: upper,
      step: 'any',
      'aria-label': `${name} position`,
    });
    const joint = { name, lower, upper, centre, slider, number };
    set(joint, numberOf(this.kept, name, centre));
    slider.addEventListener('input', () => {
      set(joint, Number(slider.value));
      this.changed();
    });
    number.addEventListener('change', () => {
      set(joint, Number(number.value));
      this.changed();
    });
    return joint;
  }

  private setAll(value: (joint: Joint) => number): void {
    for (const joint of this.joints) set(joint, value(joint));
    this.changed();
  }

  private changed(): void {
    this.publish();
    this.host.touched();
  }

  private publish(): void {
    if (!this.publishing || this.joints.length === 0 || this.connection.state !== 'open') return;
    const positions = new Map(this.joints.map((joint) => [joint.name, Number(joint.number.value)]));
    for (const mimic of this.mimics) {
      const leader = positions.get(mimic.joint);
      if (leader !== undefined) positions.set(mimic.name, leader * mimic.multiplier + mimic.offset);
    }
    this.connection
      .call('joints.publish', {
        topic: this.topic,
        names: [...positions.keys()],
        positions: [...positions.values()],
      })
      .catch((problem: unknown) => this.host.fail(problem, this.topic));
  }
}

function set(joint: Joint, value: number): void {
  const kept = Math.min(
    joint.upper,
    Math.max(joint.lower, Number.isFinite(value) ? value : joint.centre),
  );
  joint.slider.value = String(kept);
  joint.number.value = String(Number(kept.toFixed(4)));
}

function mimicOf(name: string, value: JsonObject): Mimic {
  return {
    name,
    joint: textOf(value, 'joint'),
    multiplier: numberOf(value, 'multiplier', 1),
    offset: numberOf(value, 'offset'),
  };
}
