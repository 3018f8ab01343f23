"""The command line of static_transform_publisher."""

from __future__ import annotations

import math
import threading
from typing import Any

import pytest

from gazelle.errors import LaunchError
from gazelle.nodes.host import run_node
from gazelle.nodes.static_transform_publisher import parse_arguments, parse_options


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


def test_options_of_ros2_may_be_left_out() -> None:
    words = ["--x", "1.5", "--yaw", "1.5707963", "--frame-id", "a", "--child-frame-id", "b"]
    found = parse_options(words)
    assert found.T_parent_child.position_m == (1.5, 0.0, 0.0)
    assert found.T_parent_child.rpy_rad == pytest.approx((0.0, 0.0, math.pi / 2), abs=1e-6)
    assert (found.frame_id, found.child_frame_id) == ("a", "b")
    turned = parse_options(["--qz", "1", "--qw", "0", *words[4:]])
    assert turned.T_parent_child.quat_xyzw == (0.0, 0.0, 1.0, 0.0)


def test_options_of_ros2_are_checked() -> None:
    frames = ["--frame-id", "a", "--child-frame-id", "b"]
    with pytest.raises(LaunchError, match="required: --child-frame-id"):
        parse_options(frames[:2])
    with pytest.raises(LaunchError, match="a quaternion or roll, pitch and yaw, not both"):
        parse_options([*frames, "--qz", "1", "--yaw", "1"])
    with pytest.raises(LaunchError, match="argument --x: invalid float value: 'one'"):
        parse_options([*frames, "--x", "one"])


def test_a_frame_cannot_lie_in_itself(bench: Any) -> None:
    words = ["--frame-id", "base", "--child-frame-id", "base", "--ros-args"]
    node = {"node": "tf2_ros/static_transform_publisher", "argv": words}
    text = "cannot publish static transform from 'base' to 'base', exiting"
    with pytest.raises(LaunchError, match=text):
        run_node(node, bench.graph, threading.Event())


def test_unnamed_ones_of_ros2_live_side_by_side(bench: Any) -> None:
    got = bench.listen("/tf_static", "tf2_msgs/msg/TFMessage")
    for child in ("left", "right"):
        words = ["--frame-id", "base", "--child-frame-id", child, "--ros-args"]
        bench.start("tf2_ros/static_transform_publisher", *words)
    bench.eventually(lambda: len(got) == 2)
    assert {one.transforms[0].child_frame_id for one in got} == {"left", "right"}
    names = [one for one in bench.graph.node_names() if "static_transform_publisher_" in one]
    assert len(names) == 2
    assert bench.stop() == [0, 0]
