"""Codecs in C++, compiled once a session."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.cpp.interfaces.message_probe import MessageProbe

from gazelle.interfaces import RosVersion

_BOTH = (
    "geometry_msgs/msg/PoseWithCovarianceStamped",
    "sensor_msgs/msg/CameraInfo",
    "sensor_msgs/msg/JointState",
    "sensor_msgs/msg/LaserScan",
    "sensor_msgs/msg/PointCloud2",
    "shape_msgs/msg/Mesh",
    "std_msgs/msg/Header",
    "std_msgs/msg/String",
    "std_srvs/srv/SetBool_Request",
    "std_srvs/srv/Empty_Response",
    "tf2_msgs/msg/TFMessage",
    "trajectory_msgs/msg/JointTrajectory",
    "visualization_msgs/msg/Marker",
    "probe_msgs/msg/Shapes",
    "probe_msgs/srv/Ask_Response",
)
_ROS1 = (
    *_BOTH,
    "actionlib_tutorials/msg/FibonacciAction",
    "control_msgs/msg/JointTrajectoryControllerState",
    "rosgraph_msgs/msg/Log",
    "std_msgs/msg/Byte",
    "std_msgs/msg/Duration",
    "std_msgs/msg/Time",
    "probe_msgs/msg/WalkActionGoal",
)
_ROS2 = (
    *_BOTH,
    "control_msgs/msg/JointTrajectoryControllerState",
    "example_interfaces/action/Fibonacci_GetResult_Response",
    "rcl_interfaces/msg/ParameterEvent",
    "std_msgs/msg/Empty",
    "unique_identifier_msgs/msg/UUID",
    "probe_msgs/action/Walk_SendGoal_Request",
    "probe_msgs/msg/Everything",
)


@pytest.fixture(scope="session")
def ros1_probe(tmp_path_factory: pytest.TempPathFactory, shared_cpp_cache: Path) -> MessageProbe:
    """Messages of ROS 1 in C++."""
    del shared_cpp_cache
    return MessageProbe(tmp_path_factory.mktemp("probe1"), RosVersion.ROS1, _ROS1)


@pytest.fixture(scope="session")
def ros2_probe(tmp_path_factory: pytest.TempPathFactory, shared_cpp_cache: Path) -> MessageProbe:
    """Messages of ROS 2 in C++."""
    del shared_cpp_cache
    return MessageProbe(tmp_path_factory.mktemp("probe2"), RosVersion.ROS2, _ROS2)
