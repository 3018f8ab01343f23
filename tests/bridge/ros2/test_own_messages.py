"""Messages that the bridge has published itself."""

from __future__ import annotations

from typing import Any, NamedTuple

import pytest

from gazelle.bridge.ros2.rclpy_side import own_messages
from gazelle.bridge.ros2.rclpy_side.own_messages import OwnMessages, RosPublishers


class Info(NamedTuple):
    node_name: str
    node_namespace: str
    endpoint_gid: list[int]


class FakeNode:
    def __init__(self, *infos: Info) -> None:
        self.infos = list(infos)

    def get_publishers_info_by_topic(self, topic: str) -> list[Info]:
        assert topic == "/chatter"
        return self.infos


def test_own_publishers_have_number_zero() -> None:
    node = FakeNode(Info("bridge", "/", [1, 1]), Info("talker", "/ns", [1, 2]))
    ros_publishers = RosPublishers(node, {"/bridge"})
    assert ros_publishers.number_of("/chatter", b"\1\1") == 0
    assert ros_publishers.number_of("/chatter", b"\1\2") == 1
    assert [number for _, number in ros_publishers.learn("/chatter")] == [0, 1]


def test_publishers_are_asked_for_when_they_are_new() -> None:
    node = FakeNode()
    ros_publishers = RosPublishers(node, {"/bridge"})
    assert ros_publishers.number_of("/chatter", b"\1\2") == 1
    assert ros_publishers.news.is_set()
    node.infos.append(Info("bridge", "/", [1, 3]))
    assert ros_publishers.number_of("/chatter", b"\1\3") == 0


def test_publisher_of_a_namesake_is_not_kept_for_ours() -> None:
    own = {"/talker"}
    ros_publishers = RosPublishers(FakeNode(Info("talker", "/", [1, 2])), own)
    assert ros_publishers.number_of("/chatter", b"\1\2") == 0
    own.clear()
    assert [number for _, number in ros_publishers.learn("/chatter")] == [1]
    assert ros_publishers.number_of("/chatter", b"\1\2") == 1


def test_each_published_message_is_swallowed_once() -> None:
    known = OwnMessages()
    known.note(b"\0\1\0\0hello\0")
    known.note(b"\0\1\0\0hello\0")
    assert not known.is_echo(b"\0\1\0\0other\0")
    # Transports write the head's options and the padding anew.
    assert known.is_echo(b"\0\1\0\2hello\0\0\0")
    assert known.is_echo(b"\0\1\0\0hello\0")
    assert not known.is_echo(b"\0\1\0\0hello\0")


def test_lost_message_swallows_no_later_one(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [0.0]

    class Clock:
        monotonic = staticmethod(lambda: now[0])

    clock: Any = Clock
    monkeypatch.setattr(own_messages, "time", clock)
    brief, latched = OwnMessages(), OwnMessages(for_ever=True)
    for one in (brief, latched):
        one.note(b"\0\1\0\0old")
    now[0] = 6.0
    assert not brief.is_echo(b"\0\1\0\0old")
    assert latched.is_echo(b"\0\1\0\0old")
