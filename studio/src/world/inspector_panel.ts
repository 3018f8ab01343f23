/** Properties of what is selected: pose and what the simulator lets one change. */
import * as THREE from 'three';
import type { Connection } from '../connection';
import type { Json } from '../json';
import type { LightValue, PropertyRow } from '../generated/messages';
import { poseOf } from '../model/assembly';
import { BasePanel } from '../panels/base';
import type { PanelHost } from '../panel';
import { activeScene } from '../scene/active_scene';
import { h, notice, setText } from '../widgets/dom';
import { short } from '../widgets/format';
import { lightRows } from './light_rows';
import { worldStore, type WorldStore } from './store';

const NOISE = 1e-9;
const POSE_FIELDS = ['x', 'y', 'z', 'roll', 'pitch', 'yaw'] as const;
const LIVE_MS = 200;

/** Gazebo's property editor, below its tree. */
export class InspectorPanel extends BasePanel {
  readonly title = 'Properties';
  private readonly world: WorldStore;
  private readonly body = h('div', { class: 'inspector' });
  private poseInputs: HTMLInputElement[] = [];
  private asked = 0;
  private last = 0;

  constructor(connection: Connection, host: PanelHost) {
    super(connection, host);
    this.world = worldStore(connection);
    this.element.append(this.body);
    this.atEnd(this.world.onSelection(() => void this.show()));
    this.atEnd(this.world.onScene(() => this.refreshPose(true)));
    this.atEnd(this.world.onPoses(() => this.refreshPose(false)));
  }

  private async show(): Promise<void> {
    const ask = ++this.asked;
    const { selection } = this.world;
    this.poseInputs = [];
    if (!selection) return this.body.replaceChildren(notice('Select a model, a link or a light.'));
    if (selection.light) return this.showLight(selection.light);
    const title = h(
      'h3',
      {},
      selection.link ? `${selection.model}::${selection.link}` : selection.model,
    );
    this.body.replaceChildren(title, this.poseGroup());
    this.refreshPose(true);
    const params: Record<string, string> = selection.link
      ? { model: selection.model, link: selection.link }
      : { model: selection.model };
    const rows = await this.connection
      .call('world.properties', params)
      .catch((problem: unknown) => {
        this.host.fail(problem, 'Properties');
        return [];
      });
    if (ask !== this.asked || !Array.isArray(rows)) return;
    this.body.append(...this.groups(rows as unknown as PropertyRow[], params));
  }

  private showLight(name: string): void {
    const light = this.world.scene?.lights.find((each) => each.name === name);
    if (!light) return this.body.replaceChildren(notice('This light is gone.'));
    const change = (values: Partial<LightValue>): void =>
      void this.world
        .call('world.light', { name, ...(values as object) } as never)
        .catch((problem) => this.host.fail(problem));
    this.body.replaceChildren(h('h3', {}, name), ...lightRows(light, change));
  }

  private poseGroup(): HTMLElement {
    const rows = POSE_FIELDS.map((field) => {
      const unit = field.length === 1 ? 'm' : 'rad';
      const input = h('input', {
        type: 'number',
        step: field.length === 1 ? 0.01 : 0.05,
        'aria-label': `Pose ${field} (${unit})`,
      });
      input.addEventListener('change', () => void this.writePose());
      this.poseInputs.push(input);
      return row(field, input, unit);
    });
    return h('details', { class: 'property-group', open: true }, h('summary', {}, 'pose'), ...rows);
  }

  private groups(values: PropertyRow[], params: Record<string, string>): HTMLElement[] {
    const names = [...new Set(values.map((value) => value.group))].filter(
      (name) => name !== 'pose',
    );
    return names.map((name) =>
      h(
        'details',
        { class: 'property-group', open: true },
        h('summary', {}, name),
        ...values
          .filter((value) => value.group === name)
          .map((value) => row(value.name, this.control(value, params), value.unit)),
      ),
    );
  }

