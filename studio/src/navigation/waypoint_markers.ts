/** The waypoints in RViz's views: arrows with their numbers. */
import * as THREE from 'three';
import { flatArrowGeometry } from '../model/geometry';
import { onActiveScene, scenePanels } from '../scene/active_scene';
import { freeLabel, label } from '../scene/labels';
import type { ScenePanel } from '../scene/scene_panel';
import type { Waypoint } from './waypoints';

const ABOVE_M = 0.03;
const ARROW = flatArrowGeometry(0.4);
const PAINT = new THREE.MeshBasicMaterial({ color: 0xff2fd0, side: THREE.DoubleSide });

/** Draws them in every view of RViz whose fixed frame is theirs. */
export class Marks {
  private readonly groups = new Map<ScenePanel, THREE.Group>();
  private readonly stop: () => void;
  private waypoints: readonly Waypoint[] = [];

  constructor() {
    this.stop = onActiveScene(() => this.show(this.waypoints));
  }

  show(waypoints: readonly Waypoint[]): void {
    this.waypoints = waypoints;
    for (const panel of scenePanels()) if (panel.kind === 'rviz') this.draw(panel);
  }

  dispose(): void {
    this.stop();
    for (const [panel, group] of this.groups) {
      clear(group);
      group.removeFromParent();
      panel.view.invalidate();
    }
  }

  private draw(panel: ScenePanel): void {
    const group = this.groups.get(panel) ?? new THREE.Group();
    this.groups.set(panel, group);
    panel.view.scene.add(group);
    clear(group);
    this.waypoints.forEach((each, index) => {
      if (each.frame === panel.displays.fixedFrame) group.add(...mark(each, index));
    });
    panel.view.invalidate();
  }
}

function mark({ x, y, yaw }: Waypoint, index: number): THREE.Object3D[] {
  const arrow = new THREE.Mesh(ARROW, PAINT);
  arrow.position.set(x, y, ABOVE_M);
  arrow.rotation.z = yaw;
  const text = label(String(index + 1), {
    height: 20,
    pixels: true,
    onTop: true,
    colour: [1, 0.75, 0.95],
  });
  text.position.set(x, y, ABOVE_M);
  return [arrow, text];
}

function clear(group: THREE.Group): void {
  for (const child of group.children) if (child instanceof THREE.Sprite) freeLabel(child);
  group.clear();
}
