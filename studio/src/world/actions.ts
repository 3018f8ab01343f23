/** What can be done with the world from a view: insert, delete, follow, view one model. */
import * as THREE from 'three';
import { asCallError } from '../errors';
import { DISPLAY_ROWS } from '../generated/displays';
import { isObject, textOf, textsOf, type JsonObject } from '../json';
import { poseOf } from '../model/assembly';
import type { Entity } from '../model/body';
import { MODES, type Mode } from '../model/view_modes';
import type { Pose } from '../model/pose';
import { scenePanels } from '../scene/active_scene';
import { groundPoint } from '../scene/picking';
import type { ScenePanel } from '../scene/scene_panel';
import type { MenuItem } from '../widgets/menu';
import { openMenuAt } from './menu';
import { openWrenchDialog } from './wrench_dialog';

const SIZES: Record<string, JsonObject> = {
  box: { size: [1, 1, 1] },
  sphere: { radius: 0.5 },
  cylinder: { radius: 0.5, length: 1 },
};
const HALF_M = 0.5;

/** Insert a source of `world.insert` where one looks (or at a point), and take it in hand. */
export async function insert(
  panel: ScenePanel,
  source: JsonObject,
  name: string,
  at?: THREE.Vector3,
  height = 0,
): Promise<void> {
  const [x, y] = at ? [at.x, at.y] : freePlace(panel);
  const pose: Pose = [rounded(x), rounded(y), height, 0, 0, 0, 1];
  try {
    const answer = await panel.world.call('world.insert', {
      source,
      name: freeName(panel, name),
      pose,
    });
    const made = isObject(answer) ? textOf(answer, 'name', name) : name;
    panel.say(`Inserted ${made}`);
    selectWhenThere(panel, made);
  } catch (problem) {
    panel.fail(problem);
  }
}

/** Insert a box, sphere or cylinder standing on the ground. */
export function insertPrimitive(
  panel: ScenePanel,
  shape: 'box' | 'sphere' | 'cylinder',
  at?: THREE.Vector3,
): Promise<void> {
  return insert(panel, { primitive: shape, ...SIZES[shape] }, shape, at, HALF_M);
}

/** Remove a model. */
export async function remove(panel: ScenePanel, model: string): Promise<void> {
  try {
    await panel.world.call('world.delete', { model });
    panel.say(`Deleted ${model}`);
  } catch (problem) {
    panel.fail(problem);
  }
}

/** Look at a model or link. */
export function moveTo(panel: ScenePanel, model: string, link?: string): void {
  panel.view.rig.moveTo(panel.assembly.worldBox(panel.assembly.nodes(model, link)));
}

/** Follow a model with the camera. */
export function follow(panel: ScenePanel, model: string): void {
  panel.view.rig.follow(() => panel.assembly.modelPose(model));
  panel.say(`Following ${model}; View > Stop following ends it.`);
}

/** The menu of a model or link, as Gazebo's. */
export function entityMenu(panel: ScenePanel, entity: Entity, x: number, y: number): void {
  const { model, link } = entity;
  panel.world.select({ model });
  const modes = (Object.keys(MODES) as Mode[]).map((mode): MenuItem => {
    const on = panel.assembly.modes.isOn(mode, model);
    return { text: MODES[mode], checked: on, run: () => panel.setMode(mode, !on, model) };
  });
  openMenuAt(x, y, model, [
    { text: model, heading: true },
    { text: 'Move To', run: () => moveTo(panel, model) },
    { text: 'Follow', run: () => follow(panel, model) },
    { text: 'Apply Force/Torque…', run: () => openWrenchDialog(panel, model, link) },
    { text: 'Copy pose', run: () => void copyPose(panel, model) },
    { text: 'Delete', note: 'Del', run: () => void remove(panel, model) },
    { text: 'View', heading: true },
    ...modes,
  ]);
}

/** Keys of the world: Delete. */
export function worldKey(panel: ScenePanel, event: KeyboardEvent): boolean {
  const model = panel.world.selection?.model;
  if (event.key !== 'Delete' || !model || panel.kind !== 'gazebo') return false;
  void remove(panel, model);
  return true;
}

/** Take URDF and SDF files, and things of the Insert panel, that are dropped on a view. */
export function acceptFiles(element: HTMLElement, panel: ScenePanel): void {
  element.addEventListener('dragover', (event) => {
    event.preventDefault();
    element.classList.add('drop-here');
  });
  element.addEventListener('dragleave', () => element.classList.remove('drop-here'));
  element.addEventListener('drop', (event) => {
    event.preventDefault();
    element.classList.remove('drop-here');
    void dropped(panel, event);
  });
}

async function dropped(panel: ScenePanel, event: DragEvent): Promise<void> {
  const at = groundPoint(panel.view, event.clientX, event.clientY) ?? undefined;
  const own = event.dataTransfer?.getData('application/x-gazelle-source');
  if (own) {
    const { source, name, height } = JSON.parse(own) as {
      source: JsonObject;
      name: string;
      height: number;
    };
    return insert(panel, source, name, at, height);
  }
  for (const file of event.dataTransfer?.files ?? []) await insertFile(panel, file, at);
}

