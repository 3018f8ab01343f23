"""Which topic a word such as ``/imu/orientation/x`` means, and which field of it."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from gazelle.diagnostics import did_you_mean
from gazelle.errors import LaunchError
from gazelle.graph import ANY_TYPE, Graph
from gazelle.graph.graph_info import topics_of
from gazelle.interfaces import ros1_message_type, ros1_type_of

__all__ = ["field_getter", "find_input"]

_STEP = re.compile(r"(\w+)(?:\[(-?\d*)(:(-?\d*))?\])?")


def find_input(graph: Graph, word: str, *, wait: Callable[[], bool] | None) -> tuple[str, Any, str]:
    """Return the topic, its class in the form of ROS 1, and the path to the field behind it.

    Args:
        graph: the graph.
        word: global name of a topic, or of a topic and its field.
        wait: called while nothing fits; False ends waiting. None does not wait.

    Raises:
        LaunchError: no such topic is there.
    """
    while True:
        known = {
            one.name: one.type_name for one in topics_of(graph.entities(), include_hidden=True)
        }
        known = {name: kind for name, kind in known.items() if kind != ANY_TYPE}
        starts = [name for name in known if word == name or word.startswith(f"{name}/")]
        if starts:
            topic = max(starts, key=len)
            return topic, ros1_message_type(ros1_type_of(known[topic])), word[len(topic) :]
        if wait is None or not wait():
            near = did_you_mean(word, sorted(known))
            text = f"ERROR: Wrong input topic (or topic field): {word}"
            raise LaunchError(f"{text}\n  {near}" if near else text)


def field_getter(kind: Any, path: str) -> Callable[[Any], Any]:
    """Return the function from a message to the field that a path leads to.

    Raises:
        LaunchError: the type has no such field.
    """
    steps = [_step(part) for part in path.split("/") if part]
    owner, names = kind, []
    for name, place in steps:
        names.append(name)
        if name not in getattr(owner, "_names", ()):
            fields = tuple(getattr(owner, "_names", ()))
            near = did_you_mean(name, fields) or f"its fields: {', '.join(fields) or 'none'}"
            text = f"no field named {name} in {getattr(owner, '_type', owner)}"
            raise LaunchError(f"ERROR: Wrong input topic (or topic field): {text}\n  {near}")
        slot = owner._slot_types[owner._names.index(name)]
        base = slot.partition("[")[0] if place is not None else slot
        owner = ros1_message_type(base) if "/" in base and "[" not in base else base

    def get(message: Any) -> Any:
        for name, place in steps:
            message = getattr(message, name)
            if place is not None:
                message = message[place]
        return message

    return get


def _step(part: str) -> tuple[str, int | slice | None]:
    match = _STEP.fullmatch(part)
    if match is None:
        raise LaunchError(f"ERROR: '{part}' is no field; write name, name[2] or name[0:3]")
    name, first, is_slice, last = match.groups()
    if is_slice is not None:
        return name, slice(int(first) if first else None, int(last) if last else None)
    return name, int(first) if first else None
