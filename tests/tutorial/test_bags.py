"""``rosbag record -a``, ``info``, ``play``, ``play -r 2`` and a subset, as typed (T4)."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from tests.patience import undisturbed

from gazelle.bag import open_bag
from gazelle.graph import Graph

pytestmark = pytest.mark.tutorial

_PERIOD_S = 0.02


@pytest.fixture(scope="module")
def graph(module_port: int) -> Any:
    """The graph that the commands join."""
    with Graph.open(port=module_port, environ={}) as graph:
        yield graph


@pytest.fixture(scope="module")
def recorded(
    module_gazelle: Callable, graph: Graph, tmp_path_factory: pytest.TempPathFactory
) -> Path:
    """A second of a turtle's topics, recorded with ``rosbag record -a``."""
    folder = tmp_path_factory.mktemp("recorded")
    talker = graph.create_node("turtlesim")
    pose = talker.create_publisher("/turtle1/pose", "geometry_msgs/msg/Pose2D")
    command = talker.create_publisher("/turtle1/cmd_vel", "geometry_msgs/msg/Twist")
    latched = talker.create_publisher("/map_name", "std_msgs/msg/String", latch=True)
    latched.publish(latched.message_class(data="here"))
    run = module_gazelle("rosbag", "record", "-a", "-O", "turtle", "-x", "/rosout.*", cwd=folder)
    run.wait_for_line("Recording to 'turtle.bag'.")
    run.eventually(lambda: pose.matched and command.matched)
    began_s, pause = time.monotonic(), threading.Event()
    for count in range(50):
        pause.wait(began_s + count * _PERIOD_S - time.monotonic())
        pose.publish(pose.message_class(x=count + 1.0))
        command.publish(command.message_class())
    # What is on its way when the recorder is stopped is lost, as in ROS.
    active = folder / "turtle.bag.active"
    run.eventually(lambda: open_bag(active).summary.messages == 101)
    assert run.stop() == 0, run.text
    assert not (folder / "turtle.bag.active").exists()
    talker.shutdown()
    return folder / "turtle.bag"


@pytest.fixture
def run(gazelle: Callable, module_port: int, recorded: Path) -> Callable:
    """Runs ``gazelle WORDS…`` on that graph beside that bag."""
    return partial(gazelle, port=module_port, cwd=recorded.parent)


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


def test_record_info_play_and_double_speed(run: Callable, graph: Graph, recorded: Path) -> None:
    bag = open_bag(recorded)
    counts = {one.topic: bag.summary.counts[one.id] for one in bag.connections}
    assert counts == {"/turtle1/pose": 50, "/turtle1/cmd_vel": 50, "/map_name": 1}
    pose = next(one for one in bag.connections if one.topic == "/turtle1/pose")
    assert pose.callerid == "/turtlesim"
    assert next(one for one in bag.connections if one.topic == "/map_name").latching

    info = run("rosbag", "info", "turtle.bag")
    assert info.wait() == 0
    assert "messages:    101" in info.text
    assert "/turtle1/pose      50 msgs    : geometry_msgs/Pose2D" in info.text

    stamps_ns = [one.stamp_ns for one in bag.messages() if one.connection.id == pose.id]
    bag_s = (stamps_ns[-1] - stamps_ns[0]) / 1e9
    for rate in (1, 2):
        undisturbed(lambda rate=rate: _played_s(run, graph, rate), bag_s / rate, rel=0.2)


def _played_s(run: Callable, graph: Graph, rate: int) -> float:
    """Play the bag to somebody and return how long the poses took to come, in s."""
    listener = _Listener(graph)
    play = run("rosbag", "play", "-r", str(rate), "turtle.bag")
    assert play.wait() == 0, play.text
    assert "Done." in play.text and "Duration: " in play.text
    play.eventually(lambda: len(listener.got) == 50)
    assert [x for _, x in listener.got] == [float(k) for k in range(1, 51)]
    assert listener.words == ["here"]
    listener.node.shutdown()
    return listener.span_s


def test_a_subset_is_recorded_from_what_is_played(run: Callable, recorded: Path) -> None:
    record = run("rosbag", "record", "-O", "subset", "/turtle1/cmd_vel", "/other/pose")
    record.wait_for_line("Recording to 'subset.bag'.")
    record.wait_for_line("Subscribing to /other/pose")
    play = run(
        "rosbag", "play", "-d", "1", "--wait-for-subscribers", "--topics", "/turtle1/cmd_vel",
        "/turtle1/pose", "--bags=turtle.bag", "/turtle1/pose:=/other/pose",
    )  # fmt: skip
    assert play.wait() == 0, play.text
    active = recorded.parent / "subset.bag.active"
    record.eventually(lambda: open_bag(active).summary.messages == 100)
    assert record.stop() == 0
    bag = open_bag(recorded.parent / "subset.bag")
    counts = {one.topic: bag.summary.counts[one.id] for one in bag.connections}
    assert counts == {"/turtle1/cmd_vel": 50, "/other/pose": 50}
