"""Names of plotted values → what reads them out of messages: ``/odom/twist/twist/linear/x``."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple

from gazelle.diagnostics import nearest_names
from gazelle.graph import ANY_TYPE, Entity, Kind
from gazelle.interfaces import RosVersion, definition
from gazelle.interfaces.definition import FORMATS, Array, Field, attribute_name
from gazelle.studio.errors import StudioError

__all__ = ["Curve", "curves_of", "read_number"]

_MAX_ITEMS = 50
_STEP = re.compile(r"(\w+)((?:\[\d+\])*)")
_INDEX = re.compile(r"\[(\d+)\]")
_SKIPPED = (
    "std_msgs/msg/Header",
    "builtin_interfaces/msg/Time",
    "builtin_interfaces/msg/Duration",
)

Step = str | int


class Curve(NamedTuple):
    """One plotted value.

    Attributes:
        name: as the legend has it, ``/joint_states/position[0]``.
        topic: where it comes from.
        steps: attributes and indices down to the number.
    """

    name: str
    topic: str
    steps: tuple[Step, ...]


def curves_of(
    name: str, known: Iterable[Entity], last_message: Callable[[str], Any]
) -> list[Curve]:
    """Return the curves that a name stands for; a message stands for all its numbers.

    Args:
        name: topic and fields; array items as ``[0]`` or ``/0``.
        known: what is on the graph.
        last_message: a topic's newest message or None, which tells how long its arrays are.

    Raises:
        StudioError: there is no such topic or field, nothing in it is a number, or no message has
            come that tells how many there are.
    """
    topic, type_name, rest = _split(name, known)
    steps, field = _walk(name, type_name, rest)
    message = last_message(topic) if field is None or _is_open(field) else None
    found = list(_numbers(topic, type_name, steps, field, message))
    if not found and field is not None and message is None and _is_open(field):
        later = f"try again when {topic} has had a message"
        is_list = field.type.array is Array.SEQUENCE
        raise StudioError(
            f"'{name}': no message has come yet that says how many items it has",
            hint=f"name one, {name}[0], or {later}" if is_list else later,
        )
    if not found:
        raise StudioError(f"'{name}': nothing in it is a number")
    return found


def read_number(message: Any, steps: tuple[Step, ...]) -> float | None:
    """Return a curve's value in a message; None for what is missing or no finite number."""
    value = message
    for step in steps:
        if isinstance(step, int):
            if step >= len(value):
                return None
            value = value[step]
        else:
            value = getattr(value, step)
    number = float(value)
    return number if math.isfinite(number) else None


def _split(name: str, known: Iterable[Entity]) -> tuple[str, str, list[str]]:
    types = {
        one.name: one.type_name
        for one in known
        if one.kind in (Kind.PUBLISHER, Kind.SUBSCRIPTION) and one.type_name != ANY_TYPE
    }
    parts = name.strip("/").split("/")
    for count in range(len(parts), 0, -1):
        topic = "/" + "/".join(parts[:count])
        if topic in types:
            return topic, types[topic], parts[count:]
    near = nearest_names(name, types)
    hint = "" if types else "no topic is there yet"
    raise StudioError(f"'{name}': there is no such topic", hint=hint, known=near)


def _walk(name: str, type_name: str, parts: list[str]) -> tuple[tuple[Step, ...], Field | None]:
    """Follow fields; returns the steps and the field they end at, None for the message itself."""
    steps: list[Step] = []
    field: Field | None = None
    owner = type_name
    for part in parts:
        if part.isdigit() and field is not None and field.type.array is not Array.ONE:
            steps.append(int(part))
            field = _item(field)
            continue
        match = _STEP.fullmatch(part)
        fields = {one.name: one for one in definition(owner, RosVersion.ROS2).fields}
        if match is None or match[1] not in fields or (field and not field.type.is_message):
            near = nearest_names(part, fields)
            known = near or tuple(fields)
            raise StudioError(f"'{name}': {owner} has no field '{part}'", known=known)
        field = fields[match[1]]
        steps.append(attribute_name(match[1]))
        for index in _INDEX.findall(match[2]):
            steps.append(int(index))
            field = _item(field)
        owner = field.type.base if field.type.is_message else owner
    return tuple(steps), field


def _item(field: Field) -> Field:
    return field._replace(type=field.type._replace(array=Array.ONE))


def _is_open(field: Field) -> bool:
    return field.type.is_message or field.type.array is Array.SEQUENCE


def _numbers(
    name: str, type_name: str, steps: tuple[Step, ...], field: Field | None, message: Any
) -> Iterator[Curve]:
    topic = name
    label = name + _label(steps)
    value = _value(message, steps)
    if field is None:
        yield from _inside(topic, type_name, steps, message)
    elif field.type.array is not Array.ONE:
        count = field.type.size if field.type.array is Array.FIXED else _length(value)
        for index in range(min(count, _MAX_ITEMS)):
            yield from _numbers(topic, type_name, (*steps, index), _item(field), message)
    elif field.type.is_message:
        yield from _inside(topic, field.type.base, steps, message)
    elif field.type.base in FORMATS:
        yield Curve(label, topic, steps)


def _inside(topic: str, owner: str, steps: tuple[Step, ...], message: Any) -> Iterator[Curve]:
    for one in definition(owner, RosVersion.ROS2).fields:
        if one.type.base not in _SKIPPED:
            yield from _numbers(topic, owner, (*steps, attribute_name(one.name)), one, message)


def _label(steps: tuple[Step, ...]) -> str:
    return "".join(f"[{step}]" if isinstance(step, int) else f"/{step}" for step in steps)


def _value(message: Any, steps: tuple[Step, ...]) -> Any:
    for step in steps:
        if message is None or (isinstance(step, int) and step >= len(message)):
            return None
        message = message[step] if isinstance(step, int) else getattr(message, step)
    return message


def _length(value: Any) -> int:
    return 0 if value is None else len(value)
