"""rosbag2_py: what is written is read again, in both storages."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.compat.rosbag import Bag
from gazelle.compat.rosbag2_py import (
    ConverterOptions,
    Info,
    Reindexer,
    SequentialReader,
    SequentialWriter,
    StorageFilter,
    StorageOptions,
    TopicMetadata,
    get_default_storage_id,
)
from gazelle.compat.rospy.rostime import Time
from gazelle.interfaces import from_cdr, message_type, ros1_message_type, to_cdr

String: Any = message_type("std_msgs/String")


def _written(folder: Path, storage: str) -> StorageOptions:
    options = StorageOptions(uri=str(folder), storage_id=storage)
    writer = SequentialWriter()
    writer.open(options, ConverterOptions("cdr", "cdr"))
    for name in ("/a", "/b"):
        writer.create_topic(TopicMetadata(name=name, type="std_msgs/msg/String"))
    for number in range(6):
        topic = "/a" if number % 2 else "/b"
        writer.write(topic, to_cdr(String(data=str(number))), number * 10**9 + 10**9)
    writer.close()
    return options


def _texts(reader: SequentialReader) -> list[str]:
    found = []
    while reader.has_next():
        _topic, data, _stamp = reader.read_next()
        found.append(str(from_cdr(String, data).data))
    return found


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_bag_is_read_filtered_and_sought(tmp_path: Path, storage: str) -> None:
    options = _written(tmp_path / "bag", storage)
    reader = SequentialReader()
    reader.open(options, ConverterOptions("", ""))
    names = {(one.name, one.type) for one in reader.get_all_topics_and_types()}
    assert names == {("/a", "std_msgs/msg/String"), ("/b", "std_msgs/msg/String")}
    assert reader.read_next()[2] == 10**9
    assert _texts(reader) == ["1", "2", "3", "4", "5"]
    with pytest.raises(RuntimeError, match=r"Bag is at end\. No next message"):
        reader.read_next()
    reader.seek(3 * 10**9)
    assert _texts(reader) == ["2", "3", "4", "5"]
    reader.set_filter(StorageFilter(topics=["/a"]))
    reader.seek(1)
    assert _texts(reader) == ["1", "3", "5"]
    reader.reset_filter()
    reader.seek(5 * 10**9)
    assert _texts(reader) == ["4", "5"]
    with pytest.raises(RuntimeError, match="has no topic '/aa'; did you mean '/a'"):
        reader.set_filter(StorageFilter(topics=["/aa"]))
    about = reader.get_metadata()
    assert (about.message_count, about.storage_identifier) == (6, storage)
    assert (about.starting_time.nanoseconds, about.duration.nanoseconds) == (10**9, 5 * 10**9)
    counts = {one.topic_metadata.name: one.message_count for one in about.topics_with_message_count}
    assert counts == {"/a": 3, "/b": 3}


def test_metadata_is_written_again(tmp_path: Path) -> None:
    options = _written(tmp_path / "bag", "mcap")
    (tmp_path / "bag" / "metadata.yaml").unlink()
    Reindexer().reindex(options)
    assert Info().read_metadata(options.uri, "mcap").message_count == 6


def test_ros1_bag_is_read_as_cdr(tmp_path: Path) -> None:
    old: Any = ros1_message_type("std_msgs/String")
    with Bag(tmp_path / "old.bag", "w") as bag:
        bag.write("/a", old("hello"), Time(1))
    reader = SequentialReader()
    reader.open_uri(str(tmp_path / "old.bag"))
    assert _texts(reader) == ["hello"]
    assert reader.get_all_topics_and_types()[0].type == "std_msgs/msg/String"


def test_mistakes_say_what_to_do(tmp_path: Path) -> None:
    options = _written(tmp_path / "bag", "mcap")
    with pytest.raises(RuntimeError, match="Bag directory already exists"):
        SequentialWriter().open(options)
    with pytest.raises(RuntimeError, match="'mcapp' is not known; did you mean 'mcap'"):
        SequentialWriter().open(StorageOptions(str(tmp_path / "x"), "mcapp"))
    with pytest.raises(RuntimeError, match="No storage could be initialized from the inputs"):
        SequentialReader().open(StorageOptions(str(tmp_path / "nope"), "mcap"))
    with pytest.raises(RuntimeError, match=r"Call open\(\) before reading"):
        SequentialReader().has_next()
    writer = SequentialWriter()
    with pytest.raises(RuntimeError, match=r"Call open\(\) before writing"):
        writer.create_topic(TopicMetadata("/a", "std_msgs/msg/String", "cdr"))
    writer.open(StorageOptions(str(tmp_path / "y"), "sqlite3"))
    with pytest.raises(RuntimeError, match=r"Failed to write on topic '/a'\. Call create_topic"):
        writer.write("/a", b"", 0)
    with pytest.raises(RuntimeError, match="serialization format json; this writer writes cdr"):
        writer.create_topic(TopicMetadata(0, "/a", "std_msgs/msg/String", "json"))


def test_default_storage_follows_the_distribution(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_DISTRO", "humble")
    assert get_default_storage_id() == "sqlite3"
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    assert get_default_storage_id() == "mcap"


def test_tutorial_recorder_writes_what_it_hears(passes: Callable[..., Any], tmp_path: Path) -> None:
    passes(
        f"FOLDER = {str(tmp_path / 'my_bag')!r}\n"
        + """
import rclpy
from rclpy.node import Node
from rclpy.serialization import deserialize_message, serialize_message
from rosidl_runtime_py.utilities import get_message
from std_msgs.msg import String
import rosbag2_py
class Recorder(Node):
    def __init__(self):
        super().__init__('simple_bag_recorder')
        self.writer = rosbag2_py.SequentialWriter()
        self.writer.open(rosbag2_py.StorageOptions(uri=FOLDER, storage_id='mcap'),
                         rosbag2_py.ConverterOptions('', ''))
        self.writer.create_topic(rosbag2_py.TopicMetadata(
            name='chatter', type='std_msgs/msg/String', serialization_format='cdr'))
        self.create_subscription(String, 'chatter', self.take, 10)
        self.count = 0
    def take(self, msg):
        self.writer.write('chatter', serialize_message(msg), self.get_clock().now().nanoseconds)
        self.count += 1
rclpy.init()
node = Recorder()
pub = node.create_publisher(String, 'chatter', 10)
while node.count < 3:
    pub.publish(String(data='hello'))
    rclpy.spin_once(node, timeout_sec=1)
del node.writer
reader = rosbag2_py.SequentialReader()
reader.open(rosbag2_py.StorageOptions(uri=FOLDER), rosbag2_py.ConverterOptions('cdr', 'cdr'))
kinds = {t.name: t.type for t in reader.get_all_topics_and_types()}
topic, data, stamp = reader.read_next()
message = deserialize_message(data, get_message(kinds[topic]))
assert message.data == 'hello' and stamp > 10**18
"""
    )


def test_other_serialization_formats_are_refused(tmp_path: Path) -> None:
    options = _written(tmp_path / "bag", "mcap")
    with pytest.raises(RuntimeError, match="Could not find converter for format json"):
        SequentialReader().open(options, ConverterOptions("", "json"))
    options.uri = str(tmp_path / "other")
    with pytest.raises(RuntimeError, match="messages of a bag are cdr here"):
        SequentialWriter().open(options, ConverterOptions("json", "cdr"))
