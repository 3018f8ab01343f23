"""Bags of ROS 1 and ROS 2, in every compression that is read."""

from __future__ import annotations

import contextlib
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from tests.fuzzing.kind import Kind

from gazelle.bag import (
    BagReader,
    Storage,
    bag_types,
    cdr_connection,
    create_bag,
    open_bag,
    ros1_connection,
)
from gazelle.bag.compression_formats import compress_zstd
from gazelle.bag.export import reader_of, row_of
from gazelle.bag.playing.player import outgoing
from gazelle.bag.rosbag2.folder import Rosbag2, reindex
from gazelle.bag.rosbag2.metadata import read_qos
from gazelle.bag.types import split_texts
from gazelle.diagnostics import Diagnostics
from gazelle.interfaces import RosVersion, message_type, ros1_message_type, to_cdr, to_ros1
from gazelle.interfaces.parser import parse_message
from gazelle.workspace import Workspace

__all__ = ["BAGS"]

_BEGIN_NS = 1_700_000_000_000_000_000
_METADATA = "metadata.yaml"


def _bag(path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    with contextlib.closing(open_bag(path)) as bag:
        _look_through(bag, diagnostics)


def _file_of_folder(path: Path, diagnostics: Diagnostics, workspace: Workspace) -> None:
    """Read a file, then write the description that its folder lacks."""
    _bag(path, diagnostics, workspace)
    reindex(path.parent)
    (path.parent / _METADATA).unlink()


def _metadata(path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    beside = path.with_name("a_0.mcap")
    if not beside.exists():
        beside.write_bytes(_written(Storage.MCAP, beside.name, ""))
    with contextlib.closing(Rosbag2(path.parent)) as bag:
        _look_through(bag, diagnostics)


def _look_through(bag: BagReader, diagnostics: Diagnostics) -> None:
    """Do what is done to bags: tell what is in them, play them, make tables of them."""
    summary, errors, types = bag.summary, [], bag_types(bag.connections).store
    assert summary.messages >= 0 or summary.duration_ns
    for one in bag.connections:
        ros_version = RosVersion.ROS2 if bag.storage != Storage.ROS1 else RosVersion.ROS1
        for name, text in split_texts(one):
            parse_message(text, name, ros_version, diagnostics=diagnostics)
        if one.qos:
            read_qos(one.qos)
    played = outgoing(
        [bag], lambda _: True, 0, None, lambda _one, error: errors.append(error), [types]
    )
    for _ in played:
        pass
    for message in bag.messages(lambda one: one.topic != "/b", _BEGIN_NS, _BEGIN_NS + 10):
        row_of(message.stamp_ns, reader_of(message.connection, types)(message.data))
    if errors:
        raise errors[0]


def _messages(make: Callable[[str], Any]) -> tuple[tuple[str, Any], ...]:
    said = make("std_msgs/String")
    said.data = "hello"
    led = make("geometry_msgs/Twist")
    led.linear.x = 1.5
    return ("/a", said), ("/b", led)


def _written(storage: Storage, name: str, compression: str) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / name
        writer = create_bag(path, storage, compression=compression)
        is_old = storage is Storage.ROS1
        make = ros1_message_type if is_old else message_type
        for topic, message in _messages(lambda text: make(text if is_old else _long(text))()):
            type_name = message._type if is_old else message.TYPE_NAME
            one = writer.add((ros1_connection if is_old else cdr_connection)(topic, type_name))
            for count in range(2):
                data = to_ros1(message) if is_old else to_cdr(message)
                writer.write(one, _BEGIN_NS + count, data)
        writer.close()
        return path.read_bytes()


def _long(name: str) -> str:
    return name.replace("/", "/msg/")


def _of_whole_folder() -> bytes:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "a_0.mcap").write_bytes(_written(Storage.MCAP, "a_0.mcap", ""))
        reindex(folder)
        return (folder / _METADATA).read_bytes()


def _packed() -> bytes:
    return compress_zstd(_written(Storage.MCAP, "a.mcap", ""))


def _kind(storage: Storage, name: str, compression: str = "") -> Kind:
    read = _file_of_folder if storage is Storage.SQLITE else _bag
    return Kind(partial(_written, storage, name, compression), name, read)


BAGS: dict[str, Kind] = {
    "bag": _kind(Storage.ROS1, "a.bag"),
    "bag_bz2": _kind(Storage.ROS1, "a.bag", "bz2"),
    "bag_lz4": _kind(Storage.ROS1, "a.bag", "lz4"),
    "bag_metadata": Kind(_of_whole_folder, _METADATA, _metadata),
    "bag_zstd_file": Kind(_packed, "a.mcap.zstd", _bag),
    "db3": _kind(Storage.SQLITE, "a_0.db3"),
    "mcap": _kind(Storage.MCAP, "a.mcap"),
    "mcap_lz4": _kind(Storage.MCAP, "a.mcap", "lz4"),
    "mcap_zstd": _kind(Storage.MCAP, "a.mcap", "zstd"),
}
