"""What a bridge is told to do: words of the command line, and its file."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Any

from gazelle.diagnostics import did_you_mean
from gazelle.documents import read_text_limited
from gazelle.documents.yaml import YamlError, load_yaml
from gazelle.errors import LaunchError
from gazelle.parameters.reader import flag_of

__all__ = ["Direction", "ServiceRow", "TopicRow", "read_argument", "read_file"]

_USAGE = """\
usage: parameter_bridge [TOPIC@ROS_TYPE@GZ_TYPE …] [SERVICE@ROS_TYPE[@GZ_REQUEST@GZ_RESPONSE] …]
  in place of the second @: [ from Gazebo to ROS, ] from ROS to Gazebo, @ both ways"""
_TOPIC = re.compile(r"(?P<topic>[^@]+)@(?P<ros>[^@\[\]]+)(?P<sign>[@\[\]])(?P<gz>[^@\[\]]+)")
_SERVICE = re.compile(r"(?P<service>[^@]+)@(?P<kind>[^@\[\]]+/srv/[^@\[\]]+)(@[^@]+@[^@]+)?")
_KEYS = frozenset(
    {
        *("topic_name", "ros_topic_name", "gz_topic_name", "ros_type_name", "gz_type_name"),
        *("direction", "publisher_queue", "subscriber_queue", "lazy"),
        # Service bridges, since Jazzy.
        *("service_name", "gz_req_type_name", "gz_rep_type_name"),
    }
)


class Direction(Enum):
    """Where messages go."""

    BIDIRECTIONAL = "@"
    GZ_TO_ROS = "["
    ROS_TO_GZ = "]"


@dataclass(frozen=True, slots=True)
class TopicRow:
    """A topic to bridge.

    Attributes:
        ros_topic, gz_topic: as written.
        ros_type: ``pkg/msg/Name`` or ``pkg/Name``.
        gz_type: ``gz.msgs.Name``.
        queue_size: of what is published on the side of ROS.
        lazy: listen only while somebody listens on the other side.
    """

    ros_topic: str
    gz_topic: str
    ros_type: str
    gz_type: str
    direction: Direction = Direction.BIDIRECTIONAL
    queue_size: int = 10
    lazy: bool = False


@dataclass(frozen=True, slots=True)
class ServiceRow:
    """A service of Gazebo to offer in ROS."""

    name: str
    ros_type: str


def read_argument(word: str) -> TopicRow | ServiceRow:
    """Read a word of the command line.

    Raises:
        LaunchError: it has another form.
    """
    service = _SERVICE.fullmatch(word)
    if service is not None:
        return ServiceRow(service["service"], service["kind"])
    topic = _TOPIC.fullmatch(word)
    if topic is None:
        raise LaunchError(f"'{word}' is no bridge\n{_USAGE}")
    return TopicRow(
        topic["topic"], topic["topic"], topic["ros"], topic["gz"], Direction(topic["sign"])
    )


def read_file(path: Path) -> tuple[list[TopicRow | ServiceRow], list[str]]:
    """Return the rows of a bridge's YAML file, and what is wrong with others of it.

    Raises:
        LaunchError: it cannot be read or is no list.
    """
    try:
        rows = load_yaml(read_text_limited(path))
    except OSError as error:
        raise LaunchError(
            f"Could not parse config: failed to open file [{path}]: {error}"
        ) from None
    except (UnicodeDecodeError, YamlError) as error:
        raise LaunchError(f"Could not parse config: {path}: {error}") from error
    if not isinstance(rows, list):
        what = "file empty" if rows is None else "top level must be a YAML sequence"
        raise LaunchError(f"Could not parse config: {what} [{path}]")
    found: list[TopicRow | ServiceRow] = []
    wrong: list[str] = []
    for number, row in enumerate(rows, 1):
        try:
            found.append(_row(row, wrong, f"{path}, entry {number}"))
        except ValueError as error:
            wrong.append(f"Could not parse entry: {error} ({path}, entry {number})")
    return found, wrong


def _row(row: Any, wrong: list[str], place: str) -> TopicRow | ServiceRow:
    if not isinstance(row, Mapping):
        raise ValueError("entry must be a YAML map")
    for key in row.keys() - _KEYS:
        hint = did_you_mean(str(key), sorted(_KEYS)) or f"there are {', '.join(sorted(_KEYS))}"
        wrong.append(f"'{key}' is not read; {hint} ({place})")
    text = {key: str(row.get(key) or "") for key in _KEYS}
    if text["service_name"]:
        return ServiceRow(text["service_name"], text["ros_type_name"])
    for other in ("ros_topic_name", "gz_topic_name"):
        if text["topic_name"] and text[other]:
            raise ValueError(f"topic_name and {other} are mutually exclusive")
    if not text["ros_type_name"] or not text["gz_type_name"]:
        raise ValueError("both ros_type_name and gz_type_name must be set")
    either = text["topic_name"] or text["ros_topic_name"] or text["gz_topic_name"]
    if not either:
        raise ValueError("one of topic_name, ros_topic_name and gz_topic_name must be set")
    return TopicRow(
        text["ros_topic_name"] or either,
        text["gz_topic_name"] or either,
        text["ros_type_name"],
        text["gz_type_name"],
        _direction(text["direction"]),
        _whole(row.get("publisher_queue", 10), "publisher_queue"),
        _truth(row.get("lazy", False), "lazy"),
    )


def _direction(word: str) -> Direction:
    if word and word not in Direction.__members__:
        known = ", ".join(Direction.__members__)
        raise ValueError(f"invalid direction [{word}]; there are {known}")
    return Direction[word] if word else Direction.BIDIRECTIONAL


def _truth(value: Any, name: str) -> bool:
    found = flag_of(value)
    if found is None:
        raise ValueError(f"{name} is true or false, not {value!r}")
    return found


def _whole(value: Any, name: str) -> int:
    if not isinstance(value, int) or isinstance(value, bool) or value < 0:
        raise ValueError(f"{name} is a whole number, not {value!r}")
    return value
