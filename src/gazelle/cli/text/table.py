"""Messages as comma-separated values, one line each, as ``rostopic echo -p`` prints them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from gazelle.interfaces import Ros1Message, Time, TVal

__all__ = ["csv_header", "csv_row"]

Filter = Callable[[Any], Iterable[str]]


def csv_header(value: Any, *, keep: Filter | None = None) -> str:
    """Return the first line: ``%time,field.a,field.b0,field.b1``."""
    return "%time," + ",".join(_labels(value, "field", keep))


def csv_row(
    value: Any, now_ns: int, *, keep: Filter | None = None, offset_ns: int | None = None
) -> str:
    """Return the line of one message.

    Args:
        value: a message or one of its values.
        now_ns: the time written in front of what has no header.
        keep: names the fields of a message that are written.
        offset_ns: times are written relative to it.
    """
    stamp_ns = value.header.stamp.to_nsec() if getattr(value, "_has_header", False) else now_ns
    return f"{stamp_ns - (offset_ns or 0)}," + ",".join(_values(value, keep, offset_ns))


def _labels(value: Any, label: str, keep: Filter | None) -> Iterable[str]:
    if isinstance(value, Ros1Message):
        for name in _fields(value, keep):
            yield from _labels(getattr(value, name), f"{label}.{name}", keep)
    elif _is_sequence(value):
        for place, item in enumerate(value):
            yield from _labels(item, f"{label}{place}", keep)
    elif not isinstance(value, bytes):
        yield label


def _values(value: Any, keep: Filter | None, offset_ns: int | None) -> Iterable[str]:
    if isinstance(value, Ros1Message):
        for name in _fields(value, keep):
            yield from _values(getattr(value, name), keep, offset_ns)
    elif isinstance(value, np.ndarray):
        yield from _values(value.tolist(), keep, offset_ns)
    elif _is_sequence(value):
        for item in value:
            yield from _values(item, keep, offset_ns)
    # uint8[], as of images, is left out, as by the original.
    elif not isinstance(value, bytes):
        yield _one(value, offset_ns)


def _one(value: Any, offset_ns: int | None) -> str:
    if isinstance(value, bool):
        return "1" if value else "0"
    if isinstance(value, Time) and offset_ns is not None:
        return str(value.to_nsec() - offset_ns)
    return str(value.to_nsec() if isinstance(value, TVal) else value)


def _fields(value: Ros1Message, keep: Filter | None) -> list[str]:
    kept = value._names if keep is None else set(keep(value))
    return [name for name in value._names if name in kept]


def _is_sequence(value: Any) -> bool:
    return isinstance(value, list | tuple | np.ndarray)
