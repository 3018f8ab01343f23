"""A message as the YAML-like text that ``print(msg)`` shows in ROS 1 (and ``rostopic echo``)."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from gazelle.interfaces.codec_runtime import is_array, is_array_item
from gazelle.interfaces.definition import RosVersion
from gazelle.interfaces.message_base import MessageBase
from gazelle.interfaces.ros1_time import Time, TVal

__all__ = ["strify"]


def strify(
    value: Any,
    indent: str = "",
    *,
    time_offset: Time | None = None,
    field_filter: Callable[[Any], Iterable[str]] | None = None,
    width: int | None = None,
) -> str:
    """Return a ROS 1 message or one of its values as text.

    Args:
        value: what to show.
        indent: white space in front of each line; with it the text starts with a line break.
        time_offset: times are shown relative to it.
        field_filter: gives the fields of a message that are shown.
        width: numbers are cut or filled to so many characters.
    """
    return _Printer(time_offset, field_filter, width).text(value, indent)


class _Printer:
    def __init__(
        self,
        time_offset: Time | None,
        field_filter: Callable[[Any], Iterable[str]] | None,
        width: int | None,
    ) -> None:
        self._offset = time_offset
        self._filter = field_filter
        self._width = width

    def text(self, value: Any, indent: str) -> str:
        if isinstance(value, bool):
            return str(value)
        if isinstance(value, int | float):
            return self._number(value)
        if isinstance(value, str):
            return _quoted(value) if value else "''"
        if isinstance(value, TVal):
            return self._time(value, indent)
        if isinstance(value, MessageBase) and value.GENERATION is RosVersion.ROS1:
            return self._message(value, indent)
        if is_array(value):
            return self._sequence(value.tolist(), indent)
        if is_array_item(value):
            return self.text(value.item(), indent)
        if isinstance(value, list | tuple):
            return self._sequence(value, indent)
        return str(value)

    def _number(self, value: Any) -> str:
        if self._width is None:
            return str(value)
        if isinstance(value, float):
            text = f"{value:.{self._width}f}"
            return text[: max(text.find("."), self._width)]
        return f"{value:{self._width}d}"

    def _time(self, value: Any, indent: str) -> str:
        if self._offset is not None:
            value = value - self._offset if isinstance(value, Time) else value
        seconds = str(value.secs) if self._width is None else f"{value.secs:{self._width}d}"
        return f"\n{indent}secs: {seconds}\n{indent}nsecs: {value.nsecs:{self._width or 9}d}"

    def _message(self, value: Any, indent: str) -> str:
        shown = value._names if self._filter is None else tuple(self._filter(value))
        lines = []
        for name, kind in zip(value._names, value._slot_types, strict=True):
            if name in shown:
                inner = getattr(value, name)
                if isinstance(inner, bytes) and "uint8[" in kind:
                    inner = list(inner)
                lines.append(f"{indent}{name}: {self.text(inner, '  ' + indent)}")
        return ("\n" if indent else "") + "\n".join(lines)

    def _sequence(self, values: list[Any] | tuple[Any, ...], indent: str) -> str:
        if not len(values):
            return "[]"
        first = values[0]
        if isinstance(first, str):
            return _string_list(values, indent)
        if isinstance(first, int | float):
            if self._width is None or isinstance(first, bool):
                return str([_python_number(item) for item in values])
            return "[" + ", ".join(self.text(item, indent) for item in values) + "]"
        lines = (f"{indent}- {self.text(item, indent + '  ')}" for item in values)
        return "\n" + "\n".join(lines)


def _python_number(value: Any) -> Any:
    """Return Python's own number: numpy's show their type in a list."""
    return value.item() if is_array_item(value) else value


def _quoted(text: str) -> str:
    from gazelle.documents.yaml import PYTHON_STYLE, dump_yaml

    return dump_yaml(text, PYTHON_STYLE._replace(is_quoted=True)).rstrip("\n")


def _string_list(values: Iterable[Any], indent: str) -> str:
    from gazelle.documents.yaml import PYTHON_STYLE, dump_yaml

    text = dump_yaml(list(values), PYTHON_STYLE).rstrip("\n")
    if text.startswith("["):
        return text
    return "\n" + "\n".join(indent + line for line in text.splitlines())
