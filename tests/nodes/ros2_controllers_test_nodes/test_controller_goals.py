"""Nodes of ros2_controllers_test_nodes: goals in turn, and what is wrong with them."""

from __future__ import annotations

import threading
from types import SimpleNamespace
from typing import Any

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.errors import LaunchError
from gazelle.interfaces import message_type
from gazelle.nodes.host import run_node
from gazelle.nodes.ros2_controllers_test_nodes.joint_trajectory import PARAMETERS, StartingPoint
from gazelle.nodes.ros2_controllers_test_nodes.parameters import reader_of

_CLOCK: Any = message_type("rosgraph_msgs/msg/Clock")
_STATE: Any = message_type("sensor_msgs/msg/JointState")


def _words(node: str, **values: Any) -> list[str]:
    given = {"use_sim_time": "true", "wait_sec_between_publish": "2", **values}
    words = [word for name, value in given.items() for word in ("-p", f"{name}:={value}")]
    return ["--ros-args", "-r", f"__node:={node}", *words]


class _Time:
    """Simulated time that a test moves."""

    def __init__(self, bench: Any) -> None:
        self._bench = bench
        self._out = bench.node.create_publisher("/clock", _CLOCK)
        self._seconds = 1

    def until(self, condition: Any) -> Any:
        """Let seconds pass until a condition holds."""

        def look() -> Any:
            message = _CLOCK()
            message.clock.sec = self._seconds
            self._out.publish(message)
            self._seconds += 1
            return condition()

        return self._bench.eventually(look)


def _log(bench: Any) -> list[Any]:
    found: list[Any] = bench.listen("/rosout", "rcl_interfaces/msg/Log")
    return found


def _said(log: list[Any]) -> str:
    return "\n".join(one.msg for one in log)


@pytest.mark.parametrize("package", ["ros2_controllers_test_nodes", "ros2_control_test_nodes"])
def test_lists_are_published_in_turn_and_again(bench: Any, package: str) -> None:
    got, log = bench.listen("/commands", "std_msgs/msg/Float64MultiArray"), _log(bench)
    bench.start(
        f"{package}/publisher_forward_position_controller",
        *_words("goals", publish_topic="/commands", goal_names="[up, down]", up="[0.5, 1]",
                down="[-0.5, 0.0]"),
    )  # fmt: skip
    _Time(bench).until(lambda: len(got) >= 3)
    assert [list(one.data) for one in got[:3]] == [[0.5, 1.0], [-0.5, 0.0], [0.5, 1.0]]
    bench.eventually(lambda: "Publishing: \"array('d', [0.5, 1.0])\"" in _said(log))
    assert 'Publishing 2 goals on topic "/commands" every 2 s' in _said(log)


def test_trajectories_are_published_in_turn(bench: Any) -> None:
    got = bench.listen("/arm/joint_trajectory", "trajectory_msgs/msg/JointTrajectory")
    log = _log(bench)
    bench.start(
        "ros2_controllers_test_nodes/publisher_joint_trajectory_controller",
        *_words("goals", controller_name="arm", joints="[a, b]", goal_names="[up, odd, down]",
                **{"up.positions": "[0.5, 1]", "odd.positions": "[0.5]",
                   "down.positions": "[0.0, 0.0]", "down.velocities": "[0.1, 0.2]"}),
    )  # fmt: skip
    _Time(bench).until(lambda: len(got) >= 3)
    up, down, again = got[:3]
    assert (list(up.joint_names), len(up.points)) == (["a", "b"], 1)
    assert (list(up.points[0].positions), list(up.points[0].velocities)) == ([0.5, 1.0], [])
    assert list(down.points[0].velocities) == [0.1, 0.2]
    assert up.points[0].time_from_start.sec == 4
    assert again == up
    bench.eventually(lambda: "Sending goal" in _said(log))
    assert 'Goal "odd" definition is wrong. This goal will not be used.' in _said(log)


def test_nothing_is_sent_from_a_starting_point_beyond_the_limits(bench: Any) -> None:
    got, log = bench.listen("/arm/joint_trajectory", None), _log(bench)
    bench.start(
        "ros2_controllers_test_nodes/publisher_joint_trajectory_controller",
        *_words("goals", controller_name="arm", joints="[a]", goal_names="[up]",
                check_starting_point="true",
                **{"up.positions": "[0.5]", "starting_point_limits.a": "[-0.1, 0.1]"}),
    )  # fmt: skip
    time = _Time(bench)
    time.until(lambda: "Start configuration could not be checked!" in _said(log))
    out = bench.node.create_publisher("/joint_states", _STATE)
    bench.eventually(lambda: out.matched)
    out.publish(_STATE(name=["a"], position=[0.2]))
    time.until(lambda: "Start configuration is not within configured limits!" in _said(log))
    assert "Starting point limits exceeded for joint a !" in _said(log)
    assert not got


