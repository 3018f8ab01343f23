"""Which topic, and which field of it, a word means; the node of subcommands that go on."""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterable
from typing import NamedTuple

from gazelle.cli.ros_tool import hint
from gazelle.cli.ros_types import message_class, shown_type
from gazelle.cli.text.fields import Step, has_field, parse_path
from gazelle.errors import GazelleError
from gazelle.graph import ANY_TYPE, Entity, Graph, Node, TopicInfo
from gazelle.graph.graph_info import topics_of

__all__ = ["FoundTopic", "find_topic", "join_as_node", "uses_sim_time", "wait_for_topic"]

_LOOK_S = 1.0


class FoundTopic(NamedTuple):
    """A topic and the path to the field that was asked for.

    Attributes:
        name: global name of the topic.
        type_name: as ROS 1 shows it, ``pkg/Name``.
        steps: to the field, none for the whole message.
    """

    name: str
    type_name: str
    steps: tuple[Step, ...]


def join_as_node(
    graph: Graph, *, clock: bool = True, rosout: bool = True
) -> tuple[Node, threading.Event]:
    """Return a node of a name of its own, and the event of its end (``rosnode kill``).

    Args:
        graph: the graph.
        clock: follow ``/clock`` while ``/use_sim_time`` is true.
        rosout: announce ``/rosout``.
    """
    node = graph.create_node("rostopic", anonymous=True, rosout=rosout)
    ended = threading.Event()
    node.on_shutdown(lambda _reason: ended.set())
    if clock:
        graph.clock.follow(node)
    return node, ended


def uses_sim_time(graph: Graph) -> bool:
    """Return whether the parameter says that time is simulated."""
    return graph.parameters.get("/use_sim_time", False) is True


def find_topic(entities: Iterable[Entity], word: str) -> FoundTopic | None:
    """Return the topic of this name; else the longest that is a start of it and has the field.

    Raises:
        ToolError: the field is written in a wrong way.
    """
    topics = {one.name: one for one in topics_of(entities, include_hidden=True)}
    if word in topics:
        return _found(topics[word], ())
    for one in sorted(_starts_of(word, topics), reverse=True):
        steps = parse_path(word[len(one) :])
        if not _lacks_field(topics[one], steps):
            return _found(topics[one], steps)
    return None


def wait_for_topic(graph: Graph, word: str) -> FoundTopic:
    """Return the topic; when it is not there, say so and wait until it is.

    Raises:
        ToolError: the field is written in a wrong way.
    """
    entities = graph.entities()
    found = find_topic(entities, word)
    if found is not None:
        return found
    sys.stderr.write(f"WARNING: topic [{word}] does not appear to be published yet\n")
    sys.stderr.write(_advice(entities, word))
    sys.stderr.flush()
    while found is None:
        graph.discovery.wait_for(lambda known: find_topic(known, word) is not None, _LOOK_S)
        found = find_topic(graph.discovery.known(), word)
    return found


def _found(topic: TopicInfo, steps: tuple[Step, ...]) -> FoundTopic | None:
    if topic.type_name == ANY_TYPE:
        return None
    return FoundTopic(topic.name, shown_type(topic.type_name), steps)


def _starts_of(word: str, topics: Iterable[str]) -> list[str]:
    return [name for name in topics if word.startswith(f"{name}/")]


def _lacks_field(topic: TopicInfo, steps: tuple[Step, ...]) -> bool:
    """Return whether the topic cannot be meant; where its type is not known, it may be."""
    if topic.type_name == ANY_TYPE:
        return False
    try:
        return not has_field(message_class(topic.type_name)(), steps)
    except GazelleError:
        return False


def _advice(entities: Iterable[Entity], word: str) -> str:
    """Return lines about what is there and was perhaps meant, empty when there is nothing."""
    topics = {one.name: one for one in topics_of(entities)}
    for name in sorted(_starts_of(word, topics), reverse=True):
        fields = _field_names(topics[name])
        if fields:
            kind = shown_type(topics[name].type_name)
            return f"  {name} is published; the fields of {kind}: {', '.join(fields)}\n"
    near = hint(word, list(topics)).lstrip("\n")
    return f"{near}\n" if near else ""


def _field_names(topic: TopicInfo) -> tuple[str, ...]:
    try:
        return () if topic.type_name == ANY_TYPE else message_class(topic.type_name)._names
    except GazelleError:
        return ()
