"""``gz topic -t`` and ``ign topic``."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
from collections.abc import Callable
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.cli.gz.gz_sim.message_types import message_of, ros_types_of
from gazelle.cli.gz.gz_sim.which_gazebo import is_new
from gazelle.cli.gz.options import GzError
from gazelle.cli.gz.protobuf_text import read_protobuf_text
from gazelle.cli.main import main
from gazelle.graph import Graph
from gazelle.interfaces import message_type

Run = Callable[..., Any]
TWIST = "geometry_msgs/msg/Twist"


class Inbox:
    """Waits for messages."""

    def __init__(self) -> None:
        self.messages: list[Any] = []
        self._came = threading.Event()

    def __call__(self, message: Any) -> None:
        self.messages.append(message)
        self._came.set()

    def first(self) -> Any:
        assert self._came.wait(stretched()), "no message came"
        return self.messages[0]


@pytest.mark.parametrize(
    ("words", "new"),
    [
        ("topic -l", False),
        ("topic -e /clock", False),
        ("topic -i /clock", False),
        ("topic -e -t /clock", True),
        ("topic -et /clock", False),
        ("topic --topic=/clock -i", True),
        ("topic -z /clock", False),
        ("model -m arm -p", False),
        ("model -m arm -x 1", False),
        ("model -m arm", True),
        ("model -m arm -l", True),
        ("model -m arm -j swing", True),
        ("model --list", True),
        ("model -m arm -f lamp.sdf", False),
        ("service -l", True),
        ("sim", True),
        ("stats", False),
        ("world -p 1", False),
    ],
)
def test_generation_is_told_from_the_words(words: str, new: bool) -> None:
    name, *rest = words.split()
    assert is_new(name, rest, in_use=lambda: False) is new


@pytest.mark.parametrize(
    ("words", "new"),
    [
        ("topic --help", True),
        ("model", True),
        ("model -m arm -p", True),
        ("model -m arm -x 1", False),
        ("topic -e /clock", False),
    ],
)
def test_words_of_both_generations_are_those_of_the_one_in_use(words: str, new: bool) -> None:
    name, *rest = words.split()
    assert is_new(name, rest, in_use=lambda: True) is new


def test_message_is_published_in_the_type_in_use(graph: Graph, gz: Run) -> None:
    plain, stamped = Inbox(), Inbox()
    node = graph.create_node("robot", rosout=False)
    node.create_subscription("/cmd_vel", TWIST, plain)
    node.create_subscription("/stamped", "geometry_msgs/msg/TwistStamped", stamped)
    words = ("-m", "gz.msgs.Twist", "-p", "linear: {x: 0.5}, angular: {z: -1}")
    assert gz("topic", "-t", "/cmd_vel", *words) == (0, "", "")
    assert (plain.first().linear.x, plain.first().angular.z) == (0.5, -1.0)
    assert gz("topic", "-t", "/stamped", *words).code == 0
    assert stamped.first().twist.linear.x == 0.5


def test_ignition_spells_types_its_way(graph: Graph) -> None:
    inbox = Inbox()
    graph.create_node("robot", rosout=False).create_subscription("/on", "std_msgs/msg/Bool", inbox)
    words = ["topic", "-t", "/on", "-m", "ignition.msgs.Boolean", "-p", "data: true"]
    assert main(["ign", *words]) == 0
    assert inbox.first().data is True


def test_nobody_listens(graph: Graph, gz: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gazelle.cli.gz.gz_sim.topic._MATCH_S", 0.05)
    found = gz("topic", "-t", "/alone", "-m", "gz.msgs.Double", "-p", "data: 1")
    assert found == (0, "", "gazelle: nobody subscribes to /alone\n")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("-t", "/cmd_vel", "-p", "x: 1"), "-m TYPE names the type of the message"),
        (("-t", "/cmd_vel", "-m", "gz.msgs.Twits", "-p", ""), "did you mean 'Twist'?"),
        (("-t", "/cmd_vel", "-m", "gz.msgs.Imu", "-p", ""), "has no pair of ROS here"),
        (("-t", "/cmd_vel", "-m", "gz.msgs.Pose", "-p", ""),
         "topic /cmd_vel has type gz.msgs.Twist (geometry_msgs/msg/Twist), not gz.msgs.Pose"),
        (("-t", "/cmd_vel", "-m", "gz.msgs.Twist", "-p", "linear: {w: 1}"),
         "this is no gz.msgs.Twist (geometry_msgs/msg/Twist): "),
        (("-t", "/cmd_vel", "-m", "gz.msgs.Twist", "-p", "linear: {x 1}"), "'x' wants ':'"),
        (("-t", "/cmd_vel"), "one of -i, -e, -f and -p says what to do"),
        (("-n", "1", "-e"), "-t TOPIC names the topic"),
        (("-t", "/cmd_vle", "-e"), "Unable to find topic[/cmd_vle]; did you mean '/cmd_vel'?"),
    ],
)  # fmt: skip
def test_what_cannot_be_done_is_told(
    graph: Graph, gz: Run, words: tuple[str, ...], said: str
) -> None:
    graph.create_node("robot", rosout=False).create_subscription("/cmd_vel", TWIST, print)
    found = gz("topic", *words)
    assert found.code == 255
    assert said in found.err


@pytest.mark.parametrize(
    "words", [("-e", "-t", "/pose"), ("-e", "-t", "/pose", "-n", "2"), ("-e", "/pose")]
)
def test_echo_ends_without_a_word_when_its_reader_has_gone(
    graph: Graph, words: tuple[str, ...]
) -> None:
    node = graph.create_node("robot", rosout=False)
    talker = node.create_publisher("/pose", "geometry_msgs/PoseStamped", latch=True)
    talker.publish(talker.message_class())
    near, far = os.pipe()
    os.close(near)
    try:
        echo = subprocess.run(
            [sys.executable, "-m", "gazelle.cli", "gz", "topic", *words],
            stdout=far, stderr=subprocess.PIPE, text=True, timeout=stretched(), check=False,
        )  # fmt: skip
    finally:
        os.close(far)
    assert (echo.returncode, echo.stderr) == (0, "")


def test_topic_is_echoed_and_told(graph: Graph, gz: Run) -> None:
    node = graph.create_node("robot", rosout=False)
    talker = node.create_publisher("/pose", "geometry_msgs/PoseStamped", latch=True)
    message = talker.message_class()
    message.header.stamp.nanosec, message.pose.position.x = 3, 0.5
    talker.publish(message)
    echoed = gz("topic", "-e", "-t", "/pose", "-n", "1").out
    assert "    sec: 0\n    nsec: 3\n" in echoed
    assert "pose {\n  position {\n    x: 0.5\n" in echoed
    plain = json.loads(gz("topic", "-e", "-t", "/pose", "-n", "1", "--json-output").out)
    assert plain["pose"]["position"]["x"] == 0.5
    told = gz("topic", "-i", "-t", "/pose").out
    assert told.startswith("Publishers [Address, Message Type]:\n  gazelle://")
    assert told.endswith(" /robot, gz.msgs.Pose\nNo subscribers on topic [/pose]\n")


def test_fields_of_gazebo_become_those_of_ros() -> None:
    text = "sim {sec: 3 nsec: 7} "
    assert message_of("rosgraph_msgs/msg/Clock", read_protobuf_text(text)).clock.nanosec == 7
    text = "header {stamp {sec: 1} data {key: 'frame_id' value: 'map'}} position {x: 2}"
    pose = message_of("geometry_msgs/msg/PoseStamped", read_protobuf_text(text))
    assert (pose.header.frame_id, pose.header.stamp.sec, pose.pose.position.x) == ("map", 1, 2.0)
    text = "entity {name: 'box' type: LINK} wrench {force {z: 9.5}}"
    push = message_of("ros_gz_interfaces/msg/EntityWrench", read_protobuf_text(text))
    assert (push.entity.type, push.wrench.force.z) == (3, 9.5)
    text = "joint_names: 'a' points {positions: 1.5 time_from_start {sec: 2}}"
    path = message_of("trajectory_msgs/msg/JointTrajectory", read_protobuf_text(text))
    assert list(path.joint_names) == ["a"]
    assert (list(path.points[0].positions), path.points[0].time_from_start.sec) == ([1.5], 2)
    with pytest.raises(GzError, match="this is no"):
        message_of("ros_gz_interfaces/msg/EntityWrench", {"entity": {"type": "LNK"}})


def test_every_pair_has_a_type_of_ros() -> None:
    from gazelle.cli.gz.gz_sim.message_types import _TYPES

    for name in _TYPES:
        for ros_type in ros_types_of(f"gz.msgs.{name}"):
            assert ros_type == message_type(ros_type).TYPE_NAME
