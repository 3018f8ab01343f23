"""Typed dictionaries and ROS messages as TypeScript interfaces.

A `TypedDict` comes with the texts of its docstring; a ROS message in it is
`Annotated[Any, "package/msg/Name"]` and has the fields of its definition, as JSON has them.
"""

from __future__ import annotations

import inspect
import json
import re
import types
import typing
from collections.abc import Iterable, Mapping
from typing import Annotated, Any, Literal, NotRequired, Required, TypeVar

from gazelle.interfaces import Definition, Field, RosVersion, definition
from gazelle.interfaces.definition import FORMATS, Array

__all__ = ["interface", "ros_interfaces", "ros_name", "type_text"]

_PLAIN: dict[Any, str] = {
    Any: "Json",
    bool: "boolean",
    float: "number",
    int: "number",
    str: "string",
    type(None): "null",
}
_ATTRIBUTE = re.compile(r"^    (\w+): (.*(?:\n {8}.*)*)", re.MULTILINE)


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


def interface(message: type) -> str:
    """Return the interface of a `TypedDict`, or of a `NamedTuple` that is sent as one.

    Raises:
        TypeError: a field has a type that JSON does not have.
    """
    about, _, rest = inspect.cleandoc(message.__dict__.get("__doc__") or "").partition(
        "\n\nAttributes:\n"
    )
    notes = {name: " ".join(text.split()) for name, text in _ATTRIBUTE.findall(rest)}
    required: Any = getattr(message, "_fields", None) or getattr(message, "__required_keys__", ())
    lines = [f"/** {' '.join(about.split())} */"] if about else []
    names = ", ".join(one.__name__ for one in getattr(message, "__parameters__", ()))
    lines.append(f"export interface {message.__name__}{f'<{names}>' if names else ''} {{")
    for name, kind in typing.get_type_hints(message, include_extras=True).items():
        if name in notes:
            lines.append(f"  /** {notes[name]} */")
        # Of annotations that are texts, `__required_keys__` does not see `NotRequired`.
        is_there = name in required and typing.get_origin(kind) is not NotRequired
        optional = "" if is_there else "?"
        lines.append(f"  {name}{optional}: {type_text(kind)};")
    return "\n".join((*lines, "}\n"))


def type_text(kind: Any) -> str:
    """Return a Python type of JSON values in TypeScript's words.

    Raises:
        TypeError: JSON has no such type.
    """
    if kind in _PLAIN:
        return _PLAIN[kind]
    if typing.is_typeddict(kind) or isinstance(kind, TypeVar):
        return str(kind.__name__)
    origin, parts = typing.get_origin(kind), typing.get_args(kind)
    if origin in (NotRequired, Required):
        return type_text(parts[0])
    if origin is Annotated and isinstance(parts[1], str):
        return ros_name(parts[1])
    if origin is Annotated:
        item, length = parts
        return f"[{', '.join([type_text(typing.get_args(item)[0])] * length)}]"
    if typing.is_typeddict(origin):
        return f"{origin.__name__}<{', '.join(type_text(one) for one in parts)}>"
    if origin is Literal:
        return " | ".join(json.dumps(one) for one in parts)
    if origin in (types.UnionType, typing.Union):
        return " | ".join(dict.fromkeys(type_text(one) for one in parts))
    if origin is list or (origin is tuple and len(parts) == 2 and parts[1] is ...):
        item = type_text(parts[0])
        return f"({item})[]" if " | " in item else f"{item}[]"
    if origin is tuple:
        return f"[{', '.join(type_text(one) for one in parts)}]"
    if origin is dict:
        return f"Record<string, {type_text(parts[1])}>"
    raise TypeError(f"{kind} is no type of JSON values")


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
