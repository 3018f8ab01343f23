"""``rosbag record -a``, ``info``, ``play``, ``play -r 2`` and a subset, as typed (T4)."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.bag import open_bag
from gazelle.graph import Graph

pytestmark = pytest.mark.tutorial

_PERIOD_S = 0.02


@pytest.fixture
def graph(free_port: int) -> Any:
    """The graph that the commands join."""
    with Graph.open(port=free_port, environ={}) as graph:
        yield graph


@pytest.fixture
def recorded(gazelle: Callable, graph: Graph, tmp_path: Path) -> Path:
    """A second of a turtle's topics, recorded with ``rosbag record -a``."""
    talker = graph.create_node("turtlesim")
    pose = talker.create_publisher("/turtle1/pose", "geometry_msgs/msg/Pose2D")
    command = talker.create_publisher("/turtle1/cmd_vel", "geometry_msgs/msg/Twist")
    latched = talker.create_publisher("/map_name", "std_msgs/msg/String", latch=True)
    latched.publish(latched.message_class(data="here"))
    run = gazelle("rosbag", "record", "-a", "-O", "turtle", "-x", "/rosout.*")
    run.wait_for_line("Recording to 'turtle.bag'.")
    run.eventually(lambda: pose.matched and command.matched)
    clock_s, count = time.monotonic(), 0
    while count < 50:
        if time.monotonic() - clock_s >= count * _PERIOD_S:
            count += 1
            pose.publish(pose.message_class(x=float(count)))
            command.publish(command.message_class())
    # What is on its way when the recorder is stopped is lost, as in ROS.
    active = tmp_path / "turtle.bag.active"
    run.eventually(lambda: open_bag(active).summary.messages == 101)
    assert run.stop() == 0, run.text
    assert not (tmp_path / "turtle.bag.active").exists()
    talker.shutdown()
    return tmp_path / "turtle.bag"


class _Listener:
    """Collects poses with the time they came at."""

    def __init__(self, graph: Graph) -> None:
        self.got: list[tuple[float, float]] = []
        self.words: list[str] = []
        self.node = graph.create_node("listener", anonymous=True)
        self.node.create_subscription("/turtle1/pose", "geometry_msgs/msg/Pose2D", self._take)
        self.node.create_subscription(
            "/map_name", "std_msgs/msg/String", lambda one: self.words.append(one.data)
        )

    def _take(self, message: Any) -> None:
        self.got.append((time.monotonic(), message.x))

    @property
    def span_s(self) -> float:
        return self.got[-1][0] - self.got[0][0]


def test_record_info_play_and_double_speed(gazelle: Callable, graph: Graph, recorded: Path) -> None:
    bag = open_bag(recorded)
    counts = {one.topic: bag.summary.counts[one.id] for one in bag.connections}
    assert counts == {"/turtle1/pose": 50, "/turtle1/cmd_vel": 50, "/map_name": 1}
    pose = next(one for one in bag.connections if one.topic == "/turtle1/pose")
    assert pose.callerid == "/turtlesim"
    assert next(one for one in bag.connections if one.topic == "/map_name").latching

    info = gazelle("rosbag", "info", "turtle.bag")
    assert info.wait() == 0
    assert "messages:    101" in info.text
    assert "/turtle1/pose      50 msgs    : geometry_msgs/Pose2D" in info.text

    spans = {}
    for rate in ("1", "2"):
        listener = _Listener(graph)
        play = gazelle("rosbag", "play", "-r", rate, "turtle.bag")
        assert play.wait() == 0, play.text
        assert "Done." in play.text and "Duration: " in play.text
        play.eventually(lambda listener=listener: len(listener.got) == 50)
        assert [x for _, x in listener.got] == [float(k) for k in range(1, 51)]
        assert listener.words == ["here"]
        spans[rate] = listener.span_s
        listener.node.shutdown()
    assert spans["1"] == pytest.approx(0.98, abs=0.3)
    assert spans["2"] == pytest.approx(spans["1"] / 2, abs=0.2)


def test_a_subset_is_recorded_from_what_is_played(
    gazelle: Callable, graph: Graph, recorded: Path, tmp_path: Path
) -> None:
    record = gazelle("rosbag", "record", "-O", "subset", "/turtle1/cmd_vel", "/other/pose")
    record.wait_for_line("Recording to 'subset.bag'.")
    record.wait_for_line("Subscribing to /other/pose")
    play = gazelle(
        "rosbag", "play", "-d", "1", "--wait-for-subscribers", "--topics", "/turtle1/cmd_vel",
        "/turtle1/pose", "--bags=turtle.bag", "/turtle1/pose:=/other/pose",
    )  # fmt: skip
    assert play.wait() == 0, play.text
    active = tmp_path / "subset.bag.active"
    record.eventually(lambda: open_bag(active).summary.messages == 100)
    assert record.stop() == 0
    bag = open_bag(tmp_path / "subset.bag")
    counts = {one.topic: bag.summary.counts[one.id] for one in bag.connections}
    assert counts == {"/turtle1/cmd_vel": 50, "/other/pose": 50}
