/** The tab Scene Objects: what stands around the robot. */
import * as THREE from 'three';
import type { Connection } from '../connection';
import { part, poseMatrix } from '../displays/message_fields';
import { inOneLine } from '../errors';
import type { MotionMesh } from '../generated/messages';
import type { JsonObject } from '../json';
import { askFile } from '../shell/dialog';
import { button, h, notice, select, setText } from '../widgets/dom';
import { download } from '../widgets/download';
import {
  attach,
  changeObjects,
  freeName,
  kindOf,
  meshObject,
  moveOf,
  removalOf,
  SHAPES,
  solid,
  type ShapeName,
} from './objects';
import type { Report } from './planning';
import { readScene, writeScene } from './scene_file';
import type { MotionStore } from './store';

const MESHES = '.stl,.dae,.obj,.gltf,.glb';
const SIZES: Record<ShapeName, [string, number][]> = {
  Box: [
    ['x', 0.1],
    ['y', 0.1],
    ['z', 0.1],
  ],
  Sphere: [['radius', 0.05]],
  Cylinder: [
    ['radius', 0.05],
    ['length', 0.1],
  ],
  Cone: [
    ['radius', 0.05],
    ['length', 0.1],
  ],
};
const TOLD_MS = 2000;
const PLACE = ['x', 'y', 'z', 'roll', 'pitch', 'yaw'] as const;

/** RViz's tab Scene Objects. */
export class ObjectsTab {
  readonly element = h('div', { class: 'scroll motion-page' });
  private readonly list = h('div', {
    class: 'choice-list motion-objects',
    role: 'listbox',
    'aria-label': 'Scene objects',
  });
  private readonly sizes = h('span', { class: 'motion-row' });
  private readonly place: HTMLInputElement[];
  private readonly about = h('div', { class: 'dim' });
  private readonly actions: Record<'attach' | 'remove', HTMLButtonElement>;
  private shape: ShapeName = 'Box';
  private readonly scale = h('input', {
    type: 'number',
    class: 'small',
    min: 0.000001,
    step: 'any',
    value: 1,
    'aria-label': 'Mesh scale',
    title: 'Of mesh files: 0.001 for one in millimetres',
  });
  /** What was typed last and the scene has not told yet: typing goes faster than that. */
  private typed: { id: string; values: number[]; until: number } | null = null;
  private visible = false;
  /** What was chosen when the tab was last in front. */
  private kept = '';

  constructor(
    private readonly store: MotionStore,
    private readonly connection: Connection,
    private readonly report: (report: Report) => void,
  ) {
    const shape = select('Shape', [...SHAPES], 'Box', (name) => {
      this.shape = name as ShapeName;
      this.fillSizes();
    });
    this.place = PLACE.map((name) =>
      h('input', {
        type: 'number',
        step: 'any',
        class: 'small',
        'aria-label': `Object ${name}`,
        on: { change: () => void this.move() },
      }),
    );
    this.actions = {
      attach: button('Attach', () => void this.attach(), {
        title: 'Let the tip of the group hold the object, or let go of it',
      }),
      remove: button('Remove', () => void this.remove(), {
        icon: 'trash',
        title: 'Remove the object',
      }),
    };
    const labelled = this.place.map((input, at) =>
      h('label', { class: 'motion-number' }, h('span', { class: 'dim' }, PLACE[at]), input),
    );
    this.element.append(
      h(
        'div',
        { class: 'motion-row' },
        shape,
        this.sizes,
        button('Add', () => void this.add(), { icon: 'plus', title: 'Add the shape to the scene' }),
      ),
      h(
        'div',
        { class: 'motion-row' },
        button('Mesh file…', () => void this.addMesh(), { title: 'Add an STL, DAE or OBJ file' }),
        h('label', { class: 'motion-number' }, h('span', { class: 'dim' }, 'scale'), this.scale),
        button('Export', () => this.save(), {
          icon: 'save',
          title: 'Save the scene as a .scene file',
        }),
        button('Import…', () => void this.load(), { title: 'Add what a .scene file lists' }),
        button('Clear scene', () => void this.clear(), { title: 'Remove all objects' }),
      ),
      this.list,
      this.about,
      h(
        'div',
        { class: 'motion-row motion-place', role: 'group', 'aria-label': 'Pose' },
        ...labelled,
      ),
      h('div', { class: 'motion-row' }, ...Object.values(this.actions)),
    );
    this.list.addEventListener('keydown', (event) => this.key(event));
    this.element.addEventListener('dragover', (event) => event.preventDefault());
    this.element.addEventListener('drop', (event) => {
      event.preventDefault();
      event.stopPropagation();
      for (const file of event.dataTransfer?.files ?? []) void this.take(file);
    });
    this.fillSizes();
    this.refresh();
  }

