"""``robot_localization``'s EKF: ``ekf_localization_node`` (ROS 1), ``ekf_node`` (ROS 2)."""

from __future__ import annotations

import math
import threading
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.diagnostics import Diagnostics
from gazelle.errors import LaunchError
from gazelle.geometry import Pose
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import set_pose, set_xyz
from gazelle.interfaces.stamps import ns_of, set_header
from gazelle.navigation.filters.ekf import Ekf
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.filters.fusing import Fusion
from gazelle.nodes.filters.measuring import (
    Measurement,
    measure_imu,
    measure_pose,
    measure_twist,
)
from gazelle.nodes.filters.tables import report_ekf, threshold_owners
from gazelle.nodes.findings import log_findings
from gazelle.nodes.parameters import parameter_tree, start_node, ticks

__all__ = ["config_of", "matrix_of", "run"]

_INPUTS = {
    "odom": "nav_msgs/msg/Odometry",
    "pose": "geometry_msgs/msg/PoseWithCovarianceStamped",
    "twist": "geometry_msgs/msg/TwistWithCovarianceStamped",
    "imu": "sensor_msgs/msg/Imu",
}
_MOST = 20


def config_of(name: str, value: Any) -> NDArray[np.bool_]:
    """Return which states an input counts for.

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
    tree = parameter_tree(node, arguments)
    try:
        filter_ = _Localization(node, tree)
    except LaunchError:
        node.shutdown()
        raise
    arguments.ready()
    period_ns = int(1e9 / max(float(tree.get("frequency", 30.0)), 0.1))
    for _now_ns in ticks(node, period_ns, stop):
        filter_.publish()
    node.shutdown()
    return 0


class _Localization:
    def __init__(self, node: Node, tree: Mapping[str, Any]) -> None:
        self._tree = tree
        noise = matrix_of("process_noise_covariance", tree.get("process_noise_covariance"))
        start = matrix_of("initial_estimate_covariance", tree.get("initial_estimate_covariance"))
        ekf = Ekf(noise, start, planar=bool(tree.get("two_d_mode", False)))
        state = tree.get("initial_state")
        if isinstance(state, list) and len(state) == 15:
            ekf.state[:] = state
        self._fusion = Fusion(node, ekf)
        self._odom = str(tree.get("odom_frame", "odom"))
        self._base = str(tree.get("base_link_frame", "base_link"))
        self._map = str(tree.get("map_frame", "map"))
        self._world = str(tree.get("world_frame", self._odom))
        self._offset_ns = int(float(tree.get("transform_time_offset", 0.0)) * 1e9)
        told = Diagnostics()
        report_ekf(tree, node.name, told)
        log_findings(node, told)
        found = [f"{kind}{k}" for kind in _INPUTS for k in range(_MOST) if f"{kind}{k}" in tree]
        if not found:
            node.log("error", "no input is given: set odom0, imu0, pose0 or twist0 to a topic, and "
                     "odom0_config … to what counts")  # fmt: skip
        for name in found:
            self._connect(node, name)
        odometry = message_type("nav_msgs/msg/Odometry")
        self._out = node.create_publisher("odometry/filtered", odometry)
        kind = "geometry_msgs/msg/PoseWithCovarianceStamped"
        node.create_subscription("set_pose", kind, self._on_set_pose, queue_size=1)

    def _connect(self, node: Node, name: str) -> None:
        kind = name.rstrip("0123456789")
        config = config_of(f"{name}_config", self._tree.get(f"{name}_config", [False] * 15))
        if not config.any():
            node.log("warn", f"{name}_config is all false: {self._tree[name]} does not count")

        thresholds = {
            part: float(self._tree.get(f"{owner}_rejection_threshold", math.inf))
            for owner, part in threshold_owners(name).items()
        }

        def on_message(message: Any) -> None:
            for found, part in self._measurements(name, kind, message):
                key, poses = f"{name}_{part}", part == "pose"
                self._fusion.take(
                    key,
                    found,
                    config,
                    by_difference=poses and bool(self._tree.get(f"{name}_differential")),
                    relative=poses and bool(self._tree.get(f"{name}_relative")),
                    threshold=thresholds[part],
                )

        node.create_subscription(str(self._tree[name]), _INPUTS[kind], on_message, queue_size=10)

    def _measurements(self, name: str, kind: str, message: Any) -> list[tuple[Measurement, str]]:
        stamp_ns = ns_of(message.header.stamp)
        if kind == "odom":
            return [
                (measure_pose(message.pose, stamp_ns), "pose"),
                (measure_twist(message.twist, stamp_ns), "twist"),
            ]
        if kind == "pose":
            return [(measure_pose(message.pose, stamp_ns), "pose")]
        if kind == "twist":
            return [(measure_twist(message.twist, stamp_ns), "twist")]
        frame = str(message.header.frame_id).removeprefix("/")
        T_base_imu = self._fusion.frames.between(self._base, frame)
        if isinstance(T_base_imu, str):
            text = f"{name}: an IMU in frame '{frame}' is left out: {T_base_imu}"
            self._fusion.frames.say("warn", text, key=name)
            return []
        gravity = bool(self._tree.get(f"{name}_remove_gravitational_acceleration", False))
        found = measure_imu(message, stamp_ns, T_base_imu, without_gravity=gravity)
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
        if self._tree.get("publish_tf", True):
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
