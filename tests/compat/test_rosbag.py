"""rosbag.Bag; answers are those of rosbag 1.15 on the same bag."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from gazelle.bag import Storage, cdr_connection, create_bag
from gazelle.compat.rosbag import (
    Bag,
    Compression,
    ROSBagException,
    ROSBagFormatException,
)
from gazelle.compat.rospy.rostime import Time
from gazelle.interfaces import message_type, ros1_message_type, to_cdr

String: Any = ros1_message_type("std_msgs/String")
Int32: Any = ros1_message_type("std_msgs/Int32")


@pytest.fixture
def path(tmp_path: Path) -> str:
    """A bag of two topics."""
    file = str(tmp_path / "two.bag")
    with Bag(file, "w") as bag:
        for number in range(4):
            bag.write("/a", String(f"x{number}"), Time(10 + number))
        bag.write("/b", Int32(3), Time(11, 500_000_000))
    return file


def test_messages_come_by_time_and_choice(path: str, capfd: Any) -> None:
    with Bag(path) as bag:
        rows = [(row.topic, row.message.data, row.timestamp.to_sec()) for row in bag]
        assert rows[:3] == [("/a", "x0", 10.0), ("/a", "x1", 11.0), ("/b", 3, 11.5)]
        between = bag.read_messages("/a", start_time=Time(11), end_time=Time(12))
        assert [stamp.to_sec() for _, _, stamp in between] == [11.0, 12.0]
        judged = bag.read_messages(connection_filter=lambda topic, kind, *_rest: "Int" in kind)
        assert [topic for topic, _, _ in judged] == ["/b"]
        assert list(bag.read_messages(topics=["a"])) == []
    assert "has no messages of topic 'a'; did you mean '/a'" in capfd.readouterr().err


def test_raw_messages_and_headers_are_given(path: str, tmp_path: Path) -> None:
    with Bag(path) as bag:
        row = next(bag.read_messages(raw=True))
        assert row.message[:3] == ("std_msgs/String", b"\x02\0\0\0x0", String._md5sum)
        full = next(bag.read_messages(return_connection_header=True))
        assert full.connection_header["type"] == b"std_msgs/String"
        assert full.connection_header["message_definition"].startswith(b"string data")
        copy = str(tmp_path / "copy.bag")
        with Bag(copy, "w", compression=Compression.BZ2) as other:
            for topic, message, stamp in bag.read_messages(raw=True):
                other.write(topic, message, stamp, raw=True)
    with Bag(copy) as other:
        assert [message.data for _, message, _ in other][:2] == ["x0", "x1"]
        assert other.get_compression_info().compression == "bz2"


@pytest.mark.reference
def test_questions_about_the_bag_are_answered(path: str) -> None:
    with Bag(path) as bag:
        types, topics = bag.get_type_and_topic_info()
        assert types == {
            "std_msgs/Int32": "da5909fbe378aeaf85e547e830cc1bb7",
            "std_msgs/String": "992ce8a1687cec8c8bd883ec73ca41d1",
        }
        assert topics["/a"] == ("std_msgs/String", 4, 1, 1.0)
        assert topics["/b"] == ("std_msgs/Int32", 1, 1, None)
        assert list(bag.get_type_and_topic_info("/b").topics) == ["/b"]
        assert (bag.get_message_count(), bag.get_message_count("/a")) == (5, 4)
        assert (bag.get_start_time(), bag.get_end_time()) == (10.0, 13.0)
        assert (bag.mode, bag.version, bag.filename) == ("r", 200, path)
        assert bag.size == Path(path).stat().st_size and "4 msgs : std_msgs/String" in str(bag)


def test_appending_keeps_what_was_there(path: str) -> None:
    with Bag(path, "a") as bag:
        bag.write("/a", String("late"), Time(20))
    with Bag(path) as bag:
        assert [message.data for _, message, _ in bag.read_messages("/a")][-2:] == ["x3", "late"]
        assert bag.get_message_count() == 6
        assert bag.get_type_and_topic_info().topics["/a"].connections == 1


@pytest.mark.reference
def test_mistakes_are_told_as_rosbag_tells_them(path: str, tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="No such file or directory"):
        Bag(str(tmp_path / "nope.bag"))
    with pytest.raises(ValueError, match='mode "q" is invalid'):
        Bag(path, "q")
    with pytest.raises(ValueError, match="compression must be one of: none, bz2, lz4"):
        Bag(path, "w", "zip")
    (tmp_path / "text.bag").write_text("no bag at all")
    with pytest.raises(ROSBagFormatException, match=r"text\.bag"):
        Bag(str(tmp_path / "text.bag"))
    bag = Bag(path)
    with pytest.raises(ROSBagException, match="is open for reading, not for writing"):
        bag.write("/a", String("x"))
    bag.close()
    with pytest.raises(ValueError, match="I/O operation on closed bag"):
        list(bag.read_messages())
    empty = str(tmp_path / "empty.bag")
    with Bag(empty, "w") as bag:
        kind: Any = message_type("std_msgs/String")
        with pytest.raises(ROSBagException, match="String is no message of ROS 1"):
            bag.write("/a", kind(data="x"))
        with pytest.raises(ROSBagException, match="is open for writing, not for reading"):
            bag.get_message_count()
    with Bag(empty) as bag:
        assert bag.get_message_count() == 0 and list(bag) == []
        with pytest.raises(ROSBagException, match="Bag contains no message"):
            bag.get_start_time()


def test_bag_of_rosbag2_is_read_in_the_form_of_ros1(tmp_path: Path) -> None:
    writer = create_bag(tmp_path / "new.mcap", Storage.MCAP)
    connection = writer.add(cdr_connection("/a", "std_msgs/msg/String"))
    kind: Any = message_type("std_msgs/String")
    writer.write(connection, 10**9, to_cdr(kind(data="hello")))
    writer.close()
    with Bag(tmp_path / "new.mcap") as bag:
        ((topic, message, stamp),) = bag
        assert (topic, message, stamp) == ("/a", String("hello"), Time(1))
