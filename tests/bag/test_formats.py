"""Every format gives back what was written, and other programs' bags are read."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.bag import BagError, Storage, create_bag, open_bag
from gazelle.interfaces import md5sum

START_NS = 1_700_000_000_000_000_000
FORMATS = [
    ("a.bag", {}),
    ("a.bag", {"compression": "bz2"}),
    ("a.bag", {"compression": "lz4", "chunk_bytes": 500}),
    ("a.mcap", {"chunk_bytes": 500}),
    ("a.mcap", {"compression": "lz4"}),
    ("a.mcap", {"compression": "zstd"}),
    ("a.db3", {}),
    ("folder", {"storage": Storage.MCAP}),
    ("folder", {"storage": Storage.SQLITE}),
]


@pytest.mark.parametrize(("name", "options"), FORMATS)
def test_what_is_written_is_read(bag_of: Callable, name: str, options: dict[str, Any]) -> None:
    bag = open_bag(bag_of(name, **options))
    summary = bag.summary
    assert summary.messages == 100 and summary.is_indexed and summary.lost == 0
    assert (summary.start_ns, summary.duration_ns) == (START_NS, 990_000_000)
    messages = list(bag.messages())
    assert [one.stamp_ns for one in messages] == [START_NS + k * 10_000_000 for k in range(100)]
    assert b"word 99" in messages[-1].data
    assert {one.topic for one in bag.connections} == {"/point", "/word"}
    bag.close()


@pytest.mark.parametrize(("name", "options"), FORMATS)
def test_topics_and_times_are_chosen(bag_of: Callable, name: str, options: dict[str, Any]) -> None:
    bag = open_bag(bag_of(name, **options))
    found = bag.messages(
        lambda one: one.topic == "/word", START_NS + 200_000_000, START_NS + 300_000_000
    )
    assert [one.stamp_ns - START_NS for one in found] == [
        210_000_000, 230_000_000, 250_000_000, 270_000_000, 290_000_000,
    ]  # fmt: skip
    bag.close()


@pytest.mark.parametrize("name", ["a.bag", "a.mcap"])
@pytest.mark.parametrize("share", [0.3, 0.6, 0.95])
def test_a_file_that_ends_anywhere_gives_its_whole_chunks(
    bag_of: Callable, name: str, share: float
) -> None:
    path = bag_of(name, chunk_bytes=400)
    data = path.read_bytes()
    path.write_bytes(data[: int(len(data) * share)])
    bag = open_bag(path)
    messages = list(bag.messages())
    assert bag.summary.messages == len(messages)
    assert 0 < len(messages) <= 100
    assert [one.stamp_ns for one in messages] == [
        START_NS + k * 10_000_000 for k in range(len(messages))
    ]
    bag.close()


def test_a_bag_shorter_than_its_header_is_empty(tmp_path: Path) -> None:
    path = tmp_path / "a.bag"
    path.write_bytes(b"#ROSBAG V2.0\n" + b"\x45\0\0\0")
    assert open_bag(path).summary.messages == 0


@pytest.mark.parametrize(
    ("name", "data", "words"),
    [
        ("a.bag", b"hello", "This does not appear to be a bag file"),
        ("a.bag", b"#ROSBAG V1.2\n", "a bag of version 1.2"),
        ("a.mcap", b"", "the file is empty"),
    ],
)
def test_other_files_are_refused(tmp_path: Path, name: str, data: bytes, words: str) -> None:
    (tmp_path / name).write_bytes(data)
    with pytest.raises(BagError, match=words):
        open_bag(tmp_path / name)


def test_a_missing_file_names_the_one_that_is_meant(bag_of: Callable) -> None:
    path = bag_of("recording.bag", 2)
    with pytest.raises(BagError, match=r"did you mean 'recording\.bag'"):
        open_bag(path.with_name("recordng.bag"))


def test_an_empty_folder_is_no_bag(tmp_path: Path) -> None:
    with pytest.raises(BagError, match=r"no \.mcap and no \.db3"):
        open_bag(tmp_path)


def test_a_format_refuses_compressions_it_does_not_know(tmp_path: Path) -> None:
    with pytest.raises(BagError, match="rosbag knows no compression 'zstd', but none, bz2, lz4"):
        create_bag(tmp_path / "a.bag", Storage.ROS1, compression="zstd")


@pytest.mark.reference
def test_real_bags_are_read_and_their_sums_are_ours(oracles_dir: Path) -> None:
    for name, count in (("t.bag", 77), ("tf.bag", 38)):
        bag = open_bag(oracles_dir / "ros_live" / name)
        assert len(list(bag.messages())) == bag.summary.messages == count
        assert all(md5sum(one.type_name) == one.md5sum for one in bag.connections)


@pytest.mark.reference
@pytest.mark.parametrize(("name", "options"), FORMATS[:3])
def test_rosbags_reads_ros1_bags(bag_of: Callable, name: str, options: dict[str, Any]) -> None:
    rosbag1 = pytest.importorskip("rosbags.rosbag1")
    path = bag_of(name, **options)
    with rosbag1.Reader(path) as reader:
        theirs = [(one.topic, stamp, bytes(data)) for one, stamp, data in reader.messages()]
        assert {one.digest for one in reader.connections} == {
            md5sum("geometry_msgs/PointStamped"), md5sum("std_msgs/String"),
        }  # fmt: skip
    ours = [(one.connection.topic, one.stamp_ns, one.data) for one in open_bag(path).messages()]
    assert theirs == ours


@pytest.mark.reference
@pytest.mark.parametrize("storage", [Storage.MCAP, Storage.SQLITE])
def test_rosbags_reads_rosbag2_folders(bag_of: Callable, storage: Storage) -> None:
    rosbag2 = pytest.importorskip("rosbags.rosbag2")
    path = bag_of("folder", storage=storage)
    with rosbag2.Reader(path) as reader:
        theirs = [(one.topic, stamp, bytes(data)) for one, stamp, data in reader.messages()]
    ours = [(one.connection.topic, one.stamp_ns, one.data) for one in open_bag(path).messages()]
    assert theirs == ours


@pytest.mark.reference
@pytest.mark.parametrize("compression", ["", "lz4", "zstd"])
def test_mcap_reads_our_files(bag_of: Callable, compression: str) -> None:
    reader_of = pytest.importorskip("mcap.reader").make_reader
    path = bag_of("a.mcap", compression=compression, chunk_bytes=1000)
    with path.open("rb") as file:
        reader = reader_of(file)
        assert reader.get_summary().statistics.message_count == 100
        stamps = [message.log_time for _, _, message in reader.iter_messages()]
    assert stamps == [START_NS + k * 10_000_000 for k in range(100)]
