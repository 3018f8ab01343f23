/** What draws the displays of `gazelle.studio.displays.registry`. Generated: `python -m gazelle.studio.typescript`. */
import type { Drawing } from '../displays/display';
import { EFFORT } from '../displays/effort';
import { AXES, GRID } from '../displays/grid';
import { CAMERA, IMAGE } from '../displays/image';
import { GRID_CELLS, IMU, RANGE, WRENCH } from '../displays/imu_range_wrench';
import { INTERACTIVE_MARKERS } from '../displays/interactive_markers';
import { MAP } from '../displays/map';
import { MARKERS } from '../displays/markers';
import { ODOMETRY } from '../displays/odometry';
import { PATH, POLYGON } from '../displays/path';
import { DEPTH_CLOUD, FLUID_PRESSURE, ILLUMINANCE, LASER_SCAN, POINT_CLOUD, RELATIVE_HUMIDITY, TEMPERATURE } from '../displays/points';
import { PARTICLE_CLOUD, POINT_STAMPED, POSE, POSE_ARRAY, POSE_WITH_COVARIANCE } from '../displays/poses';
import { ROBOT_MODEL } from '../displays/robot_model';
import { TF } from '../displays/tf';
import { MOTION_PLANNING } from '../motion/display';
import type { DisplayName } from './displays';

export const DRAWINGS: Record<DisplayName, Drawing> = {
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
