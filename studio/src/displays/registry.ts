/** All kinds of displays, in RViz's order. */
import { shortType } from '../graph_store';
import { MOTION_PLANNING } from '../motion/display';
import type { DisplayKind } from './display';
import { EFFORT } from './effort';
import { AXES, GRID } from './grid';
import { CAMERA, IMAGE } from './image';
import { INTERACTIVE_MARKERS } from './interactive';
import { MAP } from './map';
import { MARKER, MARKER_ARRAY } from './markers';
import { ODOMETRY } from './odometry';
import { PATH, POLYGON } from './path';
import { POINT_KINDS } from './points';
import { PARTICLE_CLOUD, POINT_STAMPED, POSE, POSE_ARRAY, POSE_WITH_COVARIANCE } from './poses';
import { ROBOT_MODEL } from './robot_model';
import { GRID_CELLS, IMU, RANGE, WRENCH } from './sensors';
import { TF } from './tf';

const KINDS: readonly DisplayKind[] = [
  AXES, CAMERA, EFFORT, GRID, GRID_CELLS, IMAGE, IMU, INTERACTIVE_MARKERS, MAP, MARKER, MARKER_ARRAY,
  MOTION_PLANNING, ODOMETRY, PARTICLE_CLOUD, PATH, POINT_STAMPED, ...POINT_KINDS, POLYGON, POSE, POSE_ARRAY, POSE_WITH_COVARIANCE,
  RANGE, ROBOT_MODEL, TF, WRENCH,
].sort((a, b) => a.name.localeCompare(b.name));

/** Names that differ between RViz's versions. */
const OTHER_NAMES: Record<string, string> = { WrenchStamped: 'Wrench' };

/** All kinds. */
export function displayKinds(): readonly DisplayKind[] {
  return KINDS;
}

/** The kind of a class as `.rviz` files write it: `rviz/LaserScan`, `rviz_default_plugins/LaserScan`. */
export function displayKind(name: string): DisplayKind | undefined {
  const own = name.split('/').pop() ?? name;
  const clean = OTHER_NAMES[own] ?? own;
  return KINDS.find((kind) => kind.name === clean);
}

/** The kinds that show a type of message. */
export function kindsFor(type: string): readonly DisplayKind[] {
  const short = shortType(type);
  return KINDS.filter((kind) => kind.types.includes(short));
}