  private control(property: PropertyRow, params: Record<string, string>): HTMLElement {
    const { name, value, editable, unit } = property;
    const set = (next: Json): void =>
      void this.world
        .call('world.set_property', { ...params, name, value: next })
        .catch((problem) => {
          this.host.fail(problem);
          void this.show();
        });
    const label = unit ? `${name} (${unit})` : name;
    if (!editable) return h('span', { class: 'inspector-value' }, plain(value));
    if (typeof value === 'boolean') {
      const input = h('input', {
        type: 'checkbox',
        'aria-label': label,
        on: { change: () => set(input.checked) },
      });
      input.checked = value;
      return input;
    }
    if (typeof value === 'number') {
      const input = h('input', {
        type: 'number',
        step: 'any',
        value: short(value),
        'aria-label': label,
        on: { change: () => input.value !== '' && set(Number(input.value)) },
      });
      return input;
    }
    if (Array.isArray(value)) return list(value, label, set);
    const input = h('input', {
      type: 'text',
      value: plain(value),
      'aria-label': label,
      on: { change: () => set(input.value) },
    });
    return input;
  }

  /** The pose now, of the model or of the link, in the world. */
  private matrix(): THREE.Matrix4 | null {
    const { selection } = this.world;
    const scene = activeScene('gazebo');
    if (!selection || !scene) return this.storedMatrix();
    if (!selection.link) return scene.assembly.modelPose(selection.model);
    const node = scene.assembly.nodes(selection.model, selection.link)[0];
    node?.root.updateMatrix();
    return node?.root.matrix.clone() ?? null;
  }

  /** Without a view the store's poses serve. */
  private storedMatrix(): THREE.Matrix4 | null {
    const { selection, scene } = this.world;
    const index =
      scene?.bodies.findIndex(
        (body) =>
          scene.models[body.model]?.name === selection?.model &&
          (!selection?.link || body.link === selection.link),
      ) ?? -1;
    if (index < 0) return null;
    const [x, y, z, qx, qy, qz, qw] = this.world.pose(index);
    return new THREE.Matrix4().compose(
      new THREE.Vector3(x, y, z),
      new THREE.Quaternion(qx, qy, qz, qw),
      new THREE.Vector3(1, 1, 1),
    );
  }

  private refreshPose(now: boolean): void {
    const time = performance.now();
    if (!this.poseInputs.length || (!now && (!this.visible || time - this.last < LIVE_MS))) return;
    this.last = time;
    const matrix = this.matrix();
    if (!matrix) return;
    const [x, y, z, qx, qy, qz, qw] = poseOf(matrix);
    const euler = new THREE.Euler().setFromQuaternion(new THREE.Quaternion(qx, qy, qz, qw), 'ZYX');
    [x, y, z, euler.x, euler.y, euler.z].forEach((value, index) => {
      const input = this.poseInputs[index];
      const text = (Math.abs(value) < 5e-7 ? 0 : value).toFixed(6);
      if (document.activeElement !== input && input.value !== text) input.value = text;
    });
  }

  private async writePose(): Promise<void> {
    const { selection } = this.world;
    const [x, y, z, roll, pitch, yaw] = this.poseInputs.map((input) => Number(input.value));
    if (!selection || ![x, y, z, roll, pitch, yaw].every(Number.isFinite)) return;
    const turn = new THREE.Quaternion().setFromEuler(new THREE.Euler(roll, pitch, yaw, 'ZYX'));
    const pose = [x, y, z, turn.x, turn.y, turn.z, turn.w];
    const target: Record<string, string> = selection.link
      ? { model: selection.model, link: selection.link }
      : { model: selection.model };
    await this.ask('world.set_pose', { ...target, pose });
  }
}

function row(name: string, control: HTMLElement, unit = ''): HTMLElement {
  const words = h('span', { class: 'property-name' });
  setText(words, name);
  return h(
    'div',
    { class: 'property-row' },
    words,
    h(
      'span',
      { class: 'property-value' },
      control,
      unit ? h('span', { class: 'unit' }, unit) : null,
    ),
  );
}

function list(values: Json[], label: string, set: (value: Json) => void): HTMLElement {
  const inputs = values.map((value, index) =>
    h('input', {
      type: 'number',
      step: 'any',
      value: short(Number(value)),
      'aria-label': `${label} ${index + 1}`,
    }),
  );
  const write = (): void => set(inputs.map((input) => Number(input.value)));
  inputs.forEach((input) => input.addEventListener('change', write));
  return h('span', { class: 'triple' }, ...inputs);
}

/** What is only read: velocities of a body at rest are rounding errors. */
function plain(value: Json): string {
  if (typeof value === 'number') return short(Math.abs(value) < NOISE ? 0 : value, 4);
  if (Array.isArray(value)) return value.map(plain).join(' ');
  return value === null ? '–' : String(value);
}
