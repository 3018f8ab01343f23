"""Checking and expanding names (rclpy.validate_topic_name, rclpy.expand_topic_name and kin).

Rules and texts are those of rmw and rcl (``validate_full_topic_name``, ``validate_topic_name``).
"""

from __future__ import annotations

import re
from typing import Literal, NamedTuple

from gazelle.compat.rclpy.exceptions import (
    InvalidNamespaceException,
    InvalidNodeNameException,
    InvalidParameterException,
    InvalidServiceNameException,
    InvalidTopicNameException,
)

__all__ = [
    "TOPIC_SEPARATOR_STRING",
    "expand_topic_name",
    "validate_full_topic_name",
    "validate_namespace",
    "validate_node_name",
    "validate_parameter_name",
    "validate_topic_name",
]

TOPIC_SEPARATOR_STRING = "/"


class _Fault(NamedTuple):
    """What is wrong with a name, and at which character."""

    text: str
    position: int


_SUBSTITUTION = re.compile(r"\{([^{}]*)\}")


def validate_topic_name(name: str, *, is_service: bool = False) -> Literal[True]:
    """Return True for a topic's name as programs write it: relative, private or global.

    Raises:
        InvalidTopicNameException, InvalidServiceNameException: it is not legal.
    """
    _raise_topic(name, _topic_fault(name), is_service)
    return True


def validate_full_topic_name(name: str, *, is_service: bool = False) -> Literal[True]:
    """Return True for a legal global name of a topic.

    Raises:
        InvalidTopicNameException, InvalidServiceNameException: it is not legal.
    """
    _raise_topic(
        name, _full_fault(name, "topic name", end="topic name must not end with a '/'"), is_service
    )
    return True


def validate_namespace(namespace: str) -> Literal[True]:
    """Return True for a legal namespace.

    Raises:
        InvalidNamespaceException: it is not.
    """
    end = "namespace must not end with a '/', unless only a '/'"
    fault = None if namespace == "/" else _full_fault(namespace, "namespace", end=end)
    if fault is not None:
        raise InvalidNamespaceException(namespace, *fault)
    return True


def validate_node_name(node_name: str) -> Literal[True]:
    """Return True for a legal name of a node.

    Raises:
        InvalidNodeNameException: it is not.
    """
    fault = _node_fault(node_name)
    if fault is not None:
        raise InvalidNodeNameException(node_name, *fault)
    return True


def validate_parameter_name(name: str) -> Literal[True]:
    """Return True for a legal name of a parameter.

    Raises:
        InvalidParameterException: it is empty.
    """
    if not name:
        raise InvalidParameterException(name)
    return True


def expand_topic_name(topic_name: str, node_name: str, node_namespace: str) -> str:
    """Return a topic's global name; ``~``, ``{node}``, ``{ns}`` and ``{namespace}`` are filled in.

    Raises:
        ValueError: one of the names is not legal, or a substitution is not known.
    """
    space_end = "namespace must not end with a '/', unless only a '/'"
    space_fault = (
        None if node_namespace == "/" else _full_fault(node_namespace, "namespace", end=space_end)
    )
    for kind, name, fault in (
        ("topic name", topic_name, _topic_fault(topic_name)),
        ("node name", node_name, _node_fault(node_name)),
        ("node namespace", node_namespace, space_fault),
    ):
        if fault is not None:
            raise ValueError(f"{kind} '{name}' is invalid: {fault.text}")
    space = node_namespace.rstrip("/")
    known = {"node": node_name, "ns": node_namespace, "namespace": node_namespace}

    def fill(match: re.Match[str]) -> str:
        if match[1] not in known:
            text = f"topic name '{topic_name}' is invalid: unknown substitution: {match[0]}"
            raise ValueError(f"{text}; known are {{node}}, {{ns}} and {{namespace}}")
        return known[match[1]]

    name = _SUBSTITUTION.sub(fill, topic_name)
    if name.startswith("~"):
        name = f"{space}/{node_name}{name[1:]}"
    return name if name.startswith("/") else f"{space}/{name}"


def _raise_topic(name: str, fault: _Fault | None, is_service: bool) -> None:
    if fault is not None:
        raised = InvalidServiceNameException if is_service else InvalidTopicNameException
        raise raised(name, *fault)


def _topic_fault(name: str) -> _Fault | None:
    if not name:
        return _Fault("topic name must not be empty string", 0)
    if name[0].isdigit():
        return _Fault("topic name token must not start with a number", 0)
    if name.endswith("/"):
        return _Fault("topic name must not end with a forward slash", len(name) - 1)
    return _character_fault(name) or _token_fault(
        name, "topic name token must not start with a number"
    )


def _character_fault(name: str) -> _Fault | None:
    opened = -1
    for position, letter in enumerate(name):
        if letter == "~" and position:
            text = "topic name must not have tilde '~' unless it is the first character"
            return _Fault(text, position)
        if letter in "{}":
            if (letter == "{") == (opened >= 0):
                return _unbalanced(position)
            opened = position if letter == "{" else -1
        elif opened >= 0 and not _plain(letter):
            text = "substitution name must not contain characters other than alphanumerics or '_'"
            return _Fault(text, position)
        elif not _plain(letter) and letter not in "/~":
            allowed = "alphanumerics, '_', '~', '{', or '}'"
            return _Fault(f"topic name must not contain characters other than {allowed}", position)
    return _unbalanced(opened) if opened >= 0 else None


def _unbalanced(position: int) -> _Fault:
    return _Fault("topic name must not have unmatched (unbalanced) curly braces '{}'", position)


def _full_fault(name: str, kind: str, *, end: str) -> _Fault | None:
    if not name:
        return _Fault(f"{kind} must not be empty", 0)
    if not name.startswith("/"):
        return _Fault(f"{kind} must be absolute, it must lead with a '/'", 0)
    if name.endswith("/"):
        return _Fault(end, len(name) - 1)
    for position, letter in enumerate(name):
        if not _plain(letter) and letter != "/":
            text = f"{kind} must not contain characters other than alphanumerics, '_', or '/'"
            return _Fault(text, position)
    if "//" in name:
        return _Fault(f"{kind} must not contain repeated '/'", name.index("//") + 1)
    return _token_fault(name, f"{kind} must not have a token that starts with a number")


def _node_fault(name: str) -> _Fault | None:
    if not name:
        return _Fault("node name must not be empty", 0)
    for position, letter in enumerate(name):
        if not _plain(letter):
            text = "node name must not contain characters other than alphanumerics or '_'"
            return _Fault(text, position)
    return _Fault("node name must not start with a number", 0) if name[0].isdigit() else None


def _token_fault(name: str, text: str) -> _Fault | None:
    found = re.search(r"/[0-9]", name)
    return None if found is None else _Fault(text, found.start() + 1)


def _plain(letter: str) -> bool:
    return letter.isascii() and (letter.isalnum() or letter == "_")
