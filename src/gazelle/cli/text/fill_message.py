"""Messages from YAML on the command line, as ROS 1's and as ROS 2's commands take it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, TextIO

from gazelle.cli.ros_tool import ToolError
from gazelle.errors import InterfaceError
from gazelle.interfaces import (
    FieldType,
    Message,
    Ros1Message,
    fill,
    message_type,
    show_message,
    show_service,
    time_keys,
)
from gazelle.interfaces.definition import FORMATS, Array, RosVersion

__all__ = ["documents", "fill_from_words", "filled", "printable_args", "yaml_values", "yaml_words"]

_TIME = "builtin_interfaces/msg/Time"
_ROS_WORDS = re.compile(r" \(ROS: (?P<words>[^()]*)\)")


def yaml_values(text: str) -> dict[str, Any]:
    """Return the fields that a YAML text names.

    Raises:
        ToolError: it is not YAML, or no dictionary.
    """
    from gazelle.documents.yaml import YamlError, load_yaml

    try:
        found = load_yaml(text)
    except YamlError as error:
        raise ToolError(
            f"the values are not YAML: {error}\n  write them in quotes, with a blank behind each "
            "colon: '{linear: {x: 0.5}}'"
        ) from None
    if not isinstance(found, dict):
        raise ToolError(
            "The passed value needs to be a dictionary in YAML format\n"
            f"  it is: {found!r}; write '{{field: value}}', with a blank behind the colon"
        )
    return found


def filled(message_class: type[Message], values: dict[str, Any], now_ns: int) -> Message:
    """Return a message with these values; ``auto`` is a header of now, ``now`` a time.

    Values become what their fields are where Python can make it of them, as in
    ``set_message_fields``: ``data: 5`` is a text in a String.

    Raises:
        ToolError: a field does not exist, or a value does not fit.
    """
    message = message_class()
    try:
        fill(message, _fitted(message_class, values), keys=time_keys(now_ns, RosVersion.ROS2))
    except (InterfaceError, ValueError, TypeError) as error:
        raise ToolError(f"Failed to populate field: {error}") from None
    return message


def yaml_words(words: list[str]) -> list[Any]:
    """Return each word as the YAML value it is; an empty one is an empty text.

    Raises:
        ToolError: one is not YAML.
    """
    from gazelle.documents.yaml import YamlError, load_yaml

    try:
        return [load_yaml(word) if word else "" for word in words]
    except YamlError as error:
        raise ToolError(
            f"Argument error: {error}\n  write YAML in quotes, with a blank behind each colon: "
            "'{linear: {x: 0.5}}'"
        ) from None


def fill_from_words(message: Ros1Message, values: Any, now_ns: int) -> None:
    """Fill a message; ``now`` and ``auto`` stand for a time and a header of now.

    Raises:
        ToolError: a field does not exist, or a value does not fit; the text is genpy's, our
            explanation follows.
    """
    try:
        fill(message, values, keys=time_keys(now_ns, RosVersion.ROS1))
    except InterfaceError as error:
        text = str(error)
        match = _ROS_WORDS.search(text)
        if match is None:
            raise ToolError(_wrong_type(message, text)) from None
        reason = _ROS_WORDS.sub("", text, count=1)
        args = printable_args(message)
        raise ToolError(f"{match['words']}\n  {reason}\n\nArgs are: [{args}]") from None


def printable_args(message: Ros1Message, prefix: str = "") -> str:
    """Return the names of all fields, nested ones with dots, as genpy lists them."""
    names = []
    for name in message._names:
        value = getattr(message, name)
        if isinstance(value, Ros1Message):
            names.append(printable_args(value, f"{prefix}{name}."))
        else:
            names.append(prefix + name)
    return " ".join(name for name in names if name)


def documents(stream: TextIO) -> Iterator[Any]:
    """Yield the YAML documents of a stream as they come, each ended by ``---``.

    What stands behind the last ``---`` may be half a message and is not given.

    Raises:
        ToolError: a document is not YAML.
    """
    lines: list[str] = []
    for line in stream:
        if line.strip() != "---":
            lines.append(line)
            continue
        if any(text.strip() for text in lines):
            yield from yaml_words(["".join(lines)])
        lines = []


def _fitted(message_class: type[Message], values: Any, path: str = "") -> Any:
    if not isinstance(values, dict):
        return values
    kinds = {item.name: item.type for item in message_class.FIELDS}
    return {
        name: _fitted_value(kinds[name], value, f"{path}{name}") if name in kinds else value
        for name, value in values.items()
    }


def _fitted_value(kind: FieldType, value: Any, path: str) -> Any:
    if kind.array is not Array.ONE:
        one = kind._replace(array=Array.ONE)
        if not isinstance(value, list):
            return value
        return [_fitted_value(one, item, f"{path}[{n}]") for n, item in enumerate(value)]
    if kind.is_message:
        if isinstance(value, str):
            return value
        return _fitted(message_type(kind.base), value, f"{path}.")
    if kind.base in ("string", "wstring"):
        return value if isinstance(value, str) else str(value)
    try:
        return _number(FORMATS.get(kind.base, ""), value)
    except (TypeError, ValueError) as error:
        raise InterfaceError(f"field '{path}' is a {kind.base}: {error}") from None


def _number(code: str, value: Any) -> Any:
    if code == "?":
        return _truth(value)
    if code in ("f", "d"):
        return float(value)
    return int(value) if code and isinstance(value, float | str) else value


def _truth(value: Any) -> bool:
    if isinstance(value, int):
        return bool(value)
    raise ValueError(f"{value!r} is not true or false (ROS 2 would take it for {bool(value)})")


def _wrong_type(message: Ros1Message, text: str) -> str:
    name = message.TYPE_NAME
    if "/srv/" in name:
        shown = show_service(name.removesuffix("_Request").removesuffix("_Response"))
        return (
            "Unable to send request. One of the fields has an incorrect type:\n"
            f"  {text}\n\nsrv file:\n{shown}"
        )
    return (
        "Unable to publish message. One of the fields has an incorrect type:\n"
        f"  {text}\n\nmsg file:\n{show_message(name)}"
    )
