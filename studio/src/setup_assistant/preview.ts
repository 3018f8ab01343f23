/** The robot in 3D beside the steps: where its joints are, and which links a step is about. */
import * as THREE from 'three';
import type { MotionRobot } from '../generated/messages';
import { Ghost, paint } from '../motion/ghost';
import { Kinematics, type Positions } from '../motion/robot';
import { gridLines } from '../scene/grid';
import { Pointer } from '../scene/pointer';
import { View } from '../scene/view';
import type { Tool } from '../tools/tool';
import { h } from '../widgets/dom';

const MARKED: [number, number, number] = [0.98, 0.5, 0.1];
const OTHER: [number, number, number] = [0.62, 0.65, 0.7];
const NO_TOOL = {} as Tool;

/** A view with one robot. */
export class Preview {
  readonly element = h('div', { class: 'assistant-preview' });
  private view: View | null = null;
  private ghost: Ghost | null = null;
  private kinematics: Kinematics | null = null;
  private shown = '';
  private marked: ReadonlySet<string> | null = null;
  private visible = false;
  positions: Positions = {};

  /** Show a robot; one that is shown already stays as it is. */
  setRobot(robot: MotionRobot): void {
    this.kinematics = new Kinematics(robot);
    const key = JSON.stringify(robot.scene.bodies.map((body) => [body.link, body.name]));
    if (key === this.shown && this.ghost) {
      this.draw();
      return;
    }
    this.shown = key;
    const view = this.view ?? this.makeView();
    if (this.ghost) view.scene.remove(this.ghost.root);
    this.ghost = new Ghost(robot.scene, 'robot', () => this.meshCame());
    view.scene.add(this.ghost.root);
    this.positions = { ...robot.defaults };
    this.draw();
    this.look();
  }

  /** Put joints elsewhere. */
  setPositions(positions: Positions): void {
    this.positions = { ...this.positions, ...positions };
    this.draw();
  }

  /** Paint some links; null shows all in their own colours. */
  mark(links: Iterable<string> | null): void {
    this.marked = links === null ? null : new Set(links);
    this.draw();
  }

  /** Hidden views draw nothing. */
  show(visible: boolean): void {
    this.visible = visible;
    this.view?.show(visible);
  }

  dispose(): void {
    this.view?.dispose();
  }

  private makeView(): View {
    const view = new View(this.element);
    view.canvas.setAttribute(
      'aria-label',
      'The robot in 3D. Arrow keys turn, plus and minus zoom.',
    );
    const grid = gridLines({
      cells: 10,
      size_m: 0.5,
      colour: [0.45, 0.46, 0.48],
      alpha: 0.55,
      plane: 'XY',
      axes: true,
    });
    view.scene.add(grid);
    new Pointer(view, 'rviz', { tool: () => NO_TOOL, menu: () => undefined, key: () => false });
    view.show(this.visible);
    this.view = view;
    return view;
  }

  private draw(): void {
    if (!this.ghost || !this.kinematics) return;
    this.ghost.place(this.kinematics.poses(this.positions));
    const { marked } = this;
    this.ghost.look(null, (link) =>
      marked === null ? null : marked.has(link) ? paint(MARKED, 1) : paint(OTHER, 0.45),
    );
    this.view?.moved();
  }

  /** The whole robot comes into view, again when its meshes have come. */
  private look(): void {
    if (!this.view || !this.ghost) return;
    const box = new THREE.Box3();
    for (const body of this.ghost.bodies) {
      const own = body.box();
      body.root.updateWorldMatrix(true, false);
      if (!own.isEmpty()) box.union(own.applyMatrix4(body.root.matrixWorld));
    }
    if (!box.isEmpty()) this.view.rig.moveTo(box);
    this.view.invalidate(true);
  }

  private meshCame(): void {
    this.draw();
    this.look();
  }
}
