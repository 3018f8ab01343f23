/** The rows of `gazelle.studio.displays.registry`. Generated: `python -m gazelle.studio.typescript`. */
import type { DisplayRow } from './messages';

export const DISPLAY_ROWS = {
  Axes: {"name": "Axes", "about": "Axes at a frame.", "types": [], "aliases": [], "streams": false, "drawn_as": "Axes"},
  Camera: {"name": "Camera", "about": "What a camera sees, with the displays laid over it.", "types": ["sensor_msgs/Image", "sensor_msgs/CompressedImage"], "aliases": [], "streams": true, "drawn_as": "Camera"},
  DepthCloud: {"name": "DepthCloud", "about": "Points of a depth image, coloured by a colour image.", "types": ["sensor_msgs/Image"], "aliases": [], "streams": true, "drawn_as": "DepthCloud"},
  Effort: {"name": "Effort", "about": "The efforts of the joints, green to red of their limits.", "types": ["sensor_msgs/JointState"], "aliases": [], "streams": true, "drawn_as": "Effort"},
  FluidPressure: {"name": "FluidPressure", "about": "The pressure of air or water at a sensor.", "types": ["sensor_msgs/FluidPressure"], "aliases": [], "streams": true, "drawn_as": "FluidPressure"},
  Grid: {"name": "Grid", "about": "A grid along the ground or any other plane.", "types": [], "aliases": [], "streams": false, "drawn_as": "Grid"},
  GridCells: {"name": "GridCells", "about": "Cells of a grid: obstacles of a costmap.", "types": ["nav_msgs/GridCells"], "aliases": [], "streams": true, "drawn_as": "GridCells"},
  Illuminance: {"name": "Illuminance", "about": "The light at a sensor.", "types": ["sensor_msgs/Illuminance"], "aliases": [], "streams": true, "drawn_as": "Illuminance"},
  Image: {"name": "Image", "about": "The picture of a camera, in a window of its own.", "types": ["sensor_msgs/Image", "sensor_msgs/CompressedImage"], "aliases": [], "streams": true, "drawn_as": "Image"},
  Imu: {"name": "Imu", "about": "Orientation and acceleration of an IMU.", "types": ["sensor_msgs/Imu"], "aliases": [], "streams": true, "drawn_as": "Imu"},
  InteractiveMarkers: {"name": "InteractiveMarkers", "about": "Markers that can be dragged; the tool Interact moves them.", "types": ["visualization_msgs/InteractiveMarkerUpdate", "visualization_msgs/InteractiveMarkerInit"], "aliases": [], "streams": true, "drawn_as": "InteractiveMarkers"},
  LaserScan: {"name": "LaserScan", "about": "The points of a laser scan.", "types": ["sensor_msgs/LaserScan"], "aliases": [], "streams": true, "drawn_as": "LaserScan"},
  Map: {"name": "Map", "about": "An occupancy grid or a costmap.", "types": ["nav_msgs/OccupancyGrid"], "aliases": [], "streams": true, "drawn_as": "Map"},
  Marker: {"name": "Marker", "about": "Shapes, lines, texts and meshes that programs draw.", "types": ["visualization_msgs/Marker"], "aliases": [], "streams": true, "drawn_as": "Marker"},
  MarkerArray: {"name": "MarkerArray", "about": "Shapes, lines, texts and meshes that programs draw.", "types": ["visualization_msgs/MarkerArray"], "aliases": [], "streams": true, "drawn_as": "MarkerArray"},
  MotionPlanning: {"name": "MotionPlanning", "about": "MoveIt's robot: start, goal, planned path and planning scene.", "types": [], "aliases": [], "streams": false, "drawn_as": "MotionPlanning"},
  Odometry: {"name": "Odometry", "about": "The way of a robot by its odometry.", "types": ["nav_msgs/Odometry"], "aliases": [], "streams": true, "drawn_as": "Odometry"},
  ParticleCloud: {"name": "ParticleCloud", "about": "The particles of a localization with their weights.", "types": ["nav2_msgs/ParticleCloud"], "aliases": [], "streams": true, "drawn_as": "ParticleCloud"},
  Path: {"name": "Path", "about": "A path of a planner or of what was driven.", "types": ["nav_msgs/Path"], "aliases": [], "streams": true, "drawn_as": "Path"},
  PointCloud: {"name": "PointCloud", "about": "A point cloud of the old kind.", "types": ["sensor_msgs/PointCloud"], "aliases": [], "streams": true, "drawn_as": "PointCloud"},
  PointCloud2: {"name": "PointCloud2", "about": "A point cloud with any fields.", "types": ["sensor_msgs/PointCloud2"], "aliases": [], "streams": true, "drawn_as": "PointCloud2"},
  PointStamped: {"name": "PointStamped", "about": "Points, such as those of Publish Point.", "types": ["geometry_msgs/PointStamped"], "aliases": [], "streams": true, "drawn_as": "PointStamped"},
  Polygon: {"name": "Polygon", "about": "A closed line: a footprint.", "types": ["geometry_msgs/PolygonStamped"], "aliases": [], "streams": true, "drawn_as": "Polygon"},
  Pose: {"name": "Pose", "about": "A pose as an arrow or axes: the goal.", "types": ["geometry_msgs/PoseStamped"], "aliases": [], "streams": true, "drawn_as": "Pose"},
  PoseArray: {"name": "PoseArray", "about": "Many poses: the particles of a localization.", "types": ["geometry_msgs/PoseArray"], "aliases": [], "streams": true, "drawn_as": "PoseArray"},
  PoseWithCovariance: {"name": "PoseWithCovariance", "about": "A pose and how sure it is.", "types": ["geometry_msgs/PoseWithCovarianceStamped"], "aliases": [], "streams": true, "drawn_as": "PoseWithCovariance"},
  Range: {"name": "Range", "about": "The cone of a sonar or infrared sensor.", "types": ["sensor_msgs/Range"], "aliases": [], "streams": true, "drawn_as": "Range"},
  RelativeHumidity: {"name": "RelativeHumidity", "about": "The humidity of the air at a sensor.", "types": ["sensor_msgs/RelativeHumidity"], "aliases": [], "streams": true, "drawn_as": "RelativeHumidity"},
  RobotModel: {"name": "RobotModel", "about": "The robot of a description, moved by tf.", "types": [], "aliases": [], "streams": false, "drawn_as": "RobotModel"},
  TF: {"name": "TF", "about": "The tree of coordinate frames.", "types": [], "aliases": [], "streams": false, "drawn_as": "TF"},
  Temperature: {"name": "Temperature", "about": "The temperature at a sensor.", "types": ["sensor_msgs/Temperature"], "aliases": [], "streams": true, "drawn_as": "Temperature"},
  Wrench: {"name": "Wrench", "about": "Force and torque of a sensor.", "types": ["geometry_msgs/WrenchStamped"], "aliases": ["WrenchStamped"], "streams": true, "drawn_as": "Wrench"},
} satisfies Record<string, DisplayRow>;

export type DisplayName = keyof typeof DISPLAY_ROWS;
