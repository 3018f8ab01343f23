"""``metadata.yaml`` of rosbag2, version 8 (Jazzy); versions 1 to 9 are read."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from gazelle.bag.storage import BagError, Connection, Summary
from gazelle.documents.yaml import YamlError, YamlStyle, dump_yaml, load_yaml, load_yaml_file
from gazelle.graph import Qos

__all__ = [
    "METADATA",
    "FileSummary",
    "Metadata",
    "offered_qos",
    "read_metadata",
    "read_qos",
    "write_metadata",
]


_ENDLESS = "  {}:\n    sec: 9223372036\n    nsec: 854775807\n"

_LATCHED_WORDS = (1, "transient_local")

_BEST_EFFORT_WORDS = (2, "best_effort")


def offered_qos(*, reliable: bool = True, latched: bool = False, depth: int = 10) -> str:
    """Return the profile of one publisher, as version 8 of the metadata writes it."""
    return (
        f"- history: 1\n  depth: {depth}\n"
        f"  reliability: {1 if reliable else 2}\n  durability: {1 if latched else 2}\n"
        + _ENDLESS.format("deadline")
        + _ENDLESS.format("lifespan")
        + "  liveliness: 1\n"
        + _ENDLESS.format("liveliness_lease_duration")
        + "  avoid_ros_namespace_conventions: false"
    )


def read_qos(text: str) -> Qos:
    """Return what the first profile asks for; the default where the text says nothing."""
    try:
        profiles = load_yaml(text) if text else None
    except YamlError:
        profiles = None
    if not isinstance(profiles, list) or not profiles or not isinstance(profiles[0], dict):
        return Qos()
    one = profiles[0]
    depth = one.get("depth")
    return Qos(
        one.get("reliability") not in _BEST_EFFORT_WORDS,
        one.get("durability") in _LATCHED_WORDS,
        depth if isinstance(depth, int) and depth > 0 else Qos().depth,
    )


METADATA = "metadata.yaml"

_ROOT = "rosbag2_bagfile_information"

_VERSION = 8


class FileSummary(NamedTuple):
    """One file of a bag and what is in it."""

    path: Path
    summary: Summary


class Metadata(NamedTuple):
    """What is read back from the file.

    Attributes:
        storage: such as ``mcap`` or ``sqlite3``.
        files: relative to the folder.
        compression_mode: ``file``, ``message`` or empty.
        compression_format: such as ``zstd``.
        ros_distro: who recorded it, empty when it is not said.
        custom_data: what the recorder's user added.
    """

    storage: str
    files: tuple[str, ...]
    compression_mode: str = ""
    compression_format: str = ""
    ros_distro: str = ""
    custom_data: dict[str, str] | None = None


def read_metadata(folder: Path) -> Metadata | None:
    """Return what a bag's ``metadata.yaml`` says, None when there is none.

    Raises:
        BagError: it cannot be read as such.
    """
    path = folder / METADATA
    if not path.is_file():
        return None
    try:
        root = load_yaml_file(path)[_ROOT]
        return Metadata(
            str(root["storage_identifier"]),
            tuple(map(str, root["relative_file_paths"])),
            str(root.get("compression_mode") or "").lower(),
            str(root.get("compression_format") or ""),
            str(root.get("ros_distro") or ""),
            root.get("custom_data") or {},
        )
    except (YamlError, KeyError, TypeError) as error:
        text = f"{path}: this is no metadata of rosbag2: {error}"
        raise BagError(f"{text}; `ros2 bag reindex {folder}` writes it anew") from None


def write_metadata(
    folder: Path,
    storage: str,
    counts: Sequence[tuple[Connection, int]],
    files: Sequence[FileSummary],
    custom_data: dict[str, str] | None = None,
) -> None:
    """Write a bag's ``metadata.yaml``.

    Args:
        folder: the bag.
        storage: of its files.
        counts: topics with their numbers of messages.
        files: with their summaries.
        custom_data: pairs that the user added.
    """
    filled = [one.summary for one in files if one.summary.messages]
    start_ns = min((one.start_ns for one in filled), default=0)
    end_ns = max((one.end_ns for one in filled), default=0)
    root = {
        "version": _VERSION,
        "storage_identifier": str(storage),
        "duration": {"nanoseconds": end_ns - start_ns},
        "starting_time": {"nanoseconds_since_epoch": start_ns},
        "message_count": sum(one.messages for one in filled),
        "topics_with_message_count": [_topic(*pair) for pair in counts],
        "compression_format": "",
        "compression_mode": "",
        "relative_file_paths": [one.path.name for one in files],
        "files": [_file(one) for one in files],
        "custom_data": custom_data or None,
        "ros_distro": os.environ.get("ROS_DISTRO", "unknown"),
    }
    text = dump_yaml({_ROOT: root}, YamlStyle(sort_keys=False))
    part = folder / f"{METADATA}.part"
    part.write_text(text, encoding="utf-8")
    part.replace(folder / METADATA)


def _topic(one: Connection, count: int) -> dict[str, Any]:
    return {
        "topic_metadata": {
            "name": one.topic,
            "type": one.type_name,
            "serialization_format": "cdr",
            "offered_qos_profiles": one.qos,
            "type_description_hash": one.type_hash,
        },
        "message_count": count,
    }


def _file(one: FileSummary) -> dict[str, Any]:
    return {
        "path": one.path.name,
        "starting_time": {"nanoseconds_since_epoch": one.summary.start_ns},
        "duration": {"nanoseconds": one.summary.duration_ns},
        "message_count": one.summary.messages,
    }
