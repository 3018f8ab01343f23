"""``-b FILE`` of ``rostopic echo``, ``list``, ``hz``, ``bw`` and of ``rosmsg show``."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from optparse import Values
from pathlib import Path
from typing import Any

from gazelle.bag import (
    BagMessage,
    BagReader,
    Connection,
    Encoding,
    learn_definitions,
    open_bag,
    ros1_name_of,
)
from gazelle.bag.open_bag import warn_of_unindexed
from gazelle.cli.ros_tool import ToolError, hint
from gazelle.cli.ros_types import learn_workspace_types, topic_class
from gazelle.cli.rostopic.topics import FoundTopic, find_topic
from gazelle.cli.text.fields import Step
from gazelle.graph import Entity, Kind
from gazelle.interfaces import from_cdr, from_ros1, wire_type

__all__ = ["BagClock", "bandwidth_of_bag", "echo_bag", "list_bag", "opened", "rate_of_bag"]


class BagClock:
    """A clock that shows the stamp of the message at hand."""

    def __init__(self) -> None:
        """Start at zero."""
        self.stamp_ns = 0

    def now_ns(self) -> int:
        """Return the stamp."""
        return self.stamp_ns


def opened(path: str) -> BagReader:
    """Return the bag; the types it holds are known from now on.

    Raises:
        ToolError: there is no such file.
        BagError: it is no bag.
    """
    if not Path(path).exists():
        folder = Path(path).parent
        names = [one.name for one in folder.iterdir()] if folder.is_dir() else []
        raise ToolError(f"bag file [{path}] does not exist{hint(Path(path).name, names)}")
    bag = open_bag(path)
    warn_of_unindexed(bag)
    learn_workspace_types()
    learn_definitions(bag.connections)
    return bag


def list_bag(path: str, below: str = "") -> int:
    """Print the topics of a bag, in the order of their connections."""
    names = dict.fromkeys(one.topic for one in opened(path).connections)
    start = below.rstrip("/") + "/"
    for name in names:
        if not below or name == below or name.startswith(start):
            print(name)
    return 0


def echo_bag(
    path: str, word: str, make: Callable[[FoundTopic, BagClock], Any], options: Values
) -> int:
    """Print messages of a bag.

    Args:
        path: the bag.
        word: topic, or topic and field; empty with ``-a``, for all.
        make: makes the printer of a topic from the topic and the clock.
        options: of ``rostopic echo``.
    """
    bag, clock = opened(path), BagClock()
    kinds = {one.topic: one for one in bag.connections}
    steps: dict[str, tuple[Step, ...]] = dict.fromkeys(kinds, ())
    if not options.all_topics:
        found = find_topic([_entity(one) for one in kinds.values()], word)
        if found is None:
            raise ToolError(f"topic [{word}] is not in bag file [{path}]{hint(word, kinds)}")
        steps = {found.name: found.steps}
    echoes: dict[str, Any] = {}
    for one, stamp_ns, data in bag.messages(lambda item: item.topic in steps):
        if one.topic not in echoes:
            echoes[one.topic] = make(_found(one, steps[one.topic]), clock)
        echo, clock.stamp_ns = echoes[one.topic], stamp_ns
        echo(_read(one, data))
        if echo.error is not None:
            raise echo.error
        if echo.done.is_set() and len(steps) == 1:
            break
    return 0


def rate_of_bag(
    path: str,
    counts: Mapping[str, Callable[[float], None]],
    wanted: Callable[[str, Any], bool] | None,
) -> None:
    """Count the messages of a bag by their stamps; only those that are `wanted`, if it is given."""
    for one, stamp_ns, data in _chosen(path, counts):
        if wanted is None or wanted(one.topic, _read(one, data)):
            counts[one.topic](stamp_ns / 1e9)


def bandwidth_of_bag(path: str, topic: str, count: Callable[[float, int], None]) -> float:
    """Count the bytes of a topic of a bag; return the time of its last message in seconds."""
    stamp_ns = 0
    for _, stamp_ns, data in _chosen(path, (topic,)):
        count(stamp_ns / 1e9, len(data))
    return stamp_ns / 1e9


def _chosen(path: str, topics: Iterable[str]) -> Iterator[BagMessage]:
    """Yield the messages of topics, all of which must be in the bag."""
    bag, names = opened(path), set(topics)
    known = {one.topic for one in bag.connections}
    for word in sorted(names - known):
        raise ToolError(f"topic [{word}] is not in bag file [{path}]{hint(word, sorted(known))}")
    return bag.messages(lambda one: one.topic in names)


def _found(one: Connection, steps: tuple[Step, ...]) -> FoundTopic:
    return FoundTopic(one.topic, ros1_name_of(one), steps)


def _read(one: Connection, data: bytes) -> Any:
    read = from_ros1 if one.encoding is Encoding.ROS1 else from_cdr
    return read(topic_class(ros1_name_of(one)), data)


def _entity(one: Connection) -> Entity:
    return Entity("", 0, one.id, Kind.PUBLISHER, "/bag", one.topic, wire_type(ros1_name_of(one)))
