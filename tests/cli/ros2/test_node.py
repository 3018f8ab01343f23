"""ros2 node."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from gazelle.graph import Graph, Node
from gazelle.graph.actions import ActionServer

_FIBONACCI = "example_interfaces/action/Fibonacci"


@pytest.fixture
def server(robot: Node) -> Iterator[ActionServer]:
    one = ActionServer(
        robot,
        "fibonacci",
        _FIBONACCI,
        on_goal=lambda goal: goal.reject(),
        on_cancel=lambda _: False,
        ros_version=2,
    )
    yield one
    one.close()


def test_list(graph: Graph, robot: Node, run: Any) -> None:
    graph.create_node("hidden", namespace="/_x", rosout=False)
    assert run("ros2", "node", "list") == (0, "/robot\n", "")
    assert run("ros2", "node", "list", "-a").out == "/_x/hidden\n/robot\n"
    assert run("ros2", "node", "list", "-c").out == "1\n"


def test_info_has_six_blocks(robot: Node, server: ActionServer, run: Any) -> None:
    robot.create_publisher("/scan", "sensor_msgs/msg/LaserScan")
    robot.create_subscription("/cmd_vel", "geometry_msgs/msg/Twist", lambda _: None)
    text = (
        "/robot\n"
        "  Subscribers:\n    /cmd_vel: geometry_msgs/msg/Twist\n"
        "  Publishers:\n    /scan: sensor_msgs/msg/LaserScan\n"
        "  Service Servers:\n\n"
        "  Service Clients:\n\n"
        f"  Action Servers:\n    /fibonacci: {_FIBONACCI}\n"
        "  Action Clients:\n\n"
    )
    assert run("ros2", "node", "info", "/robot") == (0, text, "")
    hidden = run("ros2", "node", "info", "/robot", "--include-hidden").out
    assert f"    /fibonacci/_action/send_goal: {_FIBONACCI}_SendGoal\n" in hidden


def test_info_of_an_unknown_node_names_the_nearest(robot: Node, run: Any) -> None:
    code, out, error = run("ros2", "node", "info", "robot")
    assert (code, out) == (1, "")
    assert error == "Unable to find node 'robot'\n  did you mean '/robot'?\n"
