"""Types that one side lacks."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.bridge.ros2.types import TypeBook
from gazelle.graph.type_support import hash_of


@pytest.fixture
def told() -> list[str]:
    return []


def test_types_that_only_ros1_has_are_told_once_for_a_package(told: list[str]) -> None:
    book = TypeBook(told.append)
    book.miss("move_base_msgs/msg/MoveBaseActionGoal", "topic /a of /n", "no such module")
    book.miss("move_base_msgs/msg/MoveBaseActionResult", "topic /b of /n", "no such module")
    assert told == [
        "topic /a of /n cannot go to ROS 2: its type move_base_msgs/msg/MoveBaseActionGoal exists "
        "only in ROS 1; neither can other types of move_base_msgs that ROS 2 does not have"
    ]
    assert book.is_missing("move_base_msgs/msg/MoveBaseActionResult")
    assert not book.is_missing("move_base_msgs/msg/MoveBaseActionFeedback")


def test_package_that_ros_lacks_is_told_with_what_to_install(told: list[str]) -> None:
    book = TypeBook(told.append, distro="jazzy")
    book.miss("tf2_msgs/msg/TFMessage", "topic /tf of /n", "No module named 'tf2_msgs'")
    assert told == [
        "topic /tf of /n does not go to ROS 2, whose Python lacks its type tf2_msgs/msg/TFMessage: "
        "No module named 'tf2_msgs' [bridge.type-missing]\n  fix: apt install ros-jazzy-tf2-msgs, "
        "or source the workspace that builds tf2_msgs; then start the bridge again\n  ROS says: "
        "The message type is invalid"
    ]


def test_type_that_the_graph_lacks_is_told_once(told: list[str]) -> None:
    book = TypeBook(told.append)
    for _ in range(2):
        assert book.message("no_such_msgs/msg/Thing", "topic /t of /n", reliable=True) is None
    assert book.service("no_such_msgs/srv/Thing", "service /s of /n") is None
    assert [one.splitlines()[0] for one in told] == [
        "topic /t of /n does not cross the bridge: nothing here defines its type "
        "no_such_msgs/msg/Thing [bridge.type-missing]",
        "service /s of /n does not cross the bridge: nothing here defines its type "
        "no_such_msgs/srv/Thing [bridge.type-missing]",
    ]


def test_type_that_is_defined_otherwise_does_not_cross(told: list[str]) -> None:
    book = TypeBook(told.append)
    own = hash_of("std_msgs/msg/String")
    assert book.agrees("std_msgs/msg/String", "topic /t", own)
    assert book.agrees("std_msgs/msg/String", "topic /t", "")
    assert book.agrees("no_such_msgs/msg/Thing", "topic /t", own)
    assert told == []
    assert not book.agrees("std_msgs/msg/String", "topic /t", "RIHS01_0123456789")
    assert book.is_missing("std_msgs/msg/String")
    assert told[0].startswith(
        "topic /t does not cross the bridge: ROS 2 defines its type std_msgs/msg/String otherwise "
        "(RIHS01_01234567… there, RIHS01_df668c74… here) [bridge.type-differs]"
    )


def test_types_are_read_from_what_ros_has_installed(told: list[str], tmp_path: Path) -> None:
    folder = tmp_path / "share" / "only_ros_has_msgs"
    for part, name, text in (("msg", "Thing", "int32 x\n"), ("srv", "Ask", "int32 x\n---\n")):
        (folder / part).mkdir(parents=True)
        (folder / part / f"{name}.{part}").write_text(text)
    book = TypeBook(told.append, [str(tmp_path / "other"), str(tmp_path)])
    kind = book.message("only_ros_has_msgs/msg/Thing", "topic /t", reliable=False)
    assert kind is not None
    assert kind.message_class(x=3).x == 3
    service = book.service("only_ros_has_msgs/srv/Ask", "service /s")
    assert service is not None
    assert service.service_class.Request(x=4).x == 4
    assert told == []
