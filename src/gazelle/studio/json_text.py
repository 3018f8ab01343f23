"""Values → JSON that a browser reads: numbers that JSON does not have become texts."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np

from gazelle.interfaces import Message, TVal
from gazelle.interfaces.definition import attribute_name

__all__ = ["MAX_ARRAY", "finite_number", "json_text", "message_value"]

MAX_ARRAY = 200
"""Items of an array that an echo shows."""


def json_text(value: Any) -> str:
    """Return JSON; NaN and infinities are the texts ``NaN``, ``Infinity`` and ``-Infinity``."""
    try:
        return json.dumps(value, allow_nan=False, separators=(",", ":"), default=_plain)
    except ValueError:
        return json.dumps(_finite(value), separators=(",", ":"), default=_plain)


def finite_number(value: Any) -> float | None:
    """Return a JSON value as a number, None for what is none; JSON's may have any size."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    try:
        number = float(value)
    except OverflowError:
        return None
    return number if math.isfinite(number) else None


def message_value(message: Any, longest: int | None = MAX_ARRAY) -> Any:
    """Return a message as nested objects.

    Args:
        message: a message or a value of one.
        longest: longer arrays become ``{"…": length, "head": first items}``; None cuts none.
    """
    if isinstance(message, Message):
        return {
            item.name: message_value(getattr(message, attribute_name(item.name)), longest)
            for item in message.FIELDS
        }
    if isinstance(message, TVal):
        return {"secs": message.secs, "nsecs": message.nsecs}
    if isinstance(message, bytes | bytearray | memoryview):
        message = np.frombuffer(message, np.uint8)
    if isinstance(message, np.ndarray | list | tuple):
        return _array_value(message, longest)
    if isinstance(message, np.generic):
        return message.item()
    return message


def _array_value(items: Any, longest: int | None) -> Any:
    count = len(items)
    head = items if longest is None else items[:longest]
    if isinstance(head, np.ndarray):
        values = head.tolist()
    else:
        values = [message_value(item, longest) for item in head]
    return values if len(head) == count else {"…": count, "head": values}


def _finite(value: Any) -> Any:
    if isinstance(value, float):
        if math.isnan(value):
            return "NaN"
        if math.isinf(value):
            return "Infinity" if value > 0 else "-Infinity"
        return value
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(item) for item in value]
    if isinstance(value, np.ndarray | np.generic):
        return _finite(value.tolist())
    return value


def _plain(value: Any) -> Any:
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    return message_value(value, None)
