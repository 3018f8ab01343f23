/** The box around what is selected. */
import type * as THREE from 'three';
import type { Assembly } from '../model/assembly';
import { boxLines } from '../model/overlays';
import type { WorldStore } from '../world/store';
import type { View } from './view';

const COLOUR = [1, 0.82, 0.25];

/** Keeps boxes in the groups of the selected bodies, so that they move along. */
export class Highlight {
  private boxes: THREE.LineSegments[] = [];
  private readonly stop: () => void;

  constructor(
    private readonly view: View,
    private readonly assembly: Assembly,
    private readonly world: WorldStore,
  ) {
    this.stop = world.onSelection(() => this.draw());
  }

  get count(): number {
    return this.boxes.length;
  }

  /** Draw anew: the selection or the scene changed. */
  draw(): void {
    this.boxes.forEach((box) => box.removeFromParent());
    this.boxes = [];
    const { selection } = this.world;
    for (const node of selection ? this.assembly.nodes(selection.model, selection.link) : []) {
      const box = node.box();
      if (box.isEmpty()) continue;
      const lines = boxLines(box, COLOUR);
      node.root.add(lines);
      this.boxes.push(lines);
    }
    this.view.invalidate(true);
  }

  dispose(): void {
    this.stop();
  }
}
