"""Messages from words of the command line, for ``rostopic pub`` and ``rosservice call``."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, TextIO

from gazelle.cli.tool import ToolError
from gazelle.errors import InterfaceError
from gazelle.interfaces import Ros1Message, fill, show_message, show_service, time_keys
from gazelle.interfaces.definition import RosVersion

__all__ = ["documents", "fill_from_words", "printable_args", "yaml_words"]

_ROS_WORDS = re.compile(r" \(ROS: (?P<words>[^()]*)\)")


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
