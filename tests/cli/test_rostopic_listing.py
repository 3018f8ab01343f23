"""rostopic list, info, type and find."""

from __future__ import annotations

import re
from typing import Any

import pytest

from gazelle.graph import Graph, Node


def _like_ros_live(graph: Graph) -> None:
    """The topics of the recording; what listens only is of any type."""
    publisher = graph.create_node("joint_state_publisher")
    state = graph.create_node("robot_state_publisher")
    rosout = graph.create_node("rosout", rosout=False)
    rosout.create_publisher("/rosout_agg", "rcl_interfaces/msg/Log")
    rosout.create_subscription("/rosout", "rcl_interfaces/msg/Log", print)
    publisher.create_publisher("/joint_states", "sensor_msgs/JointState")
    state.create_publisher("/tf", "tf2_msgs/TFMessage")
    state.create_publisher("/tf_static", "tf2_msgs/TFMessage")
    state.create_subscription("/joint_states", "sensor_msgs/JointState", print)


def test_verbose_list_is_that_of_ros(graph, run, recorded) -> None:
    _like_ros_live(graph)
    real = recorded("topic_list")
    ours = run("rostopic", "list", "-v")
    # The master lists topics in the order they came; we sort them.
    assert sorted(ours.out.splitlines()) == sorted(real.out.splitlines())
    assert ours.out.splitlines()[:2] == real.out.splitlines()[:2] == ["", "Published topics:"]
    assert ours.out.endswith(" 1 subscriber\n\n")
    assert ours.code == real.code


def test_list_sorts_names_and_filters_by_namespace(robot: Node, run) -> None:
    robot.create_publisher("/b/two", "std_msgs/String")
    robot.create_publisher("/a", "std_msgs/String")
    robot.create_subscription("/b/one", "std_msgs/String", print)
    robot.create_subscription("/bb", None, print)
    assert run("rostopic", "list").out == "/a\n/b/one\n/b/two\n/bb\n"
    assert run("rostopic", "list", "/b").out == "/b/one\n/b/two\n"
    assert run("rostopic", "list", "-p").out == "/a\n/b/two\n"
    assert run("rostopic", "list", "-s").out == "/b/one\n/bb\n"
    assert run("rostopic", "list", "-v", "-s", "bb").out == (
        "\n\nSubscribed topics:\n * /bb [*] 1 subscriber\n\n".removeprefix("\n")
    )


def test_list_by_host_groups_all_topics(robot: Node, run) -> None:
    robot.create_publisher("/a", "std_msgs/String")
    lines = run("rostopic", "list", "--host").out.splitlines()
    assert re.fullmatch(r"Host \[.+\]:", lines[0])
    assert lines[1:] == ["  /a"]


def test_relative_names_start_at_the_namespace(robot: Node, run, monkeypatch) -> None:
    robot.create_publisher("/arm/joint", "std_msgs/String")
    monkeypatch.setenv("ROS_NAMESPACE", "/arm")
    assert run("rostopic", "type", "joint").out == "std_msgs/String\n"


def test_wrong_options_end_with_2(graph, run) -> None:
    both = run("rostopic", "list", "-p", "-s")
    assert (both.code, both.err.splitlines()[-1]) == (
        2,
        "rostopic: error: you may only specify one of -p, -s",
    )


def test_info_is_that_of_ros(graph, run, recorded) -> None:
    _like_ros_live(graph)
    real = recorded("topic_info").out
    ours = run("rostopic", "info", "joint_states").out
    assert re.sub(r"\(.*\)", "(URI)", ours) == re.sub(r"\(.*\)", "(URI)", real)


def test_unknown_topic_names_what_is_near(robot: Node, run) -> None:
    robot.create_publisher("/scan", "sensor_msgs/LaserScan")
    found = run("rostopic", "info", "/scn")
    assert (found.code, found.out) == (1, "")
    assert found.err == "ERROR: Unknown topic /scn\n  did you mean '/scan'?\n"
    assert run("rostopic", "type", "/scn").err == (
        "unknown topic type [/scn]\n  did you mean '/scan'?\n"
    )


def test_type_of_a_field_is_shown(robot: Node, run) -> None:
    robot.create_publisher("/odom", "nav_msgs/Odometry")
    assert run("rostopic", "type", "/odom").out == "nav_msgs/Odometry\n"
    assert run("rostopic", "type", "/odom/pose/covariance").out == (
        "nav_msgs/Odometry pose/covariance float64[36]\n"
    )


def test_rosout_has_the_type_of_ros1(graph: Graph, run) -> None:
    graph.create_node("talker")
    assert run("rostopic", "type", "/rosout").out == "rosgraph_msgs/Log\n"
    assert run("rostopic", "find", "rosgraph_msgs/Log").out == "/rosout\n"


def test_without_a_graph_the_master_is_missing(port, run) -> None:
    for tool, *words in (
        ("rostopic", "list"),
        ("rosnode", "list"),
        ("rosservice", "list"),
        ("rosparam", "list"),
        ("tf_echo", "a", "b"),
    ):
        found = run(tool, *words)
        assert found.code == 1
        assert found.err.splitlines()[0] == "ERROR: Unable to communicate with master!"
        assert "fix: start a launch" in found.err


def test_without_a_command_the_usage_is_printed(run) -> None:
    found = run("rostopic")
    assert found.code == 64
    assert "\trostopic bw\tdisplay bandwidth used by topic\n" in found.out
    assert run("rostopic", "lst").err == "rostopic: no command 'lst'; did you mean 'list'?\n"


@pytest.mark.parametrize(
    ("words", "shown"),
    [
        (("rostopic", "list"), "/a\n"),
        (("rosnode", "list"), "/robot\n"),
        (("rosservice", "list"), ""),
        (("ros2", "topic", "list"), "/a\n"),
        (("ros2", "node", "list"), "/robot\n"),
        (("ros2", "service", "list"), ""),
    ],
    ids=" ".join,
)
def test_tokens_that_no_program_writes_are_listed_by_nobody(
    graph: Graph, robot: Node, run: Any, words: tuple[str, ...], shown: str
) -> None:
    robot.create_publisher("/a", "std_msgs/String")
    tokens = [
        graph.session.liveliness().declare_token(f"@ros2_lv/{graph.domain}/z/{number}/0/NN/%/%/n")
        for number in ("²", "9" * 5_000)
    ]
    assert run(*words) == (0, shown, "")
    for one in tokens:
        one.undeclare()
