"""``depthimage_to_laserscan`` and ``pointcloud_to_laserscan``."""

from __future__ import annotations

import math
import threading
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.errors import LaunchError
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import ns_of
from gazelle.navigation.laser_scans import CloudSlice, FlatScan, scan_of_depth, scan_of_points
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.navigation.observations import cloud_points
from gazelle.nodes.navigation.robot_pose import Frames
from gazelle.nodes.parameters import private_parameters, start_node
from gazelle.parameters import Parameter, ParameterTable, refused

__all__ = ["CLOUD_PARAMETERS", "DEPTH_PARAMETERS", "depth_of_image", "run_clouds", "run_depth"]

DEPTH_PARAMETERS = ParameterTable(
    "depthimage_to_laserscan",
    "Makes scans of depth pictures.",
    (
        "depthimage_to_laserscan/depthimage_to_laserscan",
        "depthimage_to_laserscan/depthimage_to_laserscan_node",
    ),
    (
        Parameter("scan_height", "number", 1.0, "rows of the picture that count", "pixels"),
        Parameter("scan_time", "number", 0.033, "of the message", "s"),
        Parameter("range_min", "number", 0.45, "nearer is left out", "m"),
        Parameter("range_max", "number", 10.0, "farther is left out", "m"),
        Parameter(
            "output_frame", "text", "camera_depth_frame", "frame of the scans",
            aliases=("output_frame_id",),
        ),
    ),
)  # fmt: skip

CLOUD_PARAMETERS = ParameterTable(
    "pointcloud_to_laserscan",
    "Makes scans of point clouds.",
    ("pointcloud_to_laserscan/pointcloud_to_laserscan_node",),
    (
        Parameter("target_frame", "text", "", "frame of the scans; the cloud's when empty"),
        Parameter("min_height", "number", -math.inf, "lower points are left out", "m"),
        Parameter("max_height", "number", math.inf, "higher points are left out", "m"),
        Parameter("angle_min", "number", -math.pi, "first beam", "rad"),
        Parameter("angle_max", "number", math.pi, "last beam", "rad"),
        Parameter("angle_increment", "number", math.pi / 180, "from beam to beam", "rad"),
        Parameter("scan_time", "number", 1 / 30, "of the message", "s"),
        Parameter("range_min", "number", 0.0, "nearer is left out", "m"),
        Parameter("range_max", "number", math.inf, "farther is left out", "m"),
        Parameter("use_inf", "flag", True, "beams that meet nothing are infinite"),
        Parameter("inf_epsilon", "number", 1.0, "else they are so much beyond range_max", "m"),
        *refused("clouds are taken one after the other, as they come", "concurrency_level"),
        *refused("two clouds may wait", "queue_size"),
        *refused("transforms are waited for as long as clouds are", "transform_tolerance"),
    ),
)

_METRES = {"32FC1": ("f4", 1.0), "16UC1": ("u2", 0.001), "mono16": ("u2", 0.001)}


def depth_of_image(message: Any) -> NDArray[np.float64]:
    """Return the depths of a ``sensor_msgs/Image``, (height, width), m.

    Raises:
        ValueError: its encoding is no depth's, or it has fewer bytes than it says.
    """
    if message.encoding not in _METRES:
        known = ", ".join(_METRES)
        raise ValueError(f"Depth image has unsupported encoding: {message.encoding}, not {known}")
    kind, unit = _METRES[message.encoding]
    dtype = np.dtype((">" if message.is_bigendian else "<") + kind)
    width, height, step = int(message.width), int(message.height), int(message.step)
    data = np.frombuffer(bytes(message.data), np.uint8)
    if len(data) < step * height or step < width * dtype.itemsize:
        raise ValueError(f"the image says {width} × {height} and has {len(data)} bytes")
    rows = data[: step * height].reshape(height, step)[:, : width * dtype.itemsize]
    return np.ascontiguousarray(rows).view(dtype).astype(float) * unit


