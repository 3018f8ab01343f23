/** Robot Steering and Teleop: velocity commands from sliders, a pad and keys. */

import { numberOf, textOf, textsOf, type JsonObject } from '../json';
import { shortType } from '../graph_store';
import { button, h, select, setText, spacer, toolbar } from '../widgets/dom';
import { nameInput } from '../widgets/name_input';
import { BasePanel } from './base';
import { DriveKeys, directionOf, type Direction } from './drive_keys';
import { DrivePad } from './drive_pad';

const TYPES = ['geometry_msgs/Twist', 'geometry_msgs/TwistStamped'] as const;
const SEND_EVERY_MS = 100;
const STILL: Direction = { x: 0, y: 0, z: 0, turn: 0 };

/** Sends `geometry_msgs/Twist` while something is held, and zero when it is let go. */
export class Drive extends BasePanel {
  private topic = '/cmd_vel';
  private type: string = TYPES[0];
  private linear = 0.5;
  private angular = 1;
  private held: Direction = STILL;
  private slid = { linear: 0, angular: 0 };
  private moving = false;
  private readonly keys: DriveKeys;
  private readonly pad: DrivePad;
  private readonly topicInput: HTMLInputElement;
  private readonly typeChoice: HTMLSelectElement;
  private readonly linearSlider = slider('Linear velocity', 'm/s');
  private readonly angularSlider = slider('Angular velocity', 'rad/s');
  private readonly linearMost = most('Largest linear velocity in m/s', this.linear);
  private readonly angularMost = most('Largest angular velocity in rad/s', this.angular);
  private readonly shownValue = h('output', {
    class: 'mono drive-value',
    'aria-label': 'Velocity command',
  });
  private readonly surface = h('div', {
    class: 'drive-surface',
    tabindex: 0,
    'data-keys': 'drive',
    role: 'application',
  });

  constructor(
    readonly title: string,
    ...args: ConstructorParameters<typeof BasePanel>
  ) {
    super(...args);
    this.element.classList.add('drive');
    this.topicInput = nameInput({
      label: 'Velocity topic',
      value: this.topic,
      names: () => this.host.graph.topicsOf(TYPES).map((each) => each.name),
      chosen: (name) => this.setTopic(name),
    });
    this.typeChoice = select('Type', TYPES, this.type, (type) => {
      this.type = type;
      this.host.touched();
    });
    this.pad = new DrivePad((forward, turn) => this.hold({ ...STILL, x: forward, turn }));
    this.keys = new DriveKeys(
      this.surface,
      (pressed) => this.hold(directionOf(pressed)),
      (factor) => this.faster(factor),
    );
    this.build();
    const timer = setInterval(() => this.send(), SEND_EVERY_MS);
    this.atEnd(() => clearInterval(timer));
    const stop = () => this.stop();
    addEventListener('pagehide', stop);
    addEventListener('blur', stop);
    this.atEnd(() => {
      removeEventListener('pagehide', stop);
      removeEventListener('blur', stop);
    });
  }

  override open(params: JsonObject): void {
    this.linear = numberOf(params, 'linear', this.linear);
    this.angular = numberOf(params, 'angular', this.angular);
    this.setTopic(textOf(params, 'topic') || textsOf(params, 'args')[0] || this.topic);
    this.type = textOf(params, 'type', this.type);
    this.typeChoice.value = this.type;
    this.showLimits();
  }

  override state(): JsonObject {
    return { topic: this.topic, type: this.type, linear: this.linear, angular: this.angular };
  }

  override shown(visible: boolean): void {
    super.shown(visible);
    if (!visible) this.stop();
  }

  override dispose(): void {
    this.stop();
    super.dispose();
  }

