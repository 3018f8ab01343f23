/** All kinds of displays: rows of the server's table, each with its drawing. */
import type { Connection } from '../connection';
import { DISPLAY_ROWS, type DisplayName } from '../generated/displays';
import type { AddedDisplays, DisplayRow } from '../generated/messages';
import { shortType } from '../graph_store';
import { MOTION_PLANNING } from '../motion/display';
import type { DisplayKind, Drawing } from './display';
import { EFFORT } from './effort';
import { AXES, GRID } from './grid';
import { CAMERA, IMAGE } from './image';
import { INTERACTIVE_MARKERS } from './interactive';
import { MAP } from './map';
import { MARKERS } from './markers';
import { ODOMETRY } from './odometry';
import { PATH, POLYGON } from './path';
import { DEPTH_CLOUD, FLUID_PRESSURE, ILLUMINANCE, LASER_SCAN, POINT_CLOUD, RELATIVE_HUMIDITY, TEMPERATURE } from './points';
import { PARTICLE_CLOUD, POINT_STAMPED, POSE, POSE_ARRAY, POSE_WITH_COVARIANCE } from './poses';
import { ROBOT_MODEL } from './robot_model';
import { GRID_CELLS, IMU, RANGE, WRENCH } from './sensors';
import { TF } from './tf';

const DRAWINGS: Record<DisplayName, Drawing> = {
  Axes: AXES,
  Camera: CAMERA,
  DepthCloud: DEPTH_CLOUD,
  Effort: EFFORT,
  FluidPressure: FLUID_PRESSURE,
  Grid: GRID,
  GridCells: GRID_CELLS,
  Illuminance: ILLUMINANCE,
  Image: IMAGE,
  Imu: IMU,
  InteractiveMarkers: INTERACTIVE_MARKERS,
  LaserScan: LASER_SCAN,
  Map: MAP,
  Marker: MARKERS,
  MarkerArray: MARKERS,
  MotionPlanning: MOTION_PLANNING,
  Odometry: ODOMETRY,
  ParticleCloud: PARTICLE_CLOUD,
  Path: PATH,
  PointCloud: POINT_CLOUD,
  PointCloud2: POINT_CLOUD,
  PointStamped: POINT_STAMPED,
  Polygon: POLYGON,
  Pose: POSE,
  PoseArray: POSE_ARRAY,
  PoseWithCovariance: POSE_WITH_COVARIANCE,
  Range: RANGE,
  RelativeHumidity: RELATIVE_HUMIDITY,
  RobotModel: ROBOT_MODEL,
  TF: TF,
  Temperature: TEMPERATURE,
  Wrench: WRENCH,
};

let kinds: readonly DisplayKind[] = kindsOf(Object.values(DISPLAY_ROWS));
let asked: Promise<readonly string[]> | null = null;

function kindsOf(rows: readonly DisplayRow[]): DisplayKind[] {
  return rows.map((row) => ({ ...row, ...DRAWINGS[row.drawn_as as DisplayName] })).sort((a, b) => a.name.localeCompare(b.name));
}

/** All kinds that are known. */
export function displayKinds(): readonly DisplayKind[] {
  return kinds;
}

/** Ask once for what pip packages add; gives a sentence for each display that cannot be shown. */
export function learnAdded(connection: Connection): Promise<readonly string[]> {
  asked ??= connection.call('display.list').then((value) => {
    const added = value as unknown as AddedDisplays;
    kinds = kindsOf([...kinds, ...added.displays]);
    return added.problems;
  });
  asked.catch(() => void (asked = null));
  return asked;
}

/** The kind of a class as `.rviz` files write it: `rviz/LaserScan`, `rviz_default_plugins/LaserScan`. */
export function displayKind(name: string): DisplayKind | undefined {
  const own = name.split('/').pop() ?? name;
  return kinds.find((kind) => kind.name === own || kind.aliases.includes(own));
}

/** The kinds that show a type of message. */
export function kindsFor(type: string): readonly DisplayKind[] {
  const short = shortType(type);
  return kinds.filter((kind) => kind.types.includes(short));
}
