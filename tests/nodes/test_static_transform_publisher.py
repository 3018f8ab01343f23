"""The command line of static_transform_publisher."""

from __future__ import annotations

import math

import pytest

from gazelle.errors import LaunchError
from gazelle.nodes.static_transform_publisher import parse_arguments


def test_yaw_comes_before_pitch_and_roll() -> None:
    words = ["1", "2", "3", "1.5707963", "0", "0", "map", "odom", "100"]
    found = parse_arguments(words, with_period=True)
    assert found.T_parent_child.position_m == (1.0, 2.0, 3.0)
    assert found.T_parent_child.rpy_rad == pytest.approx((0.0, 0.0, math.pi / 2), abs=1e-6)
    assert (found.frame_id, found.child_frame_id, found.period_ms) == ("map", "odom", 100.0)


def test_quaternion_form_takes_one_number_more() -> None:
    found = parse_arguments(["0", "0", "0", "0", "0", "1", "0", "a", "b"], with_period=False)
    assert found.T_parent_child.quat_xyzw == (0.0, 0.0, 1.0, 0.0)


def test_wrong_count_shows_the_usage() -> None:
    with pytest.raises(LaunchError, match=r"got 3 arguments\nusage: static_transform_publisher x"):
        parse_arguments(["1", "2", "3"], with_period=True)


def test_word_in_place_of_a_number_is_named() -> None:
    with pytest.raises(LaunchError, match="could not convert string to float: 'x'"):
        parse_arguments(["x", "2", "3", "0", "0", "0", "a", "b", "100"], with_period=True)


def test_period_given_to_tf2_is_told_with_what_the_original_makes_of_it() -> None:
    words = ["0", "0", "0", "0", "0", "0", "laser", "camera", "100"]
    with pytest.raises(LaunchError, match=r"takes no period: leave out '100'.*'camera' -> '100'"):
        parse_arguments(words, with_period=False)
