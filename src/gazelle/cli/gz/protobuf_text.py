"""Messages in the text layout of protocol buffers, which ``gz topic -e`` prints."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

__all__ = ["number_text", "protobuf_text"]

_INDENT = "  "
_FEWER_DIGITS, _ALL_DIGITS = 15, 17


def protobuf_text(fields: Mapping[str, Any], depth: int = 0) -> str:
    """Return nested fields as text: ``name: value`` or ``name { … }``, a line each.

    Args:
        fields: a value, a mapping, or a list of either under each name.
        depth: of the indentation.
    """
    lines: list[str] = []
    for name, value in fields.items():
        for one in value if isinstance(value, list) else [value]:
            lines += _lines(name, one, depth)
    return "".join(lines)


def number_text(value: float) -> str:
    """Return the shorter of 15 and 17 digits that reads back as the same number."""
    short = f"{value:.{_FEWER_DIGITS}g}"
    return short if float(short) == value or math.isnan(value) else f"{value:.{_ALL_DIGITS}g}"


def _lines(name: str, value: Any, depth: int) -> Iterable[str]:
    space = _INDENT * depth
    if isinstance(value, Mapping):
        return (f"{space}{name} {{\n", protobuf_text(value, depth + 1), f"{space}}}\n")
    return (f"{space}{name}: {_scalar(name, value)}\n",)


def _scalar(name: str, value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return number_text(value)
    if isinstance(value, str):
        # Enumerations stand without quotes; the fields of that kind are called so.
        if name == "type":
            return value
        escaped = value.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
        return f'"{escaped}"'
    return str(value)
