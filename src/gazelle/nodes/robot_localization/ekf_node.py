"""``robot_localization``'s EKF: ``ekf_localization_node`` (ROS 1), ``ekf_node`` (ROS 2)."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.errors import LaunchError
from gazelle.geometry import Pose
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import set_pose, set_xyz
from gazelle.interfaces.stamps import ns_of, set_header
from gazelle.navigation.localization.ekf import Ekf
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import parameter_tree, private_parameters, start_node, ticks
from gazelle.nodes.robot_localization.fusion import (
    Fusion,
    Measurement,
    measure_imu,
    measure_pose,
    measure_twist,
)
from gazelle.nodes.robot_localization.parameters import ekf_inputs, ekf_table, threshold_owners
from gazelle.parameters.reader import ParameterReader

__all__ = ["config_of", "matrix_of", "run"]

_TYPES = {
    "odom": "nav_msgs/msg/Odometry",
    "pose": "geometry_msgs/msg/PoseWithCovarianceStamped",
    "twist": "geometry_msgs/msg/TwistWithCovarianceStamped",
    "imu": "sensor_msgs/msg/Imu",
}
_STATES = 15


@dataclass(frozen=True, slots=True, eq=False)
class _Input:
    """A topic that is fused.

    Attributes:
        name, kind: such as ``odom0`` and ``odom``.
        config: which states count, (15,).
        thresholds: see `Ekf.update`, by ``pose`` and ``twist``.
        is_differential: poses count as velocities between them.
        is_relative: poses count from the first one.
        without_gravity: gravity is no part of an IMU's accelerations.
    """

    name: str
    kind: str
    topic: str
    config: NDArray[np.bool_]
    thresholds: Mapping[str, float]
    is_differential: bool
    is_relative: bool
    without_gravity: bool


def config_of(name: str, value: Any) -> NDArray[np.bool_]:
    """Return which states an input counts for, (15,).

    Raises:
        LaunchError: it is no list of 15 truth values.
    """
    if not isinstance(value, list | tuple) or len(value) != 15:
        count = len(value) if isinstance(value, list | tuple) else repr(value)
        raise LaunchError(
            f"{name} is a list of 15 truth values (x y z, roll pitch yaw, their velocities, x y z "
            f"accelerations), not {count}"
        )
    return np.array([str(item).lower() in ("true", "1") for item in value])


def matrix_of(name: str, value: Any) -> NDArray[np.float64] | None:
    """Return a matrix of 15 × 15 numbers, or of 15 on its diagonal; None for nothing.

    Raises:
        LaunchError: it is neither.
    """
    if value is None:
        return None
    try:
        numbers = np.array(value, float).ravel()
    except (TypeError, ValueError):
        numbers = np.zeros(0)
    if numbers.size == 15:
        return np.diag(numbers)
    if numbers.size != 225:
        raise LaunchError(f"{name} has {numbers.size} numbers, not 225 (15 × 15) or 15")
    return numbers.reshape(15, 15)


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Fuse measurements until told to stop.

    Raises:
        LaunchError: a parameter cannot be used.
    """
    node = start_node(arguments, graph)
    table = ekf_table(parameter_tree(node, arguments))
    try:
        with private_parameters(node, arguments, table) as own:
            period_ns = int(1e9 / own.number("frequency"))
            filter_ = _Localization(node, own)
    except LaunchError:
        node.shutdown()
        raise
    arguments.ready()
    for _now_ns in ticks(node, period_ns, stop):
        filter_.publish()
    node.shutdown()
    return 0


def _input(own: ParameterReader, name: str) -> _Input:
    kind = name.rstrip("0123456789")
    key = f"{name}_config"
    return _Input(
        name,
        kind,
        own.text(name),
        config_of(key, own.raw(key, [False] * _STATES)),
        {
            part: own.number(f"{owner}_rejection_threshold")
            for owner, part in threshold_owners(name).items()
        },
        is_differential=kind != "twist" and own.flag(f"{name}_differential"),
        is_relative=kind != "twist" and own.flag(f"{name}_relative"),
        without_gravity=kind == "imu" and own.flag(f"{name}_remove_gravitational_acceleration"),
    )


def _filter(own: ParameterReader) -> Ekf:
    noise, start = (
        matrix_of(key, own.raw(key))
        for key in ("process_noise_covariance", "initial_estimate_covariance")
    )
    ekf = Ekf(noise, start, planar=own.flag("two_d_mode"))
    state = own.numbers("initial_state")
    if len(state) == _STATES:
        ekf.state[:] = state
    elif state:
        text = f"parameter 'initial_state' has {len(state)} numbers, not {_STATES}; it is left out"
        own.report("parameter.bad-value", text, key="initial_state")
    return ekf


