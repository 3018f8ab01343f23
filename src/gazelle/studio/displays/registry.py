"""Gazelle's own displays, one row each, with the name of what draws it in ``studio/src``.

The page's copy of the rows is generated: ``python -m gazelle.studio.typescript``.
"""

from __future__ import annotations

from gazelle.studio.displays.cameras import open_camera, open_picture
from gazelle.studio.displays.depth_cloud import open_depth_cloud
from gazelle.studio.displays.display import Display
from gazelle.studio.displays.maps import open_map
from gazelle.studio.displays.markers import open_interactive, open_markers
from gazelle.studio.displays.points import open_points
from gazelle.studio.displays.topic_display import open_plain

__all__ = ["DISPLAYS", "own_display"]

_PICTURES = ("sensor_msgs/Image", "sensor_msgs/CompressedImage")
_MARKERS = "Shapes, lines, texts and meshes that programs draw."

_ROWS = (
    Display("Axes", "Axes at a frame.", drawing="displays/grid:AXES"),
    Display(
        "Camera",
        "What a camera sees, with the displays laid over it.",
        _PICTURES,
        open_camera,
        topic_names=("Image Topic",),
        drawing="displays/image:CAMERA",
    ),
    Display(
        "DepthCloud",
        "Points of a depth image, coloured by a colour image.",
        ("sensor_msgs/Image",),
        open_depth_cloud,
        topic_names=("Depth Map Topic",),
        drawing="displays/points:DEPTH_CLOUD",
    ),
    Display(
        "Effort",
        "The efforts of the joints, green to red of their limits.",
        ("sensor_msgs/JointState",),
        open_plain,
        drawing="displays/effort:EFFORT",
    ),
    Display(
        "FluidPressure",
        "The pressure of air or water at a sensor.",
        ("sensor_msgs/FluidPressure",),
        open_points,
        drawing="displays/points:FLUID_PRESSURE",
    ),
    Display("Grid", "A grid along the ground or any other plane.", drawing="displays/grid:GRID"),
    Display(
        "GridCells",
        "Cells of a grid: obstacles of a costmap.",
        ("nav_msgs/GridCells",),
        open_plain,
        drawing="displays/imu_range_wrench:GRID_CELLS",
    ),
    Display(
        "Illuminance",
        "The light at a sensor.",
        ("sensor_msgs/Illuminance",),
        open_points,
        drawing="displays/points:ILLUMINANCE",
    ),
    Display(
        "Image",
        "The picture of a camera, in a window of its own.",
        _PICTURES,
        open_picture,
        topic_names=("Image Topic",),
        drawing="displays/image:IMAGE",
    ),
    Display(
        "Imu",
        "Orientation and acceleration of an IMU.",
        ("sensor_msgs/Imu",),
        open_plain,
        drawing="displays/imu_range_wrench:IMU",
    ),
    Display(
        "InteractiveMarkers",
        "Markers that can be dragged; the tool Interact moves them.",
        (
            "visualization_msgs/InteractiveMarkerUpdate",
            "visualization_msgs/InteractiveMarkerInit",
        ),
        open_interactive,
        topic_names=("Update Topic", "Interactive Markers Namespace"),
        drawing="displays/interactive_markers:INTERACTIVE_MARKERS",
    ),
    Display(
        "LaserScan",
        "The points of a laser scan.",
        ("sensor_msgs/LaserScan",),
        open_points,
        drawing="displays/points:LASER_SCAN",
    ),
    Display(
        "Map",
        "An occupancy grid or a costmap.",
        ("nav_msgs/OccupancyGrid",),
        open_map,
        drawing="displays/map:MAP",
    ),
    Display(
        "Marker",
        _MARKERS,
        ("visualization_msgs/Marker",),
        open_markers,
        topic_names=("Marker Topic",),
        drawing="displays/markers:MARKERS",
    ),
    Display(
        "MarkerArray",
        _MARKERS,
        ("visualization_msgs/MarkerArray",),
        open_markers,
        topic_names=("Marker Topic",),
        drawing="displays/markers:MARKERS",
    ),
    Display(
        "MotionPlanning",
        "MoveIt's robot: start, goal, planned path and planning scene.",
        drawing="motion/display:MOTION_PLANNING",
    ),
    Display(
        "Odometry",
        "The way of a robot by its odometry.",
        ("nav_msgs/Odometry",),
        open_plain,
        drawing="displays/odometry:ODOMETRY",
    ),
    Display(
        "ParticleCloud",
        "The particles of a localization with their weights.",
        ("nav2_msgs/ParticleCloud",),
        open_plain,
        drawing="displays/poses:PARTICLE_CLOUD",
    ),
    Display(
        "Path",
        "A path of a planner or of what was driven.",
        ("nav_msgs/Path",),
        open_plain,
        drawing="displays/path:PATH",
    ),
    Display(
        "PointCloud",
        "A point cloud of the old kind.",
        ("sensor_msgs/PointCloud",),
        open_points,
        drawing="displays/points:POINT_CLOUD",
    ),
    Display(
        "PointCloud2",
        "A point cloud with any fields.",
        ("sensor_msgs/PointCloud2",),
        open_points,
        drawing="displays/points:POINT_CLOUD",
    ),
    Display(
        "PointStamped",
        "Points, such as those of Publish Point.",
        ("geometry_msgs/PointStamped",),
        open_plain,
        drawing="displays/poses:POINT_STAMPED",
    ),
    Display(
        "Polygon",
        "A closed line: a footprint.",
        ("geometry_msgs/PolygonStamped",),
        open_plain,
        drawing="displays/path:POLYGON",
    ),
    Display(
        "Pose",
        "A pose as an arrow or axes: the goal.",
        ("geometry_msgs/PoseStamped",),
        open_plain,
        drawing="displays/poses:POSE",
    ),
    Display(
        "PoseArray",
        "Many poses: the particles of a localization.",
        ("geometry_msgs/PoseArray",),
        open_plain,
        drawing="displays/poses:POSE_ARRAY",
    ),
    Display(
        "PoseWithCovariance",
        "A pose and how sure it is.",
        ("geometry_msgs/PoseWithCovarianceStamped",),
        open_plain,
        drawing="displays/poses:POSE_WITH_COVARIANCE",
    ),
    Display(
        "Range",
        "The cone of a sonar or infrared sensor.",
        ("sensor_msgs/Range",),
        open_plain,
        drawing="displays/imu_range_wrench:RANGE",
    ),
    Display(
        "RelativeHumidity",
        "The humidity of the air at a sensor.",
        ("sensor_msgs/RelativeHumidity",),
        open_points,
        drawing="displays/points:RELATIVE_HUMIDITY",
    ),
    Display(
        "RobotModel",
        "The robot of a description, moved by tf.",
        topic_names=("Description Topic",),
        drawing="displays/robot_model:ROBOT_MODEL",
    ),
    Display("TF", "The tree of coordinate frames.", drawing="displays/tf:TF"),
    Display(
        "Temperature",
        "The temperature at a sensor.",
        ("sensor_msgs/Temperature",),
        open_points,
        drawing="displays/points:TEMPERATURE",
    ),
    Display(
        "Wrench",
        "Force and torque of a sensor.",
        ("geometry_msgs/WrenchStamped",),
        open_plain,
        aliases=("WrenchStamped",),
        drawing="displays/imu_range_wrench:WRENCH",
    ),
)

DISPLAYS: dict[str, Display] = {row.name: row for row in _ROWS}
"""By name."""

_BY_ANY_NAME = {name: row for row in _ROWS for name in (row.name, *row.aliases)}


def own_display(name: str) -> Display | None:
    """Return the display of a class without its package, by any of its names."""
    return _BY_ANY_NAME.get(name)
