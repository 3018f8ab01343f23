"""What a value of a parameter is taken for."""

from __future__ import annotations

from typing import Any

__all__ = ["flag_of", "number_of", "shortened"]

# Nav2's files list some fifty libraries in one parameter.
_MAX_LENGTH = 60


def number_of(value: Any) -> float | None:
    """Return a value as a number, also of a text; None when it is none or too large for one."""
    if isinstance(value, bool):
        return None
    try:
        return float(value)
    except (OverflowError, TypeError, ValueError):
        return None


def flag_of(value: Any) -> bool | None:
    """Return a value as a truth value: itself, 0 or 1, ``true`` or ``false`` in any case."""
    if isinstance(value, bool) or (isinstance(value, int | float) and value in (0, 1)):
        return bool(value)
    if isinstance(value, str) and value.lower() in ("true", "false"):
        return value.lower() == "true"
    return None


def shortened(value: Any) -> str:
    """Return a value in words; of a long one its beginning and how much there is."""
    text = repr(value)
    if len(text) <= _MAX_LENGTH:
        return text
    count = f" of {len(value)}" if isinstance(value, list | tuple) else ""
    return f"{text[:_MAX_LENGTH]}…{count}"