class _Localization:
    def __init__(self, node: Node, own: ParameterReader) -> None:
        self._fusion = Fusion(node, _filter(own))
        self._odom, self._base = own.text("odom_frame"), own.text("base_link_frame")
        self._map = own.text("map_frame")
        self._world = own.text("world_frame", self._odom)
        self._offset_ns = int(own.number("transform_time_offset") * 1e9)
        self._sends_tf = own.flag("publish_tf")
        inputs = [_input(own, name) for name in ekf_inputs(own.tree)]
        if not inputs:
            node.log("error", "no input is given: set odom0, imu0, pose0 or twist0 to a topic, and "
                     "odom0_config … to what counts")  # fmt: skip
        for one in inputs:
            self._connect(node, one)
        odometry = message_type("nav_msgs/msg/Odometry")
        self._out = node.create_publisher("odometry/filtered", odometry)
        kind = "geometry_msgs/msg/PoseWithCovarianceStamped"
        node.create_subscription("set_pose", kind, self._on_set_pose, queue_size=1)

    def _connect(self, node: Node, one: _Input) -> None:
        if not one.config.any():
            node.log("warn", f"{one.name}_config is all false: {one.topic} does not count")

        def on_message(message: Any) -> None:
            for found, part in self._measurements(one, message):
                self._fusion.take(
                    f"{one.name}_{part}",
                    found,
                    one.config,
                    by_difference=part == "pose" and one.is_differential,
                    relative=part == "pose" and one.is_relative,
                    threshold=one.thresholds[part],
                )

        node.create_subscription(one.topic, _TYPES[one.kind], on_message, queue_size=10)

    def _measurements(self, one: _Input, message: Any) -> list[tuple[Measurement, str]]:
        stamp_ns = ns_of(message.header.stamp)
        if one.kind == "odom":
            return [
                (measure_pose(message.pose, stamp_ns), "pose"),
                (measure_twist(message.twist, stamp_ns), "twist"),
            ]
        if one.kind == "pose":
            return [(measure_pose(message.pose, stamp_ns), "pose")]
        if one.kind == "twist":
            return [(measure_twist(message.twist, stamp_ns), "twist")]
        frame = str(message.header.frame_id).removeprefix("/")
        T_base_imu = self._fusion.frames.between(self._base, frame)
        if isinstance(T_base_imu, str):
            text = f"{one.name}: an IMU in frame '{frame}' is left out: {T_base_imu}"
            self._fusion.frames.say("warn", text, key=one.name)
            return []
        found = measure_imu(message, stamp_ns, T_base_imu, without_gravity=one.without_gravity)
        turning = Measurement(stamp_ns, found.values, found.covariance, found.measured.copy())
        turning.measured[:6] = False
        found.measured[6:] = False
        return [(found, "pose"), (turning, "twist")]

    def _on_set_pose(self, message: Any) -> None:
        self._fusion.place(measure_pose(message.pose, ns_of(message.header.stamp)))

    def publish(self) -> None:
        """Publish state and transform."""
        stamp_ns, state, covariance = self._fusion.snapshot()
        if stamp_ns == 0:
            return
        x, y, z, roll, pitch, yaw = map(float, state[:6])
        pose = Pose.from_xyz_rpy((x, y, z), (roll, pitch, yaw))
        message: Any = message_type("nav_msgs/msg/Odometry")()
        set_header(message, stamp_ns, self._world)
        message.child_frame_id = self._base
        set_pose(message.pose.pose, pose)
        message.pose.covariance = covariance[:6, :6].ravel().tolist()
        linear, angular = message.twist.twist.linear, message.twist.twist.angular
        set_xyz(linear, state[6:9])
        set_xyz(angular, state[9:12])
        message.twist.covariance = covariance[6:12, 6:12].ravel().tolist()
        self._out.publish(message)
        if self._sends_tf:
            self._send(pose, stamp_ns + self._offset_ns)

    def _send(self, pose: Pose, stamp_ns: int) -> None:
        if self._world != self._map:
            self._fusion.send(self._world, self._base, pose, stamp_ns)
            return
        T_odom_base = self._fusion.frames.between(self._odom, self._base)
        if isinstance(T_odom_base, str):
            text = f"map → odom is not sent: {T_odom_base}"
            self._fusion.frames.say("warn", text, key="map to odom")
            return
        self._fusion.send(self._map, self._odom, pose @ T_odom_base.inverse(), stamp_ns)
