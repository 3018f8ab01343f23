"""What is said of headers, packages and functions that are nowhere."""

from __future__ import annotations

import pytest

from gazelle.cpp.requirements import (
    header_advice,
    library_advice,
    package_advice,
    refused_header,
)


@pytest.mark.parametrize(
    ("header", "generation", "package"),
    [
        ("gazebo/gazebo.hh", 1, "gazebo"),
        ("gazebo_msgs/SpawnModel.h", 1, ""),
        ("rviz_common/panel.hpp", 2, "rviz_common"),
        ("hardware_interface/system_interface.hpp", 2, "hardware_interface"),
        ("hardware_interface/joint_state_interface.h", 1, ""),
        ("gazebo.h", 1, ""),
    ],
)
def test_headers_of_what_is_refused(header: str, generation: int, package: str) -> None:
    assert refused_header(header, generation) == package


def test_a_header_of_a_library_of_the_system_names_its_package() -> None:
    text, fix = header_advice("opencv2/core.hpp", 1)
    assert "OpenCV" in text
    assert fix == "apt install libopencv-dev"


def test_a_header_that_is_misspelt_is_found_nearly() -> None:
    text, fix = header_advice("ros/rose.h", 1)
    assert "no 'ros/rose.h'" in text
    assert "ros/ros.h" in fix


def test_a_header_of_nobody() -> None:
    text, fix = header_advice("my_other_package/thing.h", 1)
    assert "of no package of the workspace" in text
    assert "my_other_package" in fix


def test_a_package_of_the_other_ros_is_named_so() -> None:
    text, _ = package_advice("rclcpp", 1)
    assert "is a package of ROS 2" in text


def test_a_refused_package_says_why() -> None:
    text, _ = package_advice("rviz_common", 2)
    assert "RViz" in text


@pytest.mark.parametrize("part", ["filesystem", "program_options"])
def test_a_library_of_boost_that_is_not_there(part: str) -> None:
    text, fix = library_advice(["main", f"boost::{part}::detail::status(int)"])
    assert part in text
    assert fix == f"apt install libboost-{part.replace('_', '-')}-dev"
    assert library_advice(["ros::nowhere()"]) == ("", "")
