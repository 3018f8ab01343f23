"""ros2 doctor and ros2 wtf."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from gazelle.graph import Node


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("AMENT_PREFIX_PATH", "ROS_DISTRO", "ROS_PACKAGE_PATH", "GAZEBO_MODEL_PATH"):
        monkeypatch.delenv(name, raising=False)


def test_lonely_topics_are_warned_of(robot: Node, run: Any) -> None:
    robot.create_publisher("/scan", "sensor_msgs/msg/LaserScan")
    robot.create_subscription("/cmd_vel", "geometry_msgs/msg/Twist", lambda _: None)
    code, out, error = run("ros2", "doctor")
    assert (code, out) == (0, "\nAll 4 checks passed\n\n")
    assert "topic: UserWarning: Publisher without subscriber detected on /scan.\n" in error
    assert "topic: UserWarning: Subscriber without publisher detected on /cmd_vel.\n" in error
    out = run("ros2", "wtf", "--include-warnings", "--exclude-packages").out
    assert out == "\n1/3 check(s) failed\n\nFailed modules: topic\n"


def test_two_types_of_a_topic_fail(robot: Node, run: Any) -> None:
    robot.create_publisher("/n", "std_msgs/msg/Int32")
    robot.create_subscription("/n", "std_msgs/msg/String", lambda _: None)
    code, out, error = run("ros2", "doctor", "-rf")
    assert code == 0
    assert out == (
        "\n1/4 check(s) failed\n\nFailed modules: topic\n\n   TOPIC LIST\n"
        "topic               : /n\npublisher count     : 1\nsubscriber count    : 1\n"
    )
    assert "ERROR: Topic /n has several types: std_msgs/msg/Int32, std_msgs/msg/String" in error


def test_report_has_its_sections(robot: Node, run: Any) -> None:
    out = run("ros2", "doctor", "--report").out
    heads = [line.strip() for line in out.splitlines() if line.startswith("   ")]
    assert heads == [
        "NETWORK CONFIGURATION",
        "PACKAGE VERSIONS",
        "PLATFORM INFORMATION",
        "RMW MIDDLEWARE",
        "ROS 2 INFORMATION",
        "TOPIC LIST",
    ]
    assert f"graph's port     : {robot.graph.port}\n" in out
    assert "PACKAGE VERSIONS" not in run("ros2", "doctor", "-r", "-ep").out


def test_missing_graph_is_a_warning(port: int, run: Any) -> None:
    code, out, error = run("ros2", "doctor", "-iw", "-ep")
    assert code == 0
    assert out.endswith("Failed modules: network\n")
    assert f"network: UserWarning: no graph is running on port {port}\n" in error


def test_hello_has_nothing_to_try(port: int, run: Any) -> None:
    code, out, error = run("ros2", "doctor", "hello")
    assert (code, out) == (0, "")
    assert error.startswith("hello: ")