def run_depth(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Make scans of depth pictures until told to stop."""
    node = start_node(arguments, graph)
    _DepthToScan(node, arguments)
    arguments.ready()
    stop.wait()
    node.shutdown()
    return 0


class _DepthToScan:
    def __init__(self, node: Node, arguments: NodeArguments) -> None:
        with private_parameters(node, arguments, DEPTH_PARAMETERS) as own:
            self._rows = int(own.number("scan_height"))
            self._limits = (
                own.number("range_min"), own.number("range_max"), own.number("scan_time")
            )  # fmt: skip
            self._frame = own.text("output_frame")
        self._frames = Frames(node)
        self._info: Any = None
        self._out = node.create_publisher("scan", message_type("sensor_msgs/msg/LaserScan"))
        depth = _depth_topic(node)
        self._info_topic = _info_topic(node, node.resolve_name(depth).rpartition("/")[0])
        kind = "sensor_msgs/msg/CameraInfo"
        node.create_subscription(self._info_topic, kind, self._on_info, queue_size=2)
        node.create_subscription(depth, "sensor_msgs/msg/Image", self._on_image, queue_size=2)

    def _on_info(self, message: Any) -> None:
        self._info = message

    def _on_image(self, message: Any) -> None:
        if not self._out.matched:
            return
        if self._info is None:
            text = f"no {self._info_topic} has come yet, so depths have no directions"
            self._frames.say("warn", text)
            return
        k, (low, high, _time_s) = self._info.k, self._limits
        try:
            scan = scan_of_depth(
                depth_of_image(message), fx=k[0], fy=k[4], cx=k[2], cy=k[5], rows=self._rows,
                range_min_m=low, range_max_m=high,
            )  # fmt: skip
        except ValueError as error:
            text = f"Could not convert depth image to laserscan: {error}"
            self._frames.say("error", text)
            return
        self._out.publish(_message(scan, message, self._frame, self._limits))


def _depth_topic(node: Node) -> str:
    """Return ``image``, or ROS 2's ``depth`` where that one is remapped."""
    return "depth" if not node.resolve_name("depth").endswith("/depth") else "image"


def _info_topic(node: Node, space: str) -> str:
    own = node.resolve_name("depth_camera_info")
    return f"{space}/camera_info" if own.endswith("/depth_camera_info") else own


def run_clouds(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Make scans of point clouds until told to stop.

    Raises:
        LaunchError: the parameters say no directions.
    """
    node = start_node(arguments, graph)
    try:
        _CloudToScan(node, arguments)
    except ValueError as error:
        node.shutdown()
        raise LaunchError(f"pointcloud_to_laserscan: {error}") from None
    arguments.ready()
    stop.wait()
    node.shutdown()
    return 0


class _CloudToScan:
    def __init__(self, node: Node, arguments: NodeArguments) -> None:
        with private_parameters(node, arguments, CLOUD_PARAMETERS) as own:
            nearest, farthest = own.number("range_min"), own.number("range_max")
            beyond = math.inf if own.flag("use_inf") else farthest + own.number("inf_epsilon")
            self._counted = CloudSlice(
                angle_min_rad=own.number("angle_min"),
                angle_max_rad=own.number("angle_max"),
                increment_rad=own.number("angle_increment"),
                low_m=own.number("min_height"),
                high_m=own.number("max_height"),
                range_min_m=nearest,
                range_max_m=farthest,
                empty=beyond,
            )
            time_s = own.number("scan_time")
            self._target = own.text("target_frame")
        # What is wrong with them is told now, not with the first cloud.
        scan_of_points(np.zeros((0, 3)), self._counted)
        self._limits = (nearest, farthest, time_s)
        self._frames = Frames(node)
        self._out = node.create_publisher("scan", message_type("sensor_msgs/msg/LaserScan"))
        kind = "sensor_msgs/msg/PointCloud2"
        node.create_subscription("cloud_in", kind, self._on_cloud, queue_size=2)

    def _on_cloud(self, message: Any) -> None:
        if not self._out.matched:
            return
        source = str(message.header.frame_id)
        frame = self._target or source
        try:
            points = cloud_points(message)
        except ValueError as error:
            self._frames.say("error", f"a cloud is left out: {error}")
            return
        if frame != source:
            T = self._frames.between(frame, source, ns_of(message.header.stamp))
            if isinstance(T, str):
                self._frames.say("warn", f"Transform failure: {T}", key=f"cloud {source}")
                return
            points = T.transform(points)
        scan = scan_of_points(points, self._counted)
        self._out.publish(_message(scan, message, frame, self._limits))


def _message(scan: FlatScan, source: Any, frame: str, limits: tuple[float, float, float]) -> Any:
    message: Any = message_type("sensor_msgs/msg/LaserScan")()
    message.header.stamp, message.header.frame_id = source.header.stamp, frame
    message.angle_min, message.angle_max = scan.angle_min_rad, scan.angle_max_rad
    message.angle_increment = scan.increment_rad
    message.range_min, message.range_max, message.scan_time = limits
    message.ranges = scan.ranges_m
    return message
