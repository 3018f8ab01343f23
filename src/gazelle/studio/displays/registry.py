"""Gazelle's own displays, one row each; `DRAWINGS` in ``studio/src/displays`` draws them.

The page's copy of the rows is generated: ``python -m gazelle.studio.typescript``.
"""

from __future__ import annotations

from gazelle.studio.displays.cameras import open_camera, open_picture
from gazelle.studio.displays.depth_cloud import open_depth_cloud
from gazelle.studio.displays.display import Display
from gazelle.studio.displays.maps import open_map
from gazelle.studio.displays.markers import open_interactive, open_markers
from gazelle.studio.displays.plain import open_plain
from gazelle.studio.displays.points import open_points

__all__ = ["DISPLAYS", "own_display"]

_PICTURES = ("sensor_msgs/Image", "sensor_msgs/CompressedImage")
_MARKERS = "Shapes, lines, texts and meshes that programs draw."

_ROWS = (
    Display("Axes", "Axes at a frame."),
    Display(
        "Camera",
        "What a camera sees, with the displays laid over it.",
        _PICTURES,
        open_camera,
        topic_names=("Image Topic",),
    ),
    Display(
        "DepthCloud",
        "Points of a depth image, coloured by a colour image.",
        ("sensor_msgs/Image",),
        open_depth_cloud,
        topic_names=("Depth Map Topic",),
    ),
    Display(
        "Effort",
        "The efforts of the joints, green to red of their limits.",
        ("sensor_msgs/JointState",),
        open_plain,
    ),
    Display(
        "FluidPressure",
        "The pressure of air or water at a sensor.",
        ("sensor_msgs/FluidPressure",),
        open_points,
    ),
    Display("Grid", "A grid along the ground or any other plane."),
    Display(
        "GridCells",
        "Cells of a grid: obstacles of a costmap.",
        ("nav_msgs/GridCells",),
        open_plain,
    ),
    Display(
        "Illuminance",
        "The light at a sensor.",
        ("sensor_msgs/Illuminance",),
        open_points,
    ),
    Display(
        "Image",
        "The picture of a camera, in a window of its own.",
        _PICTURES,
        open_picture,
        topic_names=("Image Topic",),
    ),
    Display("Imu", "Orientation and acceleration of an IMU.", ("sensor_msgs/Imu",), open_plain),
    Display(
        "InteractiveMarkers",
        "Markers that can be dragged; the tool Interact moves them.",
        (
            "visualization_msgs/InteractiveMarkerUpdate",
            "visualization_msgs/InteractiveMarkerInit",
        ),
        open_interactive,
        topic_names=("Update Topic", "Interactive Markers Namespace"),
    ),
    Display("LaserScan", "The points of a laser scan.", ("sensor_msgs/LaserScan",), open_points),
    Display("Map", "An occupancy grid or a costmap.", ("nav_msgs/OccupancyGrid",), open_map),
    Display(
        "Marker",
        _MARKERS,
        ("visualization_msgs/Marker",),
        open_markers,
        topic_names=("Marker Topic",),
    ),
    Display(
        "MarkerArray",
        _MARKERS,
        ("visualization_msgs/MarkerArray",),
        open_markers,
        topic_names=("Marker Topic",),
    ),
    Display("MotionPlanning", "MoveIt's robot: start, goal, planned path and planning scene."),
    Display("Odometry", "The way of a robot by its odometry.", ("nav_msgs/Odometry",), open_plain),
    Display(
        "ParticleCloud",
        "The particles of a localization with their weights.",
        ("nav2_msgs/ParticleCloud",),
        open_plain,
    ),
    Display("Path", "A path of a planner or of what was driven.", ("nav_msgs/Path",), open_plain),
    Display(
        "PointCloud",
        "A point cloud of the old kind.",
        ("sensor_msgs/PointCloud",),
        open_points,
    ),
    Display(
        "PointCloud2",
        "A point cloud with any fields.",
        ("sensor_msgs/PointCloud2",),
        open_points,
    ),
    Display(
        "PointStamped",
        "Points, such as those of Publish Point.",
        ("geometry_msgs/PointStamped",),
        open_plain,
    ),
    Display(
        "Polygon",
        "A closed line: a footprint.",
        ("geometry_msgs/PolygonStamped",),
        open_plain,
    ),
    Display(
        "Pose",
        "A pose as an arrow or axes: the goal.",
        ("geometry_msgs/PoseStamped",),
        open_plain,
    ),
    Display(
        "PoseArray",
        "Many poses: the particles of a localization.",
        ("geometry_msgs/PoseArray",),
        open_plain,
    ),
    Display(
        "PoseWithCovariance",
        "A pose and how sure it is.",
        ("geometry_msgs/PoseWithCovarianceStamped",),
        open_plain,
    ),
    Display("Range", "The cone of a sonar or infrared sensor.", ("sensor_msgs/Range",), open_plain),
    Display(
        "RelativeHumidity",
        "The humidity of the air at a sensor.",
        ("sensor_msgs/RelativeHumidity",),
        open_points,
    ),
    Display(
        "RobotModel",
        "The robot of a description, moved by tf.",
        topic_names=("Description Topic",),
    ),
    Display("TF", "The tree of coordinate frames."),
    Display(
        "Temperature", "The temperature at a sensor.", ("sensor_msgs/Temperature",), open_points
    ),
    Display(
        "Wrench",
        "Force and torque of a sensor.",
        ("geometry_msgs/WrenchStamped",),
        open_plain,
        aliases=("WrenchStamped",),
    ),
)

DISPLAYS: dict[str, Display] = {row.name: row for row in _ROWS}
"""By name."""

_BY_ANY_NAME = {name: row for row in _ROWS for name in (row.name, *row.aliases)}


def own_display(name: str) -> Display | None:
    """Return the display of a class without its package, by any of its names."""
    return _BY_ANY_NAME.get(name)