def test_only_the_first_joint_state_is_looked_at() -> None:
    place = StartingPoint({"a": [-1, 1]})
    inside = SimpleNamespace(name=["other", "a"], position=[9.0, 0.5])
    outside = SimpleNamespace(name=["a"], position=[2.0])
    assert (place.take(inside), place.take(outside)) == ([], [])
    assert place.fits
    assert not StartingPoint({"a": [-1, 1]}).fits
    assert StartingPoint(None).fits


def test_a_bare_list_is_taken_as_positions_and_told(bench: Any) -> None:
    got = bench.listen("/arm/joint_trajectory", "trajectory_msgs/msg/JointTrajectory")
    log = _log(bench)
    bench.start(
        "ros2_controllers_test_nodes/publisher_joint_trajectory_controller",
        *_words("goals", controller_name="arm", joints="[a]", goal_names="[up]", up="[0.5]"),
    )
    _Time(bench).until(lambda: got)
    assert list(got[0].points[0].positions) == [0.5]
    bench.eventually(lambda: 'Goal "up" is defined as a list. This is deprecated.' in _said(log))


def test_a_node_without_a_usable_trajectory_ends(bench: Any) -> None:
    bench.start(
        "ros2_controllers_test_nodes/publisher_joint_trajectory_controller",
        *_words("goals", joints="[a, b]"),
    )
    assert bench.wait() == [1]


def test_goals_that_are_not_in_the_list_are_told(bench: Any) -> None:
    log = _log(bench)
    bench.start(
        "ros2_controllers_test_nodes/publisher_forward_position_controller",
        *_words("goals", goal_names="[pos1]", pos1="[0.5]", pos2="[1.0]"),
    )
    text = (
        "/goals: parameter 'pos2' is not one of publisher_forward_position_controller, nor among "
        "its goal_names; it has no effect"
    )
    bench.eventually(lambda: text in _said(log))


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({}, 'Values for goal "pos1" not set!'),
        ({"goal_names": "[up]", "up": "[a, b]"}, "parameter 'up' is ['a', 'b'], not a list"),
        (
            {"wait_sec_between_publish": "0.5"},
            "Trying to set parameter 'wait_sec_between_publish' to '0.5' of type 'DOUBLE', "
            "expecting type 'INTEGER'",
        ),
        ({"wait_sec_between_publish": "0"}, "must be greater than 0 s"),
        ({"goal_names": "[]"}, "'goal_names' is empty"),
    ],
)
def test_lists_that_are_wrong_end_the_node(bench: Any, given: dict[str, str], text: str) -> None:
    name = "ros2_controllers_test_nodes/publisher_forward_position_controller"
    with pytest.raises(LaunchError) as raised:
        run_node({"node": name, "argv": _words("goals", **given)}, bench.graph, threading.Event())
    assert text in str(raised.value)


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"a.positions": "[1.0]"}, '"joints" parameter is not set!'),
        (
            {"joints": "[j]", "check_starting_point": "true", "starting_point_limits.j": "[1.0]"},
            '"starting_point" parameter is not set correctly! starting_point_limits.j is [1.0]',
        ),
        ({"joints": "[j]", "pos1": "[]"}, 'Values for goal "pos1" not set!'),
    ],
)
def test_trajectories_that_are_wrong_end_the_node(
    bench: Any, given: dict[str, str], text: str
) -> None:
    name = "ros2_controllers_test_nodes/publisher_joint_trajectory_controller"
    with pytest.raises(LaunchError) as raised:
        run_node({"node": name, "argv": _words("goals", **given)}, bench.graph, threading.Event())
    assert text in str(raised.value)


def test_members_of_goals_and_joints_that_nobody_reads_are_found() -> None:
    found = Diagnostics()
    tree = {"up": {"positions": [1.0], "velocity": [1.0]}, "wait_sec": 3, "qos_overrides": {"x": 1},
            "starting_point_limits": {"j": [0.0, 1.0]}, "down": [0.0], "joints": ["j"]}  # fmt: skip
    reader_of(PARAMETERS, tree, "/goals", ["up", "down"], found).report_unknown()
    assert [item.message.split("'")[1] for item in found] == ["up.velocity", "wait_sec"]
    assert "up.velocities" in found.by_code("parameter.unknown")[0].fix


def test_ros2_param_sees_defaults(bench: Any) -> None:
    bench.start(
        "ros2_controllers_test_nodes/publisher_forward_position_controller",
        *_words("goals", goal_names="[a]", a="[0.5]"),
    )
    answer = bench.call(
        "/goals/get_parameters", "rcl_interfaces/srv/GetParameters", names=["publish_topic"]
    )
    assert answer.values[0].string_value == "/position_commands"