  /** The tab came to the front or went: handles are there only while it is. */
  shown(visible: boolean): void {
    this.visible = visible;
    if (visible) this.choose(this.kept);
    else {
      this.kept = this.store.chosen;
      this.choose('');
    }
  }

  /** Show what there is. */
  refresh(): void {
    const { store } = this;
    const rows: [string, string][] = [
      ...store.objects.map((item): [string, string] => [String(item.id), kindOf(item)]),
      ...store.attached.map((body): [string, string] => [
        String(part(body, 'object').id),
        `held by ${String(body.link_name)}`,
      ]),
    ];
    const focused = this.list.contains(document.activeElement);
    this.list.replaceChildren(
      ...rows.map(([id, what]) =>
        h(
          'button',
          {
            type: 'button',
            class: 'choice',
            role: 'option',
            'data-object': id,
            'aria-selected': String(id === store.chosen),
            tabindex: id === store.chosen || (!store.chosen && id === rows[0][0]) ? 0 : -1,
            on: { click: () => this.choose(id) },
          },
          id,
          h('span', { class: 'dim' }, `  ${what}`),
        ),
      ),
    );
    if (!rows.length) this.list.append(notice('There are no objects in the planning scene.'));
    if (focused) this.list.querySelector<HTMLElement>('[aria-selected=true]')?.focus();
    this.refreshChosen();
  }

  private refreshChosen(): void {
    const item = this.item();
    const held = this.held();
    this.actions.remove.disabled = !item;
    this.actions.attach.disabled = !item && !held;
    setText(this.actions.attach, held ? 'Detach' : 'Attach');
    setText(
      this.about,
      item ? `${this.store.chosen} in ${String(part(item, 'header').frame_id)}` : '',
    );
    const values = this.valuesOf(item);
    this.place.forEach((input, at) => {
      input.disabled = !item;
      if (document.activeElement !== input)
        input.value = Number.isNaN(values[at]) ? '' : String(Number(values[at].toFixed(4)));
    });
  }

  /** What the fields say of an object; nothing without one. */
  private valuesOf(item: JsonObject | undefined): number[] {
    if (!item) return PLACE.map(() => NaN);
    const values = numbersOf(poseMatrix(item.pose));
    const { typed } = this;
    const isLate =
      typed !== null &&
      typed.id === item.id &&
      performance.now() < typed.until &&
      typed.values.some((value, at) => Math.abs(value - values[at]) > 1e-6);
    if (isLate) return typed.values;
    this.typed = null;
    return values;
  }

  private item(): JsonObject | undefined {
    return this.store.objects.find((item) => item.id === this.store.chosen);
  }

  private held(): JsonObject | undefined {
    return this.store.attached.find((body) => part(body, 'object').id === this.store.chosen);
  }

  private choose(id: string): void {
    if (id === this.store.chosen) return;
    this.store.chosen = this.visible ? id : '';
    this.store.tell('scene');
  }

