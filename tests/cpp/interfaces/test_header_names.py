"""Files and classes of C++ are called as gencpp and rosidl call them."""

from __future__ import annotations

import pytest

from gazelle.cpp.interfaces.header_names import class_name, header_path, snake_name
from gazelle.interfaces import RosVersion


@pytest.mark.parametrize(
    ("name", "snake"),
    [
        ("String", "string"),
        ("LaserScan", "laser_scan"),
        ("PointCloud2", "point_cloud2"),
        ("UInt8MultiArray", "u_int8_multi_array"),
        ("MultiDOFJointState", "multi_dof_joint_state"),
        ("TFMessage", "tf_message"),
        ("GetPlan2D", "get_plan2_d"),
        ("UUID", "uuid"),
    ],
)
def test_files_of_ros2_are_in_snake_case(name: str, snake: str) -> None:
    assert snake_name(name) == snake


@pytest.mark.parametrize(
    ("full", "ros1", "ros2"),
    [
        ("std_msgs/msg/String", "std_msgs/String.h", "std_msgs/msg/string.hpp"),
        ("std_srvs/srv/SetBool", "std_srvs/SetBool.h", "std_srvs/srv/set_bool.hpp"),
        (
            "std_srvs/srv/SetBool_Request",
            "std_srvs/SetBoolRequest.h",
            "std_srvs/srv/set_bool.hpp",
        ),
        ("x/action/Walk_Goal", "x/Walk_Goal.h", "x/action/walk.hpp"),
        ("x/action/Walk_SendGoal_Request", "x/Walk_SendGoal_Request.h", "x/action/walk.hpp"),
        ("x/action/Walk_FeedbackMessage", "x/Walk_FeedbackMessage.h", "x/action/walk.hpp"),
    ],
)
def test_a_type_has_a_header(full: str, ros1: str, ros2: str) -> None:
    assert header_path(full, RosVersion.ROS2) == ros2
    if "/action/" not in full:
        assert header_path(full, RosVersion.ROS1) == ros1


def test_a_type_has_a_class() -> None:
    assert class_name("std_msgs/msg/String", RosVersion.ROS1) == "::std_msgs::String"
    assert class_name("std_msgs/msg/String", RosVersion.ROS1, "A") == "::std_msgs::String_<A>"
    assert class_name("x/srv/Ask_Request", RosVersion.ROS1) == "::x::AskRequest"
    assert class_name("x/srv/Ask_Request", RosVersion.ROS2) == "::x::srv::Ask_Request"
