/** Joints: Gazebo's joint control, by force, by position and by velocity with PID. */
import type { Channel } from '../channel';
import type { Connection } from '../connection';
import type { WorldJoint } from '../generated/messages';
import type { Json, JsonObject } from '../json';
import { BasePanel } from '../panels/base';
import type { PanelHost } from '../panel';
import { button, fillSelect, h, notice, select, setText, toolbar } from '../widgets/dom';
import { worldStore, type WorldStore } from './store';

type Mode = 'force' | 'position' | 'velocity';
const MODES: Record<Mode, string> = { force: 'Force', position: 'Position', velocity: 'Velocity' };
const GAINS = ['p', 'i', 'd'] as const;
const FIRST_GAINS: Record<Mode, readonly number[]> = {
  force: [],
  position: [1, 0.1, 0.01],
  velocity: [1, 0.1, 0.01],
};

/** Gazebo's Joints tab of the selected model. */
export class JointsPanel extends BasePanel {
  readonly title = 'Joints';
  private readonly world: WorldStore;
  private readonly models = select('Model', [], '', (name) => this.choose(name));
  private readonly body = h('div', { class: 'joints' });
  private mode: Mode = 'force';
  private model = '';
  private channel: Channel | null = null;
  private rows = new Map<
    string,
    { position: HTMLElement; velocity: HTMLElement; effort: HTMLElement }
  >();
  private names = '';

  constructor(connection: Connection, host: PanelHost) {
    super(connection, host);
    this.world = worldStore(connection);
    const tabs = (Object.keys(MODES) as Mode[]).map((mode) => {
      const tab = button(MODES[mode], () => this.setMode(mode, tabs), {
        pressed: mode === this.mode,
      });
      return tab;
    });
    this.element.classList.add('joints-panel');
    this.element.append(
      toolbar(
        'Joints',
        this.models,
        ...tabs,
        button('Reset', () => void this.free(), { title: 'Take all commands off this model' }),
      ),
      this.body,
    );
    this.atEnd(this.world.onScene(() => this.fill()));
    this.atEnd(
      this.world.onSelection(() => {
        const name = this.world.selection?.model;
        if (name && this.movable().includes(name)) this.choose(name);
      }),
    );
  }

  override open(params: JsonObject): void {
    if (typeof params.model === 'string') this.choose(params.model);
  }

  override state(): JsonObject {
    return { model: this.model };
  }

  private movable(): string[] {
    const { scene } = this.world;
    return (scene?.models ?? [])
      .filter((model) => model.joints.some((index) => scene?.joints[index].type !== 'fixed'))
      .map((model) => model.name);
  }

  private fill(): void {
    const names = this.movable();
    if (!names.includes(this.model)) this.model = '';
    fillSelect(this.models, names, this.model);
    if (!this.model) this.choose(names[0] ?? '');
  }

  private choose(model: string): void {
    if (model === this.model && this.channel) return;
    this.model = model;
    this.models.value = model;
    this.endStream(this.channel);
    this.channel = null;
    this.names = '';
    this.body.replaceChildren(
      notice(model ? 'Waiting for the joints…' : 'No model with joints is in the world.'),
    );
    if (!model) return;
    const gone = () => this.body.replaceChildren(notice(`${model} is no longer in the world.`));
    this.channel = this.stream(
      'world.joints',
      { model },
      { onData: (value) => this.take(value), onFailed: gone, onEnded: gone },
    );
  }

  private setMode(mode: Mode, tabs: HTMLElement[]): void {
    this.mode = mode;
    tabs.forEach((tab, index) =>
      tab.setAttribute('aria-pressed', String(Object.keys(MODES)[index] === mode)),
    );
    this.names = '';
  }

