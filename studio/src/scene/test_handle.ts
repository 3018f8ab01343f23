/** `window.gazelle`: what is drawn, in numbers, so that tests can act as a person and look at the structure. */
import * as THREE from 'three';
import type { JsonObject } from '../json';
import type { Mode } from '../model/view_modes';
import { scenePanels, activeScene } from './active_scene';
import type { ScenePanel } from './scene_panel';

/** What tests see of a scene panel. */
interface SceneReport {
  kind: string;
  bodies: number;
  models: string[];
  selected: unknown;
  tool: string;
  fixedFrame: string;
  displays: Record<string, unknown>;
  camera: unknown;
  following: boolean;
  drawn: number;
  scriptMs: number;
  calls: number;
  triangles: number;
  geometries: number;
  highlighted: number;
  contacts: number;
  shadows: boolean;
}

/** Put the handle on the window, once. */
export function publishHandle(): void {
  const owner = window as unknown as { gazelle?: Record<string, unknown> };
  if (owner.gazelle?.scene) return;
  owner.gazelle = {
    ...owner.gazelle,
    scenes: () => scenePanels().map(report),
    scene: (kind?: 'gazebo' | 'rviz') => report(panelOf(kind)),
    pose: (body: string, kind?: 'gazebo' | 'rviz') => pose(panelOf(kind), body),
    frame: (name: string, kind?: 'gazebo' | 'rviz') => frame(panelOf(kind), name),
    points: (display: string, every: number, kind?: 'gazebo' | 'rviz') =>
      points(panelOf(kind), display, every),
    screen: (body: string, kind?: 'gazebo' | 'rviz') => screen(panelOf(kind), body),
    project: (point: [number, number, number], kind?: 'gazebo' | 'rviz') =>
      panelOf(kind).view.toPage(new THREE.Vector3(...point)),
    handle: (marker: string, control: string, end = 1) =>
      handle(panelOf('rviz'), marker, control, end),
    overlays: (mode: Mode) => panelOf('gazebo').assembly.count(mode),
    look: (state: object, kind?: 'gazebo' | 'rviz') => panelOf(kind).view.rig.set(state),
    addDisplay: (name: string, properties: JsonObject, kind?: 'gazebo' | 'rviz') =>
      Boolean(panelOf(kind).displays.add(name, properties)),
    drawNow: (kind?: 'gazebo' | 'rviz') => panelOf(kind).view.drawNow(),
    objects: (kind?: 'gazebo' | 'rviz') => count(panelOf(kind).view.scene),
  };
}

function panelOf(kind?: 'gazebo' | 'rviz'): ScenePanel {
  const found = activeScene(kind);
  if (!found) throw new Error('no scene panel is open');
  return found;
}

function report(panel: ScenePanel): SceneReport {
  const { view, assembly, displays, world } = panel;
  const { render, memory } = view.renderer.info;
  const shown = displays.displays.map((each) => [
    each.name,
    {
      class: each.kind.name,
      enabled: each.enabled,
      level: each.level,
      counts: each.counts(),
      topic: each.topic,
      status: Object.fromEntries([...each.status].map(([what, line]) => [what, line.text])),
    },
  ]);
  return {
    kind: panel.kind,
    bodies: assembly.bodies.length,
    models: assembly.value?.models.map((model) => model.name) ?? [],
    selected: world.selection,
    tool: panel.tool.name,
    fixedFrame: displays.fixedFrame,
    displays: Object.fromEntries(shown),
    camera: view.rig.state,
    following: view.rig.following,
    drawn: view.drawn,
    scriptMs: view.scriptMs,
    calls: render.calls,
    triangles: render.triangles,
    geometries: memory.geometries,
    highlighted: panel.highlight.count,
    contacts: panel.contacts.count,
    shadows: view.renderer.shadowMap.enabled,
  };
}

function pose(panel: ScenePanel, body: string): number[] | null {
  const node = panel.assembly.bodies.find((each) => each.value.name === body);
  return node ? [...node.root.position.toArray(), ...node.root.quaternion.toArray()] : null;
}

/** Where a frame of tf is in the fixed frame. */
function frame(panel: ScenePanel, name: string): number[] | null {
  const { frames } = panel.displays.stage;
  const at = frames.at(name);
  return at < 0 ? null : [...frames.poses.slice(at, at + 7)];
}

/** Every n-th point of a display in the fixed frame: x, y, z, x, … */
function points(panel: ScenePanel, name: string, every: number): number[] {
  const found: number[] = [];
  panel.displays.displays
    .find((each) => each.name === name)
    ?.root.traverse((object) => {
      if (!(object instanceof THREE.Points)) return;
      const position = object.geometry.getAttribute('position');
      object.updateWorldMatrix(true, false);
      for (let index = 0; index < object.geometry.drawRange.count; index += every) {
        found.push(
          ...new THREE.Vector3()
            .fromBufferAttribute(position, index)
            .applyMatrix4(object.matrixWorld)
            .toArray(),
        );
      }
    });
  return found;
}

interface PagePoint {
  x: number;
  y: number;
}

/**
 * Where on the page a control of a marker can be grasped, and where its middle is: an arrow or a ring
 * at an end (1 or -1) of its longest side.
 */
function handle(
  panel: ScenePanel,
  marker: string,
  name: string,
  end: number,
): (PagePoint & { middle: PagePoint }) | null {
  const control = panel.view.scene.getObjectByName(marker)?.getObjectByName(name);
  if (!control) return null;
  control.updateWorldMatrix(true, true);
  const [only, ...others] = control.children;
  const alone = only instanceof THREE.Mesh && !others.length ? only : null;
  const geometry = alone?.geometry as THREE.BufferGeometry | undefined;
  geometry?.computeBoundingBox();
  const box = geometry?.boundingBox ?? new THREE.Box3().setFromObject(control);
  const toPage = (point: THREE.Vector3): PagePoint =>
    panel.view.toPage(alone ? alone.localToWorld(point) : point);
  const middle = box.getCenter(new THREE.Vector3());
  const half = box.max.clone().sub(middle);
  const longest = half.x > half.y && half.x > half.z ? 'x' : half.y > half.z ? 'y' : 'z';
  const point = middle.clone();
  point[longest] += half[longest] * 0.8 * end;
  return { ...toPage(point), middle: toPage(middle) };
}

/** The middle of a body's box on the page. */
function screen(panel: ScenePanel, body: string): { x: number; y: number } | null {
  const node = panel.assembly.bodies.find((each) => each.value.name === body);
  if (!node) return null;
  return panel.view.toPage(panel.assembly.worldBox([node]).getCenter(new THREE.Vector3()));
}

function count(scene: THREE.Object3D): Record<string, number> {
  const found: Record<string, number> = {};
  scene.traverseVisible((object) => (found[object.type] = (found[object.type] ?? 0) + 1));
  return found;
}
