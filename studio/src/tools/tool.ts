/** Tools of the toolbar: what the pointer does in a view. */
import type * as THREE from 'three';
import type { Connection } from '../connection';
import type { DisplayList } from '../displays/display_list';
import type { GraphStore } from '../graph_store';
import type { Assembly } from '../model/assembly';
import type { View } from '../scene/view';
import type { WorldStore } from '../world/store';

/** What tools work on. */
export interface Bench {
  view: View;
  assembly: Assembly;
  displays: DisplayList;
  world: WorldStore;
  connection: Connection;
  graph: GraphStore;
  /** The bottom line: what the tool waits for or has found. */
  say(text: string): void;
  fail(problem: unknown): void;
  /** Back to the tool that was chosen before (goals are set once). */
  done(): void;
}

/** One tool. Handlers return true when they took the event: the camera does not move then. */
export interface Tool {
  readonly name: string;
  /** RViz's or Gazebo's key. */
  readonly key: string;
  readonly about: string;
  readonly cursor?: string;
  begin?(): void;
  end?(): void;
  down?(event: PointerEvent): boolean;
  move?(event: PointerEvent): boolean;
  up?(event: PointerEvent): boolean;
  /** A press and release at one place. */
  click?(event: PointerEvent): void;
  keyDown?(event: KeyboardEvent): boolean;
}

/** Where a click went. */
export interface Spot {
  point: THREE.Vector3;
}
