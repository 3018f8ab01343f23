"""rostopic's functions: types and lists of topics."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from gazelle.compat.rospy.state import STATE
from gazelle.interfaces import ros1_message_type, ros1_type_of

__all__ = [
    "ROSTopicException",
    "ROSTopicIOException",
    "find_by_type",
    "get_info_text",
    "get_topic_class",
    "get_topic_list",
    "get_topic_type",
]

_PAUSE_S = 0.05
Row = tuple[str, str, list[str]]


class ROSTopicException(Exception):  # noqa: N818 - rostopic's name
    """A question about a topic has no answer."""


class ROSTopicIOException(ROSTopicException):
    """The graph cannot be reached."""


def get_topic_type(
    topic: str, blocking: bool = False
) -> tuple[str | None, str | None, Callable[[Any], Any] | None]:
    """Return a topic's type, its real name, and a function that takes a field of it.

    Args:
        topic: a topic, or a topic with fields behind it, such as ``/odom/pose/pose``.
        blocking: wait until somebody offers it.
    """
    from gazelle.compat.rospy.client import is_shutdown

    plain, bracket, index = topic.partition("[")
    wanted = STATE.resolved(plain) + bracket + index
    while True:
        known = {one.name: one.type_name for one in STATE.open_graph().topics()}
        found = max((name for name in known if _covers(name, wanted)), key=len, default=None)
        if found is not None and known[found] != "*":
            return ros1_type_of(known[found]), found, _taker(wanted.removeprefix(found))
        if not blocking or is_shutdown():
            return None, None, None
        time.sleep(_PAUSE_S)


def get_topic_class(
    topic: str, blocking: bool = False
) -> tuple[Any, str | None, Callable[[Any], Any] | None]:
    """Return a topic's class, its real name, and a function that takes a field of it.

    Raises:
        ROSTopicException: nothing defines the type.
    """
    from gazelle.errors import GazelleError

    name, real, take = get_topic_type(topic, blocking)
    if name is None:
        return None, None, None
    try:
        return ros1_message_type(name), real, take
    except GazelleError as error:
        raise ROSTopicException(f"Cannot load message class for [{name}]: {error}") from error


def get_topic_list(master: Any = None) -> tuple[list[Row], list[Row]]:
    """Return name, type and nodes of published and of subscribed topics.

    Args:
        master: without effect: a `rosgraph.Master` answers from the same graph, and has said so
            where it was made for another one.
    """
    topics = STATE.open_graph().topics()
    rows = [(one, ros1_type_of(one.type_name)) for one in topics]
    publishers = [(one.name, kind, list(one.publishers)) for one, kind in rows if one.publishers]
    subscribers = [
        (one.name, kind, list(one.subscriptions)) for one, kind in rows if one.subscriptions
    ]
    return publishers, subscribers


def find_by_type(topic_type: str) -> list[str]:
    """Return the topics of a type."""
    topics = STATE.open_graph().topics()
    return [one.name for one in topics if ros1_type_of(one.type_name) == topic_type]


def get_info_text(topic: str) -> str:
    """Return type, publishers and subscribers as text.

    Raises:
        ROSTopicException: nobody offers the topic.
    """
    name = STATE.resolved(topic)
    found = next((one for one in STATE.open_graph().topics() if one.name == name), None)
    if found is None:
        raise ROSTopicException(f"Unknown topic {topic}")
    parts = [f"Type: {ros1_type_of(found.type_name)}\n\n"]
    for word, nodes in (("Publishers", found.publishers), ("Subscribers", found.subscriptions)):
        rows = "".join(f" * {node}\n" for node in nodes)
        parts.append(f"{word}: \n{rows}\n" if rows else f"{word}: None\n\n")
    return "".join(parts)


def _covers(name: str, wanted: str) -> bool:
    return wanted == name or wanted.startswith((f"{name}/", f"{name}["))


def _taker(path: str) -> Callable[[Any], Any] | None:
    """Return what takes ``/pose/position`` or ``/ranges[0]`` of a message; None for all of it."""
    words = [word for word in path.replace("[", "/[").split("/") if word]
    if not words:
        return None

    def take(message: Any) -> Any:
        for word in words:
            index = word[1:-1] if word.startswith("[") else None
            message = getattr(message, word) if index is None else message[int(index)]
        return message

    return take
