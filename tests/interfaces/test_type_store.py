"""One store of types for a process, and others that lie over it."""

from __future__ import annotations

import copy
import pickle
import threading
from pathlib import Path

import pytest

from gazelle.errors import NotFoundError
from gazelle.interfaces import (
    RosVersion,
    TypeStore,
    default_types,
    from_cdr,
    from_ros1,
    keep_text,
    kept_text,
    known_types,
    md5sum,
    message_type,
    ros1_message_type,
    to_cdr,
    to_ros1,
)

STRING, TURNED = "std_msgs/String", "int32 number\nstring data\n"


def over(**texts: str) -> TypeStore:
    """A store over the process's own that knows other messages of ROS 1."""
    store = TypeStore(below=default_types())
    for name, text in texts.items():
        store.add_text(name.replace("__", "/"), RosVersion.ROS1, text)
    return store


def test_functions_of_the_package_are_those_of_the_default_store() -> None:
    assert message_type(STRING) is default_types().message_type(STRING)
    assert known_types(package="std_msgs") == default_types().known_types(package="std_msgs")


def test_what_a_store_is_taught_counts_in_it_alone() -> None:
    store = over(std_msgs__String=TURNED)
    assert store.ros1_message_type(STRING)._names == ("number", "data")
    assert ros1_message_type(STRING)._names == ("data",)
    assert store.md5sum(STRING) != md5sum(STRING)
    assert store.ros1_message_type(STRING)._md5sum == store.md5sum(STRING)
    assert store.ros1_message_type(STRING)._full_text == TURNED


def test_what_a_store_is_not_taught_is_the_same_class_below() -> None:
    store = over(std_msgs__String=TURNED)
    twist = "geometry_msgs/Twist"
    assert store.ros1_message_type(twist) is ros1_message_type(twist)
    assert store.message_type(twist) is message_type(twist)


def test_a_type_that_contains_another_one_is_another_one() -> None:
    store = over(geometry_msgs__Vector3="float64 y\nfloat64 x\nfloat64 z\n")
    twist = store.ros1_message_type("geometry_msgs/Twist")
    assert twist is not ros1_message_type("geometry_msgs/Twist")
    made = twist()
    made.linear.x = 1.0
    data = to_ros1(made)
    assert from_ros1(twist, data).linear.x == 1.0
    assert from_ros1(ros1_message_type("geometry_msgs/Twist"), data).linear.y == 1.0


def test_bytes_of_either_kind_follow_the_store_of_the_class() -> None:
    store = over(own_msgs__Count="int16 count\n")
    made = store.message_type("own_msgs/Count")(count=7)
    assert from_cdr(store.ros1_message_type("own_msgs/Count"), to_cdr(made)).count == 7
    with pytest.raises(NotFoundError, match="own_msgs/Count"):
        message_type("own_msgs/Count")


def test_what_the_process_learns_later_shows_through(tmp_path: Path) -> None:
    store = over(std_msgs__String=TURNED)
    assert not store.exists("later_msgs/One")
    (tmp_path / "msg").mkdir()
    (tmp_path / "msg" / "One.msg").write_text("int8 a\n", encoding="utf-8")
    default_types().add_package("later_msgs", tmp_path)
    assert store.message_type("later_msgs/One") is message_type("later_msgs/One")
    assert "later_msgs/msg/One" in store.known_types()


def test_a_text_that_means_the_same_is_kept_where_the_type_is() -> None:
    store = over(own_msgs__Count="int16 count\n")
    assert store.keep_text(STRING, RosVersion.ROS1, "# Of a bag.\nstring data\n")
    assert store.keep_text("own_msgs/Count", RosVersion.ROS1, "# Mine.\nint16 count\n")
    assert store.ros1_definition(STRING) == "# Of a bag.\nstring data\n"
    assert kept_text(STRING, RosVersion.ROS1) == ""
    assert keep_text(STRING, RosVersion.ROS1, "# Of a peer.\nstring data\n")
    assert store.kept_text(STRING, RosVersion.ROS1) == "# Of a bag.\nstring data\n"


def test_a_store_that_is_reset_knows_what_it_knew_first(tmp_path: Path) -> None:
    (tmp_path / "msg").mkdir()
    (tmp_path / "msg" / "One.msg").write_text("int8 a\n", encoding="utf-8")
    store = TypeStore()
    plain = store.message_type(STRING)
    store.add_package("std_msgs", tmp_path)
    store.add_text(STRING, RosVersion.ROS2, TURNED)
    store.taught_by.add("me")
    assert store.message_type(STRING) is not plain and store.exists("std_msgs/One")
    store.reset()
    assert store.message_type(STRING)._names == plain._names
    assert not store.exists("std_msgs/One") and not store.taught_by


def test_a_store_over_none_shares_no_class_with_the_process() -> None:
    assert TypeStore().message_type(STRING) is not message_type(STRING)


def test_messages_of_any_store_are_copied_and_pickled() -> None:
    store = over(std_msgs__String=TURNED)
    for cls in (store.ros1_message_type(STRING), ros1_message_type(STRING), message_type(STRING)):
        made = cls(data="a")
        for again in (copy.copy(made), copy.deepcopy(made)):
            assert again == made and type(again) is cls
        one, two = pickle.loads(pickle.dumps(made)), pickle.loads(pickle.dumps(made))
        assert one._names == made._names and one.data == "a"
        assert type(one) is type(two)


def test_a_message_of_any_type_is_copied_with_its_bytes() -> None:
    made = ros1_message_type("*")()
    made.deserialize(b"abc")
    assert to_ros1(copy.deepcopy(made)) == b"abc"


def test_threads_that_ask_at_once_get_one_class() -> None:
    store, found = TypeStore(), []
    start = threading.Barrier(8)

    def ask() -> None:
        start.wait()
        found.append((store.message_type("nav_msgs/Odometry"), store.ros1_message_type(STRING)))

    threads = [threading.Thread(target=ask) for _ in range(8)]
    for one in threads:
        one.start()
    for one in threads:
        one.join()
    assert len(set(found)) == 1
