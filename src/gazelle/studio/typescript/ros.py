"""ROS messages as TypeScript interfaces: the fields of their definitions, as JSON has them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from gazelle.interfaces import Definition, Field, RosVersion, definition
from gazelle.interfaces.definition import FORMATS, Array

__all__ = ["ros_interfaces", "ros_name"]


def ros_name(full: str) -> str:
    """Return a message's name in TypeScript: ``visualization_msgs/msg/Marker`` is ``Marker``."""
    return full.rpartition("/")[2]


def ros_interfaces(messages: Iterable[str], added: Mapping[str, type]) -> list[str]:
    """Return the interfaces of messages and of all messages inside, each once.

    Args:
        messages: full names, such as ``visualization_msgs/msg/Marker``.
        added: by full name, a `TypedDict` of what the server adds to the fields of a message.

    Raises:
        ValueError: two of them have the same name in TypeScript.
    """
    found: dict[str, Definition] = {}
    for name in messages:
        _collect(name, found)
    owner: dict[str, str] = {}
    for full in found:
        if owner.setdefault(ros_name(full), full) != full:
            raise ValueError(f"{owner[ros_name(full)]} and {full} have one name in TypeScript")
    return [_interface(one, added.get(full)) for full, one in found.items()]


def _collect(full: str, found: dict[str, Definition]) -> None:
    """Add a message behind those inside of it."""
    if full in found:
        return
    known = definition(full, RosVersion.ROS2)
    for field in known.fields:
        if field.type.is_message:
            _collect(field.type.base, found)
    found[full] = known


def _interface(message: Definition, added: type | None) -> str:
    base = f" extends {added.__name__}" if added is not None else ""
    fields = (f"  {one.name}: {_field_text(one)};" for one in message.fields)
    head = f"export interface {ros_name(message.name)}{base} {{"
    return "\n".join((f"/** `{message.name}`. */", head, *fields, "}\n"))


def _field_text(field: Field) -> str:
    base = field.type.base
    if field.type.is_message:
        text = ros_name(base)
    elif base == "bool":
        text = "boolean"
    else:
        text = "number" if base in FORMATS else "string"
    return text if field.type.array is Array.ONE else f"{text}[]"
