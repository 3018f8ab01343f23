"""A SLAM node's inside without a graph: what it hears and says, step by step."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import SimpleNamespace
from typing import Any

import numpy as np

from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose
from gazelle.graph.tf import StampedPose, TransformBroadcaster
from gazelle.interfaces import message_type
from gazelle.nodes.parameters import node_reader
from gazelle.nodes.slam.mapper import Mapper
from gazelle.nodes.slam.parameters import SLAM_NODES, SlamOptions, options_of
from gazelle.parameters.trees import nested

POSES = [(0.1 * k - 1, 0.05 * k - 0.5, 0.05 * k) for k in range(20)]
STEP_NS = 50_000_000


def told(family: str, values: Mapping[str, Any]) -> SlamOptions:
    """Options of a flavour with some parameters set; none of them may be complained of."""
    found = Diagnostics()
    settings = node_reader(SLAM_NODES[family].table, nested(values), "/slam", found)
    options = options_of(SLAM_NODES[family], settings)
    settings.report_unknown()
    assert not list(found)
    return options


def ranges(x: float, y: float, yaw: float, beams: int = 180) -> list[float]:
    """What a lidar sees in a room of 6 × 4 m."""
    angles = yaw + math.tau / beams * np.arange(beams)
    cos, sin = np.cos(angles), np.sin(angles)
    with np.errstate(divide="ignore"):
        across = np.where(cos > 0, (3 - x) / cos, (-3 - x) / cos)
        along = np.where(sin > 0, (2 - y) / sin, (-2 - y) / sin)
    return list(np.minimum(across, along))


class Clock:
    """Time as the test says."""

    def __init__(self) -> None:
        self.time_ns = 10**9
        self.listeners: list[Callable[[int], None]] = []

    def now_ns(self) -> int:
        return self.time_ns

    def on_jump(self, listener: Callable[[int], None]) -> None:
        self.listeners.append(listener)

    def jump(self, delta_ns: int) -> None:
        self.time_ns += delta_ns
        for listener in self.listeners:
            listener(delta_ns)


class StepNode:
    """A node whose messages are delivered at once; everything it says is kept."""

    def __init__(self) -> None:
        self.clock = Clock()
        self.closed = False
        self.sent: dict[str, list[Any]] = {}
        self.said: list[str] = []
        self._heard: dict[str, list[tuple[Callable[..., None], bool]]] = {}

    def create_publisher(self, topic: str, _kind: Any, **_options: Any) -> Any:
        return SimpleNamespace(publish=lambda message: self._publish(topic, message))

    def create_subscription(
        self, topic: str, _kind: Any, callback: Callable[..., None], **options: Any
    ) -> Any:
        self._heard.setdefault(topic, []).append((callback, options.get("with_info", False)))
        return SimpleNamespace(unregister=lambda: None)

    def log(self, _level: str, text: str) -> None:
        self.said.append(text)

    def deliver(self, topic: str, message: Any) -> None:
        for callback, with_info in self._heard.get(topic, []):
            callback(*((message, SimpleNamespace(publisher="/robot")) if with_info else (message,)))

    def _publish(self, topic: str, message: Any) -> None:
        self.sent.setdefault(topic, []).append(message)


class Drive:
    """A robot that drives in a room, and the SLAM that follows it."""

    def __init__(self, options: SlamOptions, odom: str = "odom", base: str = "base_link") -> None:
        self.node = StepNode()
        self.mapper = Mapper(self.node, options)  # type: ignore[arg-type]
        self.mapper.listen()
        self.odom, self.base = odom, base
        sender = SimpleNamespace(create_publisher=lambda *_a, **_k: SimpleNamespace(
            publish=lambda message: self.node.deliver("/tf", message)))  # fmt: skip
        self.tf = TransformBroadcaster(sender)  # type: ignore[arg-type]

    def place(self, pose: tuple[float, float, float]) -> None:
        """Send the transforms of a pose."""
        x, y, yaw = pose
        at = Pose((x, y, 0.0), (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)))
        now_ns = self.node.clock.time_ns
        laser = StampedPose(self.base, "laser", now_ns, Pose((0.0, 0.0, 0.2)))
        self.tf.send([StampedPose(self.odom, self.base, now_ns, at), laser])

    def scan(self, pose: tuple[float, float, float], **values: Any) -> None:
        """Send a scan."""
        beams = values.pop("beams", 180)
        told: dict[str, Any] = {
            "angle_increment": math.tau / beams, "range_min": 0.1, "range_max": 20.0,
            "ranges": ranges(*pose, beams), **values,
        }  # fmt: skip
        frame = told.pop("frame", "laser")
        message = message_type("sensor_msgs/msg/LaserScan")(**told)
        message.header.frame_id = frame
        stamp = divmod(self.node.clock.time_ns, 10**9)
        message.header.stamp.sec, message.header.stamp.nanosec = stamp
        self.node.deliver("scan", message)
        self.node.deliver("/scan", message)

    def step(self, pose: tuple[float, float, float], **values: Any) -> None:
        """Let a twentieth of a second pass and be at a pose."""
        self.node.clock.time_ns += STEP_NS
        self.place(pose)
        self.scan(pose, **values)

    def drive(self, poses: list[tuple[float, float, float]] = POSES, **values: Any) -> Drive:
        """Be at poses, one after the other."""
        for pose in poses:
            self.step(pose, **values)
        return self

    @property
    def kept(self) -> int:
        """How many scans are in the map."""
        return len(self.mapper.engine.keyframes)

    @property
    def used(self) -> int:
        """How many scans were used."""
        return len(self.mapper.engine.trajectory())
