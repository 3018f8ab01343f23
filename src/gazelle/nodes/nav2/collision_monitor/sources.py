"""What sensors see around the robot, as points in its frame."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gazelle.geometry import Pose
from gazelle.interfaces.stamps import ns_of
from gazelle.nodes.navigation.observations import observation_of
from gazelle.nodes.navigation.robot_pose import Frames

if TYPE_CHECKING:
    from gazelle.graph import Node
    from gazelle.nodes.nav2.collision_monitor.polygons import Points

__all__ = ["SOURCE_TYPES", "Source", "SourceOptions", "WorldFrames"]

SOURCE_TYPES = {
    "scan": "sensor_msgs/msg/LaserScan",
    "pointcloud": "sensor_msgs/msg/PointCloud2",
    "range": "sensor_msgs/msg/Range",
    "polygon": "geometry_msgs/msg/PolygonStamped",
}
"""Types of messages by the parameter ``type``."""


class SourceOptions(NamedTuple):
    """One sensor's parameters.

    Attributes:
        name: of it.
        kind: of `SOURCE_TYPES`.
        topic: its topic.
        timeout_s: older data do not count; 0 for any age.
        enabled: whether it counts.
        heights: least and most z of a cloud's points, m.
        least_m: nearest that a cloud's point may be to the sensor.
        angle_rad: between points of a range's cone.
        sampling_m: between points of a polygon's edges.
    """

    name: str
    kind: str
    topic: str
    timeout_s: float
    enabled: bool
    heights: tuple[float, float]
    least_m: float
    angle_rad: float
    sampling_m: float


class WorldFrames(NamedTuple):
    """The frames that points go through.

    Attributes:
        tree: tf.
        base: of the robot.
        fixed: in which its way since the data is known; empty when that is left out.
        tolerance_s: how much older than a message transforms may be.
    """

    tree: Frames
    base: str
    fixed: str
    tolerance_s: float


class Source:
    """One sensor.

    Attributes:
        options: its parameters.
        enabled: whether it counts.
    """

    def __init__(self, node: Node, options: SourceOptions, frames: WorldFrames) -> None:
        """Start to listen."""
        self.options, self.enabled = options, options.enabled
        self._frames = frames
        self._last: Any = None
        kind = SOURCE_TYPES[options.kind]
        self._heard = node.create_subscription(options.topic, kind, self._hear, queue_size=1)

    def close(self) -> None:
        """Stop listening."""
        self._heard.unregister()

    def points(self, now_ns: int) -> Points | str:
        """Return what it sees in the robot's frame at a time, or why that is not known."""
        message, limit_s = self._last, self.options.timeout_s
        if message is None:
            return f"nothing has come on {self.options.topic} yet"
        stamp_ns = ns_of(message.header.stamp)
        age_s = (now_ns - stamp_ns) / 1e9
        if 0 < limit_s < age_s:
            late = f"is {age_s:.2f} s old, source_timeout is {limit_s:g} s"
            return f"the last of {self.options.topic} {late}"
        T_base_sensor = self._place(str(message.header.frame_id).removeprefix("/"), stamp_ns)
        if isinstance(T_base_sensor, str):
            return T_base_sensor
        try:
            return self._seen(message, T_base_sensor)
        except ValueError as error:
            return f"{self.options.topic}: {error}"

    def _hear(self, message: Any) -> None:
        self._last = message

    def _place(self, frame: str, stamp_ns: int) -> Pose | str:
        """Return the message's frame in the robot's, where the robot is now."""
        tree, base, fixed, tolerance_s = self._frames
        if frame == base:
            return Pose()
        if not fixed:
            return _at(tree, base, frame, stamp_ns, tolerance_s)
        seen = _at(tree, fixed, frame, stamp_ns, tolerance_s)
        now = tree.between(base, fixed)
        if isinstance(seen, str):
            return seen
        return now if isinstance(now, str) else now @ seen

    def _seen(self, message: Any, T_base_sensor: Pose) -> Points:
        options = self.options
        if options.kind == "range":
            corners = _cone(message, options.angle_rad)
            return np.asarray(T_base_sensor.transform(corners)[:, :2])
        if options.kind == "polygon":
            outline = [(p.x, p.y, p.z) for p in message.polygon.points]
            corners = _edges(np.array(outline, float).reshape(-1, 3), options.sampling_m)
            return np.asarray(T_base_sensor.transform(corners)[:, :2])
        points = observation_of(message, T_base_sensor).points
        if options.kind == "scan":
            return np.asarray(points[:, :2])
        low, high = options.heights
        away = np.linalg.norm(points - np.asarray(T_base_sensor.position_m), axis=1)
        kept = (points[:, 2] >= low) & (points[:, 2] <= high) & (away >= options.least_m)
        return np.asarray(points[kept, :2])


def _at(tree: Frames, target: str, source: str, stamp_ns: int, tolerance_s: float) -> Pose | str:
    """Return a transform at a time, or the newest where that is not much older."""
    found = tree.between(target, source, stamp_ns)
    if not isinstance(found, str):
        return found
    newest = tree.robot(target, source, 0.0)
    if isinstance(newest, str):
        return newest
    if newest.stamp_ns and abs(newest.stamp_ns - stamp_ns) > tolerance_s * 1e9:
        return found
    return tree.between(target, source)


def _cone(message: Any, angle_rad: float) -> Any:
    """Return an arc of points at a range; none beyond the sensor's limits."""
    distance_m = float(message.range)
    if not message.min_range <= distance_m <= message.max_range:
        return np.empty((0, 3))
    half = float(message.field_of_view) / 2
    angles = np.append(np.arange(-half, half, angle_rad), half)
    return np.column_stack([distance_m * np.cos(angles), distance_m * np.sin(angles), 0 * angles])


def _edges(corners: Any, step_m: float) -> Any:
    """Return points along the edges of a polygon."""
    rows = [np.empty((0, 3))]
    for begin, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        count = max(math.ceil(float(np.linalg.norm(end - begin)) / step_m), 1)
        rows.append(begin + np.arange(count)[:, None] / count * (end - begin))
    return np.vstack(rows)
