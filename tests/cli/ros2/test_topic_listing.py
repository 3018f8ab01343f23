"""ros2 topic list, type, find and info."""

from __future__ import annotations

from typing import Any

import pytest

from gazelle.graph import Graph, Node, Qos

TWIST = "geometry_msgs/msg/Twist"


@pytest.fixture(autouse=True)
def _topics(robot: Node) -> None:
    robot.create_publisher("/scan", "sensor_msgs/msg/LaserScan", reliable=False, queue_size=5)
    robot.create_publisher("/map", "nav_msgs/msg/OccupancyGrid", latch=True, queue_size=1)
    robot.create_subscription("/cmd_vel", TWIST, lambda _: None)
    robot.create_subscription("/cmd_vel", TWIST, lambda _: None)
    robot.create_publisher("/_secret", "std_msgs/msg/String")


def test_list(run: Any) -> None:
    assert run("ros2", "topic", "list") == (0, "/cmd_vel\n/map\n/scan\n", "")
    assert run("ros2", "topic", "list", "-c").out == "3\n"
    assert run("ros2", "topic", "list", "-t").out.splitlines()[0] == f"/cmd_vel [{TWIST}]"
    hidden = "/_secret\n/cmd_vel\n/map\n/scan\n"
    assert run("ros2", "topic", "list", "--include-hidden-topics").out == hidden
    assert run("ros2", "topic", "--include-hidden-topics", "list").out == hidden


def test_list_of_details(run: Any) -> None:
    assert run("ros2", "topic", "list", "-v").out == (
        "Published topics:\n * /map [nav_msgs/msg/OccupancyGrid] 1 publisher\n"
        " * /scan [sensor_msgs/msg/LaserScan] 1 publisher\n\n"
        f"Subscribed topics:\n * /cmd_vel [{TWIST}] 2 subscribers\n\n"
    )


def test_all_types_of_a_topic_are_told(robot: Node, run: Any) -> None:
    robot.create_publisher("/cmd_vel", "std_msgs/msg/String")
    assert run("ros2", "topic", "type", "/cmd_vel").out == f"{TWIST}\nstd_msgs/msg/String\n"
    code, _, error = run("ros2", "topic", "echo", "/cmd_vel")
    assert code == 1
    assert error == (
        "Cannot echo topic '/cmd_vel', as it contains more than one type: "
        f"[{TWIST}, std_msgs/msg/String]\n"
    )


def test_type_and_find(run: Any) -> None:
    assert run("ros2", "topic", "type", "/cmd_vel") == (0, f"{TWIST}\n", "")
    code, out, error = run("ros2", "topic", "type", "cmd_vel")
    assert (code, out) == (1, "")
    assert error == "there is no topic 'cmd_vel'; did you mean '/cmd_vel'?\n"
    assert run("ros2", "topic", "find", TWIST) == (0, "/cmd_vel\n", "")
    assert run("ros2", "topic", "find", "-c", TWIST).out == "1\n"
    assert "the full name is 'geometry_msgs/msg/Twist'" in (
        run("ros2", "topic", "find", "geometry_msgs/Twist").err
    )


def test_info(run: Any) -> None:
    assert run("ros2", "topic", "info", "/cmd_vel") == (
        0,
        f"Type: {TWIST}\nPublisher count: 0\nSubscription count: 2\n",
        "",
    )
    code, out, error = run("ros2", "topic", "info", "/cmd_ve")
    assert (code, out) == (1, "")
    assert error == "Unknown topic '/cmd_ve'\n  did you mean '/cmd_vel'?\n"


def test_info_shows_the_quality_of_service(robot: Node, run: Any) -> None:
    text = run("ros2", "topic", "info", "-v", "/scan").out
    head, _, rest = text.partition("Topic type hash: ")
    assert head == (
        "Type: sensor_msgs/msg/LaserScan\n\nPublisher count: 1\n\n"
        "Node name: robot\nNode namespace: /\nTopic type: sensor_msgs/msg/LaserScan\n"
    )
    assert rest.startswith("RIHS01_")
    assert rest.partition("QoS profile:\n")[2] == (
        "  Reliability: BEST_EFFORT\n  History (Depth): KEEP_LAST (5)\n  Durability: VOLATILE\n"
        "  Lifespan: Infinite\n  Deadline: Infinite\n  Liveliness: AUTOMATIC\n"
        "  Liveliness lease duration: Infinite\n\nSubscription count: 0\n\n"
    )
    assert "Durability: TRANSIENT_LOCAL" in run("ros2", "topic", "info", "-v", "/map").out
    wanted = Qos(False, True, 0, 1_500_000_000, 2_000_000, True, 3)
    robot.create_subscription("/map", "nav_msgs/msg/OccupancyGrid", print, qos=wanted)
    text = run("ros2", "topic", "info", "-v", "/map").out.rpartition("QoS profile:\n")[2]
    assert text.splitlines()[:7] == [
        "  Reliability: BEST_EFFORT",
        "  History (Depth): KEEP_ALL",
        "  Durability: TRANSIENT_LOCAL",
        "  Lifespan: 2000000 nanoseconds",
        "  Deadline: 1500000000 nanoseconds",
        "  Liveliness: MANUAL_BY_TOPIC",
        "  Liveliness lease duration: 3 nanoseconds",
    ]


def test_commands_do_not_show_themselves(
    graph: Graph, run: Any, when_heard: Any, end_commands: Any
) -> None:
    names: set[str] = set()

    def look() -> None:
        names.update(graph.node_names())
        end_commands()

    when_heard("/map", look)
    assert run("ros2", "topic", "echo", "/map").code == 0
    assert names == {"/robot"}


def test_without_a_graph_the_list_is_empty_and_says_why(
    graph: Graph, run: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    graph.close()
    code, out, error = run("ros2", "topic", "list")
    assert (code, out) == (0, "")
    assert error.startswith("no graph is running on port ")


def test_illegal_names_are_told(run: Any) -> None:
    code, _, error = run("ros2", "topic", "echo", "cmd-vel")
    assert code == 1
    assert error.startswith("illegal topic or service name '/cmd-vel': Character [-]")
