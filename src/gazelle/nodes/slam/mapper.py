"""SLAM that lives in a node: scans and tf in, maps and the transform from the map out."""

from __future__ import annotations

import math
import threading
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.geometry import Pose
from gazelle.graph.tf import StampedPose, TransformBroadcaster
from gazelle.interfaces import message_type
from gazelle.mapping.grids import OccupancyGrid
from gazelle.mapping.se2 import Poses, between, compose, inverse
from gazelle.mapping.slam import MapDrawer, Slam
from gazelle.nodes.map_server.occupancy_grid import message_of_grid
from gazelle.nodes.navigation.robot_pose import Frames
from gazelle.nodes.slam.parameters import SlamOptions
from gazelle.nodes.slam.scan_messages import PlacedScan, ScanQueue

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["Mapper"]

_NANO = 1_000_000_000
_JUMP_M = 1.0
_JUMP_M_S = 5.0
_JUMP_RAD = 1.5
_JUMP_RAD_S = 6.0
_LOST_SCANS = 10
_WAITING = 10


class Mapper:
    """The engine with its topics.

    Attributes:
        options: as the parameters say.
        engine: the map so far.
        lock: held while the engine takes a scan or is replaced.
        is_paused: scans are not used.
    """

    def __init__(self, node: Node, options: SlamOptions) -> None:
        """Offer the map; nothing is listened to before `listen`."""
        self.options = options
        self.engine = Slam(options.slam)
        self.lock = threading.RLock()
        self.is_paused = False
        self._node = node
        self._frames = Frames(node)
        frames = (options.odom_frame, options.base_frame)
        self._queue = ScanQueue(
            self._frames.buffer, frames, lambda text: self._frames.say("warn", text, "dropped"),
            size=_WAITING, max_range_m=options.range_limit_m,
        )  # fmt: skip
        self._drawer = MapDrawer(options.resolution_m, options.occupied_share)
        grid: Any = message_type("nav_msgs/msg/OccupancyGrid")
        about: Any = message_type("nav_msgs/msg/MapMetaData")
        self._map_out = node.create_publisher("map", grid, latch=True, queue_size=1)
        self._about_out = node.create_publisher("map_metadata", about, latch=True, queue_size=1)
        self._tf_out = TransformBroadcaster(node)
        self._T_map_odom: Poses | None = None
        self._last: tuple[Poses, int] | None = None
        self._drive = np.zeros(3)
        self._seen = 0
        self._unmatched = 0

    def listen(self) -> None:
        """Take scans from now on."""
        self._node.create_subscription(
            self.options.scan_topic, "sensor_msgs/msg/LaserScan", self._on_scan, queue_size=20
        )
        self._node.clock.on_jump(self._on_time_jump)

    def settle(self) -> None:
        """Use scans whose transforms have come meanwhile."""
        with self.lock:
            self._take(self._queue.ready())

    def replace(self, engine: Slam) -> None:
        """Go on with another map."""
        with self.lock:
            self.engine = engine
            self._drawer = MapDrawer(self.options.resolution_m, self.options.occupied_share)
            self._T_map_odom = self._last = None

    def grid(self) -> OccupancyGrid | None:
        """Draw the map as it is known now, None before the first scan."""
        engine = self.engine
        return self._drawer.draw(engine.keyframes) if len(engine.keyframes) else None

    def publish_map(self) -> None:
        """Send the map, if there is one."""
        grid = self.grid()
        if grid is None:
            return
        message = message_of_grid(grid, self.options.map_frame, self._node.clock.now_ns())
        self._map_out.publish(message)
        self._about_out.publish(message.info)

    def publish_transform(self, now_ns: int) -> None:
        """Send where odometry's frame is in the map; its origin before the first scan."""
        at = np.zeros(3) if self._T_map_odom is None else self._T_map_odom
        x, y, yaw = at.tolist()
        pose = Pose.from_xy_yaw(x, y, yaw)
        stamp_ns = now_ns + int(self.options.tf_ahead_s * _NANO)
        told = self.options
        self._tf_out.send(StampedPose(told.map_frame, told.odom_frame, stamp_ns, pose))

    def _on_scan(self, message: Any) -> None:
        self._seen += 1
        if self.is_paused or (self._seen - 1) % max(1, self.options.throttle):
            return
        with self.lock:
            self._take(self._queue.add(message))

    def _take(self, placed: list[PlacedScan]) -> None:
        for one in placed:
            last_ns = None if self._last is None else self._last[1]
            if last_ns is not None and one.scan.stamp_ns < last_ns:
                self._frames.say("warn", "a scan is older than the last one; it is left out", "old")
                continue
            least_ns = int(self.options.least_interval_s * _NANO)
            if last_ns is not None and one.scan.stamp_ns - last_ns < least_ns:
                continue
            self._map(one)

    def _map(self, one: PlacedScan) -> None:
        self._follow(one)
        if not len(self.engine.keyframes):
            # As slam_gmapping, slam_karto and slam_toolbox: map and odometry agree at the start.
            self.engine.begin(one.odometry)
        update = self.engine.add(one.scan, self._drive)
        self._T_map_odom = compose(update.pose, inverse(one.odometry))
        self._tell(one, is_matched=update.is_matched)
        if update.is_keyframe and self.options.map_period_s <= 0:
            self.publish_map()

    def _follow(self, one: PlacedScan) -> None:
        """Add up odometry's motions, leaving out those that no robot makes."""
        odometry, stamp_ns = one.odometry, one.scan.stamp_ns
        if self._last is not None:
            motion = between(self._last[0], odometry)
            time_s = (stamp_ns - self._last[1]) / _NANO
            way, turn = math.hypot(motion[0], motion[1]), abs(float(motion[2]))
            if way > _JUMP_M + _JUMP_M_S * time_s or turn > _JUMP_RAD + _JUMP_RAD_S * time_s:
                self._node.log(
                    "warn",
                    f"odometry jumped by {way:.2f} m and {math.degrees(turn):.0f}° within "
                    f"{time_s:.2f} s; the robot is taken to stand where it was, and looked for "
                    "there by its scans",
                )
                motion = np.zeros(3)
            self._drive = compose(self._drive, motion)
        elif self._T_map_odom is not None:
            # Time has gone back, as when a simulation is reset: the robot is where odometry says.
            self.engine.resume(compose(self._T_map_odom, odometry))
        self._last = odometry, stamp_ns

    def _tell(self, one: PlacedScan, *, is_matched: bool) -> None:
        if not one.scan.hits(self.options.slam.max_range_m).any():
            limit = min(one.scan.range_max_m, self.options.slam.max_range_m)
            self._frames.say(
                "warn",
                "no beam of the scan met anything: all ranges are NaN, infinite or beyond "
                f"{one.scan.range_min_m:g} … {limit:g} m; the robot goes by odometry",
                "empty scan",
            )
            return
        self._unmatched = 0 if is_matched else self._unmatched + 1
        if self._unmatched == _LOST_SCANS:
            self._frames.say(
                "warn",
                f"{_LOST_SCANS} scans in a row do not fit the map; the robot goes by odometry "
                "until one does",
                "lost",
            )

    def _on_time_jump(self, delta_ns: int) -> None:
        if delta_ns < 0:
            with self.lock:
                self._queue.clear()
                self._last = None
