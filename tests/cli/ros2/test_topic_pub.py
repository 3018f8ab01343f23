"""ros2 topic pub."""

from __future__ import annotations

import io
import threading
from typing import Any

import pytest

from gazelle.cli.ros2.topic import pub
from gazelle.graph import Node

TWIST = "geometry_msgs/msg/Twist"


class Ear:
    """Hears a topic."""

    def __init__(self, robot: Node, topic: str, kind: str) -> None:
        self.heard: list[Any] = []
        self._changed = threading.Condition()
        robot.create_subscription(topic, kind, self)

    def __call__(self, message: Any) -> None:
        with self._changed:
            self.heard.append(message)
            self._changed.notify_all()

    def wait(self, count: int = 1) -> list[Any]:
        with self._changed:
            assert self._changed.wait_for(lambda: len(self.heard) >= count, 10.0)
            return list(self.heard)


def test_once(robot: Node, run: Any) -> None:
    ear = Ear(robot, "/cmd_vel", TWIST)
    words = ("-1", "/cmd_vel", "geometry_msgs/Twist", "{linear: {x: 0.5}}")
    code, out, error = run("ros2", "topic", "pub", *words)
    assert (code, error) == (0, "")
    assert out.removeprefix("Waiting for at least 1 matching subscription(s)...\n") == (
        "publisher: beginning loop\npublishing #1: geometry_msgs.msg.Twist(linear="
        "geometry_msgs.msg.Vector3(x=0.5, y=0.0, z=0.0), angular=geometry_msgs.msg.Vector3("
        "x=0.0, y=0.0, z=0.0))\n\n"
    )
    assert [one.linear.x for one in ear.wait()] == [0.5]


def test_times_rate_and_which_are_printed(robot: Node, run: Any) -> None:
    ear = Ear(robot, "/n", "std_msgs/msg/Int32")
    words = ("-t", "5", "-r", "200", "-p", "2", "/n", "std_msgs/msg/Int32", "data: 3")
    out = run("ros2", "topic", "pub", *words).out
    assert [line.partition(":")[0] for line in out.splitlines() if "#" in line] == [
        "publishing #2",
        "publishing #4",
    ]
    assert len(ear.wait(5)) == 5


def test_every_header_gets_its_own_time(robot: Node, run: Any) -> None:
    ear = Ear(robot, "/joints", "sensor_msgs/msg/JointState")
    kind = "sensor_msgs/msg/JointState"
    run("ros2", "topic", "pub", "-t", "2", "-r", "100", "/joints", kind, "{header: auto}")
    first, second = (one.header.stamp for one in ear.wait(2))
    assert (second.sec, second.nanosec) > (first.sec, first.nanosec) > (0, 0)


def test_values_from_standard_input(robot: Node, run: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    ear = Ear(robot, "/n", "std_msgs/msg/Int32")
    monkeypatch.setattr("sys.stdin", io.StringIO("data: 9\n"))
    assert run("ros2", "topic", "pub", "-1", "--stdin", "/n", "std_msgs/msg/Int32").code == 0
    assert ear.wait()[0].data == 9


def test_goes_on_until_its_end(robot: Node, run_until: Any) -> None:
    out = run_until("#2", "ros2", "topic", "pub", "-r", "50", "/n", "std_msgs/msg/Empty")
    assert "publishing #1: std_msgs.msg.Empty()\n\n" in out


def test_latched_for_those_who_come_later(robot: Node, run: Any, end_commands: Any) -> None:
    heard: list[int] = []

    def come_later() -> None:
        ear = Ear(robot, "/n", "std_msgs/msg/Int32")
        heard.extend(one.data for one in ear.wait())
        end_commands()

    words = ("--qos-durability", "transient_local", "-1", "-w", "0", "--keep-alive", "20")
    later = threading.Timer(0.3, come_later)
    later.start()
    assert run("ros2", "topic", "pub", *words, "/n", "std_msgs/msg/Int32", "data: 4").code == 0
    later.join()
    assert heard == [4]


def test_once_waits_without_a_limit_and_publishes_nothing(
    robot: Node, run_until: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pub, "_LOOK_S", 0.01)
    waiting = "Waiting for at least 1 matching subscription(s)...\n"
    out = run_until(waiting * 5, "ros2", "topic", "pub", "-1", "/n", "std_msgs/msg/Empty")
    assert out.replace(waiting, "") == ""


def test_waiting_has_a_limit(robot: Node, run: Any) -> None:
    words = ("--max-wait-time-secs", "0.05", "/n", "std_msgs/msg/Int32")
    code, out, error = run("ros2", "topic", "pub", "-1", *words)
    assert code == 1
    assert out == "Waiting for at least 1 matching subscription(s)...\n"
    assert error == (
        "Timed out waiting for subscribers: Expected 1 subcribers but only got 0 subscribers\n"
    )
    assert "is only effective with" in run("ros2", "topic", "pub", *words).err


@pytest.mark.parametrize(
    ("kind", "values", "words"),
    [
        ("geometry_msgs/Twits", "{}", "The passed message type is invalid"),
        (TWIST, "{linera: {}}", "Failed to populate field: "),
        (TWIST, "linear:{}", "The passed value needs to be a dictionary in YAML format"),
    ],
)
def test_what_is_wrong_is_told_before_anybody_is_waited_for(
    robot: Node, run: Any, kind: str, values: str, words: str
) -> None:
    code, out, error = run("ros2", "topic", "pub", "-1", "/cmd_vel", kind, values)
    assert (code, out) == (1, "")
    assert error.startswith(words)


def test_other_type_than_the_topics_is_told(robot: Node, run: Any) -> None:
    robot.create_subscription("/cmd_vel", TWIST, lambda _: None)
    error = run("ros2", "topic", "pub", "-1", "-w", "0", "/cmd_vel", "std_msgs/msg/Empty").err
    assert error.startswith(f"WARNING: /cmd_vel has type {TWIST}, you publish std_msgs/msg/Empty")


def test_wrong_usage_ends_with_2(port: int, run: Any) -> None:
    assert run("ros2", "topic", "pub", "-1", "-t", "2", "/n", "std_msgs/msg/Empty").code == 2
    assert "Value must be positive" in run("ros2", "topic", "pub", "-r", "0", "/n", "a/B").err