  private take(value: Json): void {
    if (!Array.isArray(value)) return;
    const joints = (value as unknown as WorldJoint[]).filter((joint) => joint.type !== 'fixed');
    const names = `${this.mode} ${joints.map((joint) => joint.name).join()}`;
    if (names !== this.names) {
      this.names = names;
      this.rows.clear();
      this.body.replaceChildren(...joints.map((joint) => this.joint(joint)));
    }
    for (const joint of joints) {
      const row = this.rows.get(joint.name);
      if (!row) continue;
      setText(row.position, number(joint.position));
      setText(row.velocity, number(joint.velocity));
      setText(row.effort, number(joint.effort));
    }
  }

  private joint(joint: WorldJoint): HTMLElement {
    const [position, velocity, effort] = [0, 1, 2].map(() => h('output', {}));
    this.rows.set(joint.name, { position, velocity, effort });
    const linear = joint.type === 'prismatic';
    const units = linear ? ['m', 'm/s', 'N'] : ['rad', 'rad/s', 'N·m'];
    return h(
      'fieldset',
      { class: 'joint', 'data-joint': joint.name },
      h('legend', {}, joint.name, h('span', { class: 'entity-note' }, joint.type)),
      ...this.controls(joint, units),
      h(
        'div',
        { class: 'joint-state' },
        position,
        ` ${units[0]}`,
        velocity,
        ` ${units[1]}`,
        effort,
        ` ${units[2]}`,
      ),
    );
  }

  private controls(joint: WorldJoint, units: string[]): HTMLElement[] {
    if (this.mode === 'force') {
      const force = field(`${joint.name} force (${units[2]})`, 0, 0.1);
      force.addEventListener('change', () =>
        this.command(joint.name, { force: Number(force.value) }),
      );
      return [h('div', { class: 'joint-row' }, h('span', {}, units[2]), force)];
    }
    const mode = this.mode;
    const gains = GAINS.map((gain, index) =>
      field(`${joint.name} ${gain}`, FIRST_GAINS[mode][index], 0.1),
    );
    const target = field(
      `${joint.name} ${mode} (${units[mode === 'position' ? 0 : 1]})`,
      mode === 'position' ? joint.position : 0,
      0.05,
    );
    const slider = h('input', {
      type: 'range',
      step: 'any',
      min: joint.lower ?? -Math.PI,
      max: joint.upper ?? Math.PI,
      value: Number(target.value),
      'aria-label': `${joint.name} ${mode} slider`,
    });
    const send = (): void =>
      this.command(joint.name, {
        [mode]: Number(target.value),
        ...Object.fromEntries(GAINS.map((gain, index) => [gain, Number(gains[index].value)])),
      });
    target.addEventListener('change', () => {
      slider.value = target.value;
      send();
    });
    slider.addEventListener('input', () => {
      target.value = Number(slider.value).toFixed(3);
      send();
    });
    gains.forEach((gain) => gain.addEventListener('change', send));
    const labels = GAINS.map((gain, index) =>
      h('label', { class: 'gain' }, gain.toUpperCase(), gains[index]),
    );
    return [
      h(
        'div',
        { class: 'joint-row' },
        h('span', {}, units[mode === 'position' ? 0 : 1]),
        target,
        mode === 'position' ? slider : null,
      ),
      h('div', { class: 'joint-row' }, ...labels),
    ];
  }

  private command(joint: string, values: JsonObject): void {
    void this.ask('world.joint', { model: this.model, joint, ...values });
  }

  private async free(): Promise<void> {
    for (const joint of this.rows.keys()) {
      await this.ask('world.joint', {
        model: this.model,
        joint,
        force: null,
        position: null,
        velocity: null,
      });
    }
    this.names = '';
  }
}

function field(label: string, value: number, step: number): HTMLInputElement {
  return h('input', {
    type: 'number',
    step: 'any',
    value: Number(value.toFixed(4)),
    'aria-label': label,
    'data-step': step,
  });
}

function number(value: number | null | undefined): string {
  return typeof value === 'number' ? value.toFixed(3) : '–';
}
