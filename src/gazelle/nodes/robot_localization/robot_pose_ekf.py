"""``robot_pose_ekf``: fuses wheel odometry, IMU and visual odometry (ROS 1)."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np

from gazelle.geometry import Pose
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import set_pose
from gazelle.interfaces.stamps import ns_of, set_header
from gazelle.navigation.localization.ekf import Ekf
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import private_parameters, start_node, ticks
from gazelle.nodes.robot_localization.fusion import Fusion, measure_imu, measure_pose
from gazelle.nodes.robot_localization.parameters import POSE_EKF

__all__ = ["run"]

_POSE = np.arange(15) < 6
_TURN = np.isin(np.arange(15), (5,))
_INPUTS = ("odom_used", "vo_used", "imu_used")
_LEVEL = np.isin(np.arange(15), (3, 4))


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Fuse measurements until told to stop."""
    node = start_node(arguments, graph)
    fusion = Fusion(node, Ekf())
    with private_parameters(node, arguments, POSE_EKF) as own:
        base, parent = own.text("base_footprint_frame"), own.text("output_frame")
        period_ns = int(1e9 / own.number("freq"))
        used = frozenset(key for key in _INPUTS if own.flag(key))
    _connect(node, used, fusion, base)
    kind: Any = message_type("geometry_msgs/msg/PoseWithCovarianceStamped")
    out = node.create_publisher("~/odom_combined", kind)
    arguments.ready()
    for _now_ns in ticks(node, period_ns, stop):
        stamp_ns, state, covariance = fusion.snapshot()
        if stamp_ns == 0:
            continue
        x, y, z, roll, pitch, yaw = map(float, state[:6])
        pose = Pose.from_xyz_rpy((x, y, z), (roll, pitch, yaw))
        message = kind()
        set_header(message, stamp_ns, parent)
        set_pose(message.pose.pose, pose)
        message.pose.covariance = covariance[:6, :6].ravel().tolist()
        out.publish(message)
        fusion.send(parent, base, pose, stamp_ns)
    node.shutdown()
    return 0


def _connect(node: Node, used: frozenset[str], fusion: Fusion, base: str) -> None:
    """Listen to what is used; every pose counts relative to the one before, as in the original."""

    def on_odometry(name: str) -> Any:
        def take(message: Any) -> None:
            found = measure_pose(message.pose, ns_of(message.header.stamp))
            fusion.take(name, found, _POSE, by_difference=True)

        return take

    def on_imu(message: Any) -> None:
        frame = str(message.header.frame_id).removeprefix("/")
        T_base_imu = fusion.frames.between(base, frame)
        if isinstance(T_base_imu, str):
            text = f"Could not transform imu message from {frame} to {base}. Imu will not be "
            fusion.frames.say("warn", f"{text}activated yet. ({T_base_imu})", key="imu")
            return
        found = measure_imu(message, ns_of(message.header.stamp), T_base_imu)
        fusion.take("imu", found, _TURN, by_difference=True)
        fusion.take("imu level", found, _LEVEL)

    odometry = "nav_msgs/msg/Odometry"
    if "odom_used" in used:
        node.create_subscription("odom", odometry, on_odometry("odom"), queue_size=10)
    if "vo_used" in used:
        node.create_subscription("vo", odometry, on_odometry("vo"), queue_size=10)
    if "imu_used" in used:
        node.create_subscription("imu_data", "sensor_msgs/msg/Imu", on_imu, queue_size=10)
