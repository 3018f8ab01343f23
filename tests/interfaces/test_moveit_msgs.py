"""The messages of MoveIt, of what octomap and object recognition tell it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

import gazelle.interfaces
from gazelle.interfaces import RosVersion, action_type, md5sum, message_type, to_cdr, type_hash

pytestmark = pytest.mark.reference
PACKAGES = ("moveit_msgs", "object_recognition_msgs", "octomap_msgs")
DEFINITIONS = Path(gazelle.interfaces.__file__).parent / "definitions"

# As Noetic's generated classes print them.
PUBLISHED = {
    "moveit_msgs/AttachedCollisionObject": "30199ef516f64c8bc1edb1084ce4584e",
    "moveit_msgs/CollisionObject": "dbba710596087da521c07564160dfccb",
    "moveit_msgs/PlanningScene": "acfc50bcfd6c7b978066bfa7c786002c",
    "moveit_msgs/RobotState": "968156f4aa4cb4018f1f2293eebcea8f",
    "moveit_msgs/RobotTrajectory": "dfa9556423d709a3729bcef664bddf67",
}


def _peer(ros_version: RosVersion) -> tuple[Any, list[str]]:
    """A store of the other implementation with our texts read by its own parser."""
    store = get_typestore(
        Stores.ROS1_NOETIC if ros_version is RosVersion.ROS1 else Stores.ROS2_JAZZY
    )
    found = {}
    for package in PACKAGES:
        text = (DEFINITIONS / f"ros{ros_version.value}" / f"{package}.txt").read_text("utf-8")
        for block in text.split("=== ")[1:]:
            key, _, fields = block.partition("\n")
            if key.startswith("msg/"):
                found.update(get_types_from_msg(fields, f"{package}/{key}"))
    store.register(found)
    return store, sorted(found)


def test_md5_sums_are_those_that_noetic_published() -> None:
    assert {name: md5sum(name) for name in PUBLISHED} == PUBLISHED


def test_md5_sums_equal_those_of_another_implementation() -> None:
    store, names = _peer(RosVersion.ROS1)
    assert len(names) > 50
    assert [n for n in names if md5sum(n) != store.generate_msgdef(n, ros_version=1)[1]] == []


def test_type_hashes_and_bytes_equal_those_of_another_implementation(
    make_message: Callable[..., Any],
) -> None:
    store, names = _peer(RosVersion.ROS2)
    assert len(names) > 50
    assert [n for n in names if type_hash(n) != store.hash_rihs01(n)] == []
    for name in names:
        message = make_message(name, RosVersion.ROS2, 1)
        again = store.serialize_cdr(store.deserialize_cdr(to_cdr(message), name), name)
        assert bytes(again) == to_cdr(message), name


def test_error_codes_carry_a_message_in_ros2_and_numbers_in_both() -> None:
    codes: Any = message_type("moveit_msgs/MoveItErrorCodes")
    assert (codes.SUCCESS, codes.NO_IK_SOLUTION, codes.START_STATE_IN_COLLISION) == (1, -31, -10)
    assert codes(val=-31, message="why").message == "why"
    assert action_type("moveit_msgs/MoveGroup").Result().error_code.val == 0