  private build(): void {
    this.surface.setAttribute(
      'aria-label',
      'Drive with the keys W A S D, the arrows, or u i o j k l m , . as in teleop_twist_keyboard',
    );
    this.surface.append(this.pad.element, this.shownValue);
    for (const [input, name] of [
      [this.linearSlider, 'linear'],
      [this.angularSlider, 'angular'],
    ] as const) {
      input.addEventListener('input', () => {
        this.slid = { ...this.slid, [name]: Number(input.value) };
        this.send();
      });
    }
    this.linearMost.addEventListener('change', () => {
      this.linear = Math.abs(Number(this.linearMost.value)) || this.linear;
      this.showLimits();
    });
    this.angularMost.addEventListener('change', () => {
      this.angular = Math.abs(Number(this.angularMost.value)) || this.angular;
      this.showLimits();
    });
    this.element.append(
      toolbar(
        this.title,
        h('span', {}, this.topicInput),
        this.typeChoice,
        spacer(),
        button('Stop', () => this.stop(), { icon: 'stop', title: 'Stop', class: 'danger' }),
      ),
      h(
        'div',
        { class: 'drive-body' },
        this.surface,
        h(
          'div',
          { class: 'drive-sliders' },
          h(
            'label',
            {},
            h('span', {}, 'Linear'),
            this.linearSlider,
            this.linearMost,
            h('span', { class: 'dim' }, 'm/s'),
          ),
          h(
            'label',
            {},
            h('span', {}, 'Angular'),
            this.angularSlider,
            this.angularMost,
            h('span', { class: 'dim' }, 'rad/s'),
          ),
          keyHelp(),
        ),
      ),
    );
    this.surface.addEventListener('pointerdown', () => this.surface.focus());
    this.showLimits();
  }

  private setTopic(name: string): void {
    if (this.moving) this.stop();
    this.topic = name || this.topic;
    this.topicInput.value = this.topic;
    const known = shortType(this.host.graph.typeOf(this.topic) ?? '');
    if ((TYPES as readonly string[]).includes(known)) this.type = known;
    this.typeChoice.value = this.type;
    this.host.touched();
  }

  private showLimits(): void {
    for (const [input, limit] of [
      [this.linearSlider, this.linear],
      [this.angularSlider, this.angular],
    ] as const) {
      input.min = String(-limit);
      input.max = String(limit);
      input.step = String(limit / 100);
    }
    this.linearMost.value = String(this.linear);
    this.angularMost.value = String(this.angular);
    this.host.touched();
  }

  private faster(factor: number): void {
    this.linear = Number((this.linear * factor).toPrecision(4));
    this.angular = Number((this.angular * factor).toPrecision(4));
    this.showLimits();
  }

  private hold(direction: Direction): void {
    this.held = direction;
    this.send();
  }

  private stop(): void {
    this.held = STILL;
    this.slid = { linear: 0, angular: 0 };
    this.linearSlider.value = this.angularSlider.value = '0';
    this.keys.release();
    this.pad.release();
    this.send();
  }

  /** Sends while something moves, and zero once afterwards. */
  private send(): void {
    const x = this.held.x * this.linear + this.slid.linear;
    const turn = this.held.turn * this.angular + this.slid.angular;
    const twist = {
      linear: { x, y: this.held.y * this.linear, z: this.held.z * this.linear },
      angular: { x: 0, y: 0, z: turn },
    };
    const moves = x !== 0 || turn !== 0 || twist.linear.y !== 0 || twist.linear.z !== 0;
    setText(
      this.shownValue,
      `x ${x.toFixed(2)} m/s   y ${twist.linear.y.toFixed(2)} m/s   turn ${turn.toFixed(2)} rad/s`,
    );
    if (!moves && !this.moving) return;
    this.moving = moves;
    const message: JsonObject =
      this.type === TYPES[1] ? { header: { stamp: 'now' }, twist } : twist;
    this.connection
      .call('topic.publish', { topic: this.topic, type: this.type, message })
      .catch((problem: unknown) => {
        this.moving = false;
        this.held = STILL;
        this.host.fail(problem, this.topic);
      });
  }
}

function slider(label: string, unit: string): HTMLInputElement {
  return h('input', {
    type: 'range',
    value: 0,
    min: -1,
    max: 1,
    step: 0.01,
    'aria-label': `${label} in ${unit}`,
  });
}

function most(label: string, value: number): HTMLInputElement {
  return h('input', {
    type: 'number',
    min: 0,
    step: 'any',
    value,
    class: 'small',
    'aria-label': label,
    title: label,
  });
}

function keyHelp(): HTMLElement {
  const rows = [
    ['W A S D  or arrows', 'drive and turn'],
    ['u i o  j k l  m , .', 'as teleop_twist_keyboard'],
    ['Shift', 'sideways'],
    ['t b', 'up and down'],
    ['q z', 'faster, slower'],
    ['Space', 'stop'],
  ];
  return h(
    'dl',
    { class: 'key-help' },
    ...rows.flatMap(([keys, text]) => [h('dt', {}, h('kbd', {}, keys)), h('dd', {}, text)]),
  );
}
