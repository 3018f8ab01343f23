"""Slips of the finger, and names of one family."""

from __future__ import annotations

import pytest

from gazelle.doctor.packages.dependency_checks import is_slip


@pytest.mark.parametrize(
    ("name", "other"),
    [
        ("gazebo_rs", "gazebo_ros"),
        ("gazebo_rso", "gazebo_ros"),
        ("std_msg", "std_msgs"),
        ("turtlebot3_descriptin", "turtlebot3_description"),
        ("nav2_brinup", "nav2_bringup"),
    ],
)
def test_letter_that_is_missing_or_in_the_wrong_place_is_a_slip(name: str, other: str) -> None:
    assert is_slip(name, other)


@pytest.mark.parametrize(
    ("name", "other"),
    [
        ("ros_control", "ros2_control"),
        ("turtlebot3_msgs", "turtlebot4_msgs"),
        ("dwb_local_planner", "dwa_local_planner"),
        ("clearpath_viz", "clearpath_gz"),
        ("nav_msgs", "std_msgs"),
    ],
)
def test_other_number_or_other_short_word_is_another_package(name: str, other: str) -> None:
    assert not is_slip(name, other)
