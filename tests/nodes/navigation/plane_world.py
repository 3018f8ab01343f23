"""A robot without physics in a plane of walls: a map, tf, odometry, a lidar and a clock.

Time is the test's own: it runs so many times faster than real time, and stands still in between.
"""

from __future__ import annotations

import math
import threading
import time
from collections import deque
from typing import Any

import numpy as np
from tests.patience import stretched

from gazelle.geometry import Pose
from gazelle.graph.tf import StampedPose, StaticTransformBroadcaster, TransformBroadcaster
from gazelle.interfaces import message_type

_STEP_NS = 50_000_000
_BEAMS = 180
_REACH_M = 3.5


class PlaneWorld:
    """What move_base and Nav2 need, on the graph of a node.

    Attributes:
        walls: occupied cells, (height, width), 5 cm each, the lower left corner at (0, 0).
        boxes: more cells that the lidar sees and the map does not have.
        pose: x, y, yaw of the robot.
        twist: the last command.
        blind: no scans are sent.
        touched: where the robot's centre was in a wall.
        drift: of odometry against the map, x and y.
        factor: how many times faster than real time it runs.
        late_steps: so many steps of 50 ms tf of the robot comes after what it is of.
    """

    def __init__(self, node: Any, walls: np.ndarray, pose=(1.0, 1.0, 0.0), factor: float = 8.0):
        self.node = node
        self.walls = walls
        self.boxes = np.zeros_like(walls)
        self.pose = pose
        self.twist = (0.0, 0.0)
        self.blind = False
        self.touched: list[tuple[float, float]] = []
        self.drift = (0.3, -0.2)
        self.now_ns = 1_000_000_000
        self.factor = factor
        self.late_steps = 0
        self._on_their_way: deque[StampedPose] = deque()
        self._stop = threading.Event()
        node.parameters.set("/use_sim_time", True)
        self._clock = node.create_publisher("/clock", "rosgraph_msgs/msg/Clock")
        self._map = node.create_publisher("/map", "nav_msgs/msg/OccupancyGrid", latch=True)
        self._scan = node.create_publisher("/scan", "sensor_msgs/msg/LaserScan")
        self._odom = node.create_publisher("/odom", "nav_msgs/msg/Odometry")
        self._tf = TransformBroadcaster(node)
        self._static = StaticTransformBroadcaster(node)
        node.create_subscription("/cmd_vel", "geometry_msgs/msg/Twist", self._on_twist)
        self._thread = threading.Thread(target=self._run, daemon=True)

    def start(self) -> None:
        """Publish the map and begin to move."""
        self._publish_map()
        x, y = self.drift
        self._static.send(
            [
                StampedPose("base_footprint", "base_scan", 0, Pose((0.0, 0.0, 0.2))),
                StampedPose("map", "odom", 0, Pose((x, y, 0.0))),
            ]
        )
        self._thread.start()

    def close(self) -> None:
        """End the world."""
        self._stop.set()
        if self._thread.ident is not None:
            self._thread.join(stretched(10))

    def _run(self) -> None:
        while not self._stop.is_set():
            began = time.monotonic()
            self._step()
            left = _STEP_NS / 1e9 / self.factor - (time.monotonic() - began)
            self._stop.wait(max(left, 0.0))

    def _step(self) -> None:
        self.now_ns += _STEP_NS
        x, y, yaw = self.pose
        linear, angular = self.twist
        duration = _STEP_NS / 1e9
        middle = yaw + angular * duration / 2
        self.pose = (
            x + linear * duration * math.cos(middle),
            y + linear * duration * math.sin(middle),
            math.remainder(yaw + angular * duration, math.tau),
        )
        if self._is_wall(*self.pose[:2]):
            self.touched.append(self.pose[:2])
        self._publish_motion()
        if not self.blind and self.now_ns % 200_000_000 == 0:
            self._publish_scan()
        clock = self._clock.message_class()
        clock.clock.sec, clock.clock.nanosec = divmod(self.now_ns, 1_000_000_000)
        self._clock.publish(clock)

    def _is_wall(self, x: float, y: float) -> bool:
        row, column = int(y / 0.05), int(x / 0.05)
        height, width = self.walls.shape
        if not (0 <= row < height and 0 <= column < width):
            return True
        return bool(self.walls[row, column] or self.boxes[row, column])

    def _on_twist(self, twist: Any) -> None:
        self.twist = (twist.linear.x, twist.angular.z)

    def _stamp(self, message: Any, frame: str) -> Any:
        message.header.frame_id = frame
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(self.now_ns, 1_000_000_000)
        return message

    def _publish_map(self) -> None:
        message = self._stamp(self._map.message_class(), "map")
        message.info.resolution = 0.05
        message.info.height, message.info.width = self.walls.shape
        message.info.origin.orientation.w = 1.0
        message.data = np.where(self.walls, 100, 0).astype(np.int8).ravel()
        self._map.publish(message)

    def _publish_motion(self) -> None:
        x, y, yaw = self.pose
        at = Pose(
            (x - self.drift[0], y - self.drift[1], 0.0),
            (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)),
        )
        self._on_their_way.append(StampedPose("odom", "base_footprint", self.now_ns, at))
        while len(self._on_their_way) > self.late_steps:
            self._tf.send(self._on_their_way.popleft())
        odometry = self._stamp(self._odom.message_class(), "odom")
        odometry.twist.twist.linear.x, odometry.twist.twist.angular.z = self.twist
        self._odom.publish(odometry)

    def _publish_scan(self) -> None:
        x, y, yaw = self.pose
        angles = np.arange(_BEAMS) * math.tau / _BEAMS
        along = np.arange(0.0, _REACH_M, 0.02)
        px = x + along[None, :] * np.cos(angles + yaw)[:, None]
        py = y + along[None, :] * np.sin(angles + yaw)[:, None]
        height, width = self.walls.shape
        rows = np.clip((py / 0.05).astype(int), 0, height - 1)
        columns = np.clip((px / 0.05).astype(int), 0, width - 1)
        hit = (self.walls | self.boxes)[rows, columns]
        ranges = np.where(hit.any(axis=1), along[hit.argmax(axis=1)], math.inf)
        scan: Any = message_type("sensor_msgs/msg/LaserScan")(
            ranges=list(map(float, ranges)),
            angle_min=0.0,
            angle_increment=math.tau / _BEAMS,
            angle_max=math.tau - math.tau / _BEAMS,
            range_min=0.12,
            range_max=_REACH_M,
        )
        self._scan.publish(self._stamp(scan, "base_scan"))


def room(width_m: float = 6.0, height_m: float = 4.0) -> np.ndarray:
    """Return the walls of an empty room."""
    walls = np.zeros((round(height_m / 0.05), round(width_m / 0.05)), bool)
    walls[[0, -1]] = True
    walls[:, [0, -1]] = True
    return walls
