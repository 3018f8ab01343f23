"""A `TypedDict` as a TypeScript interface, with the texts of its docstring.

A ROS message in it is `Annotated[Any, "package/msg/Name"]`.
"""

from __future__ import annotations

import inspect
import json
import re
import types
import typing
from typing import Annotated, Any, Literal, NotRequired, Required, TypeVar

from gazelle.studio.typescript.ros import ros_name

__all__ = ["interface", "type_text"]

_PLAIN: dict[Any, str] = {
    Any: "Json",
    bool: "boolean",
    float: "number",
    int: "number",
    str: "string",
    type(None): "null",
}
_ATTRIBUTE = re.compile(r"^    (\w+): (.*(?:\n {8}.*)*)", re.MULTILINE)


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