  private key(event: KeyboardEvent): void {
    const rows = [...this.list.querySelectorAll<HTMLElement>('[role=option]')];
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step && rows.length) {
      const at = rows.findIndex((row) => row.dataset.object === this.store.chosen);
      this.choose(rows[Math.max(0, Math.min(rows.length - 1, at + step))].dataset.object ?? '');
    } else if (event.key === 'Delete' && this.item()) void this.remove();
    else return;
    event.preventDefault();
  }

  private fillSizes(): void {
    this.sizes.replaceChildren(
      ...SIZES[this.shape].map(([name, value]) =>
        h(
          'label',
          { class: 'motion-number' },
          h('span', { class: 'dim' }, name),
          h('input', {
            type: 'number',
            class: 'small',
            min: 0.0001,
            step: 'any',
            value,
            'aria-label': `${this.shape} ${name} (m)`,
          }),
        ),
      ),
    );
  }

  private async add(): Promise<void> {
    const { robot } = this.store;
    const sizes = [...this.sizes.querySelectorAll('input')].map((input) => Number(input.value));
    if (!robot) return;
    if (!sizes.every((size) => size > 0))
      return this.report({
        level: 'error',
        text: `The sizes of a ${this.shape} must be above 0 m.`,
      });
    const id = freeName(this.store, this.shape);
    await this.make(id, solid(id, robot.frame, this.shape, sizes, new THREE.Matrix4()));
  }

  private async addMesh(): Promise<void> {
    const file = await askFile(MESHES);
    if (file) await this.take(file);
  }

  /** A file that was chosen or dropped: a mesh or a scene. */
  private async take(file: File): Promise<void> {
    if (file.name.endsWith('.scene')) return this.read(file);
    const { robot } = this.store;
    if (!robot) return;
    const scale = Number(this.scale.value);
    if (!(scale > 0))
      return this.report({ level: 'error', text: 'The scale of a mesh must be above 0.' });
    await this.tried(async () => {
      const mesh = await this.connection.call('motion.mesh', {
        name: file.name,
        base64: await base64Of(file),
      });
      const id = freeName(this.store, file.name.replace(/\.[^.]*$/, ''));
      await this.make(
        id,
        meshObject(id, robot.frame, mesh as unknown as MotionMesh, scale, new THREE.Matrix4()),
      );
    });
  }

  private async make(id: string, item: JsonObject): Promise<void> {
    await this.tried(async () => {
      await changeObjects(this.store, [item]);
      // Until the scene tells of it there is nothing to be typed into.
      this.choose(id);
    }, `Added ${id}.`);
  }

  private async move(): Promise<void> {
    const item = this.item();
    if (!item) return;
    const values = this.place.map((input) => Number(input.value) || 0);
    const [x, y, z, roll, pitch, yaw] = values;
    this.typed = { id: this.store.chosen, values, until: performance.now() + TOLD_MS };
    const pose = new THREE.Matrix4()
      .makeRotationFromEuler(new THREE.Euler(roll, pitch, yaw, 'ZYX'))
      .setPosition(x, y, z);
    await this.tried(() => changeObjects(this.store, [moveOf(item, pose)]));
  }

  private async remove(): Promise<void> {
    const id = this.store.chosen;
    await this.tried(() => changeObjects(this.store, [removalOf(id)]), `Removed ${id}.`);
    this.choose('');
  }

  private async clear(): Promise<void> {
    const all = this.store.objects.map((item) => removalOf(String(item.id)));
    if (all.length)
      await this.tried(() => changeObjects(this.store, all), `Removed ${all.length} objects.`);
    this.choose('');
  }

  private async attach(): Promise<void> {
    const id = this.store.chosen;
    const on = !this.held();
    await this.tried(() => attach(this.store, id, on), on ? `Attached ${id}.` : `Detached ${id}.`);
  }

  private save(): void {
    const name = this.store.robot?.name ?? 'scene';
    download(`${name}.scene`, writeScene(name, this.store.objects));
  }

  private async load(): Promise<void> {
    const file = await askFile('.scene');
    if (file) await this.read(file);
  }

  private async read(file: File): Promise<void> {
    const { robot } = this.store;
    if (!robot) return;
    await this.tried(async () => {
      const items = readScene(await file.text(), robot.frame, file.name);
      await changeObjects(this.store, items);
      this.report({ level: 'ok', text: `Added ${items.length} objects of ${file.name}.` });
    });
  }

  private async tried(work: () => Promise<void>, done = ''): Promise<void> {
    try {
      await work();
      if (done) this.report({ level: 'ok', text: done });
    } catch (problem) {
      this.report({ level: 'error', text: inOneLine(problem) });
    }
  }
}

function numbersOf(pose: THREE.Matrix4): number[] {
  const at = new THREE.Vector3().setFromMatrixPosition(pose);
  const turn = new THREE.Euler().setFromRotationMatrix(pose, 'ZYX');
  return [at.x, at.y, at.z, turn.x, turn.y, turn.z];
}

async function base64Of(file: File): Promise<string> {
  const bytes = new Uint8Array(await file.arrayBuffer());
  let text = '';
  for (let at = 0; at < bytes.length; at += 0x8000)
    text += String.fromCharCode(...bytes.subarray(at, at + 0x8000));
  return btoa(text);
}