/** Insert a URDF or SDF file, or open a `.rviz` file. */
export async function insertFile(panel: ScenePanel, file: File, at?: THREE.Vector3): Promise<void> {
  const text = await file.text();
  if (file.name.endsWith('.rviz')) return openRviz(panel, { text, name: file.name });
  if (!/<(robot|sdf|model|world)[\s>]/.test(text)) {
    panel.fail(
      new Error(`${file.name} is neither URDF nor SDF: it has no <robot>, <sdf> or <model>.`),
    );
    return;
  }
  await insert(panel, { text, file: file.name }, file.name.replace(/\.[^.]*$/, ''), at);
}

/** Show what a `.rviz` file lists: one by its `path` where the server is, or its `text`. */
export async function openRviz(panel: ScenePanel, file: JsonObject): Promise<void> {
  try {
    const value = await panel.connection.call('rviz.open', file);
    if (!isObject(value)) return;
    panel.open({ displays: value, ...(isObject(value.view) ? { view: value.view } : {}) });
    openPanels(panel, value);
    if (
      panel.displays.displays.some(
        (display) => display.kind.name === DISPLAY_ROWS.MotionPlanning.name,
      )
    ) {
      panel.choose('Interact');
      // As in RViz below the displays, unless Gazebo's panels leave little room there.
      panel.host.show(
        'motion_planning',
        {},
        scenePanels().some((each) => each.kind === 'gazebo') ? 'rviz' : 'displays',
      );
    }
  } catch (problem) {
    panel.fail(asCallError(problem));
  }
}

const RVIZ_PANELS = /^rviz(_common)?\/|^$/;
const PANELS: Record<string, string> = { 'nav2_rviz_plugins/Navigation 2': 'navigation' };
const TOOLS = [
  'MoveCamera',
  'Interact',
  'Select',
  'FocusCamera',
  'Measure',
  'SetInitialPose',
  'SetGoal',
  'PublishPoint',
  'GoalTool',
];

/** Panels of plug-ins that a `.rviz` file names; those of RViz itself are parts of this page. */
function openPanels(panel: ScenePanel, value: JsonObject): void {
  const names = textsOf(value, 'panels').filter((name) => !RVIZ_PANELS.test(name));
  const tools = panel.displays.tools
    .map((tool) => tool.class)
    .filter((name) => !TOOLS.includes(name));
  for (const name of names) if (PANELS[name]) panel.host.show(PANELS[name], {});
  const unknown = names.filter((name) => !PANELS[name]);
  if (unknown.length) panel.host.tell(`The file's panels ${unknown.join(', ')} do not exist here.`);
  if (tools.length) panel.host.tell(`The file's tools ${tools.join(', ')} do not exist here.`);
}

async function copyPose(panel: ScenePanel, model: string): Promise<void> {
  const pose = panel.assembly.modelPose(model);
  if (!pose) return;
  const [x, y, z, qx, qy, qz, qw] = poseOf(pose);
  const euler = new THREE.Euler().setFromQuaternion(new THREE.Quaternion(qx, qy, qz, qw), 'ZYX');
  await navigator.clipboard.writeText(
    [x, y, z, euler.x, euler.y, euler.z].map((value) => value.toFixed(4)).join(' '),
  );
  panel.say('The pose was copied: x y z roll pitch yaw.');
}

/** The model comes with a scene value, a moment after the answer. */
function selectWhenThere(panel: ScenePanel, model: string): void {
  const stop = panel.world.onScene(() => {
    if (!panel.assembly.model(model)) return;
    queueMicrotask(() => stop());
    panel.world.select({ model });
    panel.choose('Translate');
  });
  setTimeout(() => stop(), 5000);
}

/** A place near what one looks at where nothing stands. */
function freePlace(panel: ScenePanel): [number, number] {
  const [x, y] = panel.view.rig.state.focal;
  const around = (node: { root: THREE.Object3D }): boolean => node.root.visible;
  const boxes = panel.assembly.bodies
    .filter(around)
    .map((node) => panel.assembly.worldBox([node]))
    .filter((box) => box.max.z > 0.05 && box.getSize(new THREE.Vector3()).length() < 20);
  for (let step = 0; step < 60; step++) {
    const angle = step * 2.4;
    const away = 0.45 * Math.sqrt(step);
    const [px, py] = [x + away * Math.cos(angle), y + away * Math.sin(angle)];
    const room = new THREE.Box3(
      new THREE.Vector3(px - 0.55, py - 0.55, 0.02),
      new THREE.Vector3(px + 0.55, py + 0.55, 1),
    );
    if (!boxes.some((box) => box.intersectsBox(room))) return [px, py];
  }
  return [x, y];
}

function freeName(panel: ScenePanel, base: string): string {
  const taken = new Set(panel.world.scene?.models.map((model) => model.name));
  let name = base;
  for (let i = 0; taken.has(name); i++) name = `${base}_${i}`;
  return name;
}

function rounded(value: number): number {
  return Math.round(value * 20) / 20;
}
