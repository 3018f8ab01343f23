"""tf_echo."""

from __future__ import annotations

import re
import threading
from typing import Any

from gazelle.cli.tf_echo import run as run_node
from gazelle.geometry import Pose
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import read_arguments

_STAMP = (1795226385, 509_000_000)


def _transforms(child: str = "laser_tip") -> Any:
    message = message_type("tf2_msgs/TFMessage")()
    one = message_type("geometry_msgs/TransformStamped")()
    one.header.frame_id, one.child_frame_id = "base_link", child
    one.header.stamp.sec, one.header.stamp.nanosec = _STAMP
    pose = Pose.from_xyz_rpy((0.25, 0.0, 0.15), (0.1, 0.2, 0.3))
    move, turn = one.transform.translation, one.transform.rotation
    move.x, move.y, move.z = pose.position_m
    turn.x, turn.y, turn.z, turn.w = pose.quat_xyzw
    message.transforms = [one]
    return message


def test_output_is_that_of_ros(robot: Node, run_until, recorded) -> None:
    robot.create_publisher("/tf", "tf2_msgs/TFMessage", latch=True).publish(_transforms())
    out = run_until("degree", "tf_echo", "base_link", "/laser_tip", "100")
    block = "".join(recorded("tf_echo").out.splitlines(keepends=True)[:5])
    assert out.startswith(block)


def test_tf2_echo_of_ros2_shows_the_matrix_too(robot: Node, run_until) -> None:
    robot.create_publisher("/tf", "tf2_msgs/TFMessage", latch=True).publish(_transforms())
    out = run_until("0.000  1.000", "tf_echo", "--tf2", "base_link", "laser_tip", "100")
    assert out.splitlines()[:10] == [
        "At time 1795226385.509000000",
        "- Translation: [0.250, 0.000, 0.150]",
        "- Rotation: in Quaternion [0.034, 0.106, 0.144, 0.983]",
        "- Rotation: in RPY (radian) [0.100, 0.200, 0.300]",
        "- Rotation: in RPY (degree) [5.730, 11.459, 17.189]",
        "- Matrix:",
        "  0.936 -0.275  0.218  0.250",
        "  0.290  0.956 -0.037  0.000",
        " -0.199  0.098  0.975  0.150",
        "  0.000  0.000  0.000  1.000",
    ]


def test_precision_is_a_parameter(robot: Node, run_until) -> None:
    robot.create_publisher("/tf", "tf2_msgs/TFMessage", latch=True).publish(_transforms())
    words = ["base_link", "laser_tip", "_precision:=1", "_rate:=100"]
    out = run_until("degree", "tf_echo", *words)
    assert out.startswith("At time 1795226385.5\n- Translation: [0.2, 0.0, 0.1]\n")


def test_failure_names_the_frames_there_are(robot: Node, run_until) -> None:
    robot.create_publisher("/tf", "tf2_msgs/TFMessage", latch=True).publish(_transforms())
    out = run_until("current list", "tf_echo", "base_link", "laser_tp", "100")
    assert re.match(r"Failure at \d+\.\d{9}\nException thrown:\"laser_tp\" passed to", out)
    assert "Did you mean laser_tip?" in out
    assert "The current list of frames is:\nFrame laser_tip exists with parent base_link.\n" in out


def test_wrong_arguments_print_the_usage(graph, run) -> None:
    found = run("tf_echo", "only_one")
    assert found.code == 255
    assert found.err.startswith("Usage: tf_echo source_frame target_frame [echo_rate]\n")
    assert run("tf_echo", "a", "b", "0").err == "Echo rate must be > 0.0\n"
    assert run("tf_echo", "a", "b", "fast").err == "Echo rate and precision must be numbers\n"


def test_it_runs_as_a_built_in_node(graph: Graph, robot: Node, capsys) -> None:
    robot.create_publisher("/tf", "tf2_msgs/TFMessage", latch=True).publish(_transforms())
    stop = threading.Event()
    stop.set()
    arguments = read_arguments(["base_link", "laser_tip"], "tf_echo")
    assert run_node(arguments, graph, stop) == 0
    assert run_node(read_arguments(["base_link"], "tf_echo"), graph, stop) == 255
    assert "Usage: tf_echo" in capsys.readouterr().err
