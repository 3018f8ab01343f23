"""How ``rostopic echo`` prints: ``--noarr`` and ``--nostr``, and ``-p``, which is CSV."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import lru_cache
from typing import Any

import numpy as np

from gazelle.interfaces import Ros1Message, Time, TVal

__all__ = ["csv_header", "csv_row", "field_filter", "hidden"]

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


def hidden(value: Any, type_name: str = "", *, strings: bool, arrays: bool) -> Any:
    """Return a message, or one of its values, with its long parts replaced.

    Args:
        value: what is shown.
        type_name: type of a value that is not a message, as definitions write it.
        strings: replace texts and lists of texts.
        arrays: replace arrays.
    """
    if not isinstance(value, Ros1Message):
        note = _note(value, type_name, strings=strings, arrays=arrays)
        return value if note is None else note
    shown: dict[str, Any] = {}
    kinds: list[str] = []
    for name, kind in zip(value._names, value._slot_types, strict=True):
        inner = getattr(value, name)
        note = _note(inner, kind, strings=strings, arrays=arrays)
        if isinstance(inner, Ros1Message):
            inner = hidden(inner, strings=strings, arrays=arrays)
        shown[name] = inner if note is None else note
        kinds.append(kind if note is None else "string")
    made: Ros1Message = _look_alike(value._names, tuple(kinds))()
    for name, inner in shown.items():
        setattr(made, name, inner)
    return made


def field_filter(*, strings: bool, arrays: bool) -> Callable[[Any], Iterator[str]]:
    """Return a function that names the fields of a message that stay (``echo -p``)."""

    def remaining(message: Any) -> Iterator[str]:
        for name, kind in zip(message._names, message._slot_types, strict=True):
            if not (arrays and "[" in kind) and not (strings and "string" in kind):
                yield name

    return remaining


def _labels(value: Any, label: str, keep: Filter | None) -> Iterable[str]:
    if isinstance(value, Ros1Message):
        for name in _fields(value, keep):
            yield from _labels(getattr(value, name), f"{label}.{name}", keep)
    elif _is_sequence(value):
        for index, item in enumerate(value):
            yield from _labels(item, f"{label}{index}", keep)
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


def _note(value: Any, kind: str, *, strings: bool, arrays: bool) -> str | None:
    if arrays and "[" in kind:
        # The original cuts brackets off the end only: float64[36] is shown as float64[36.
        return f"<array type: {kind.rstrip('[]')}, length: {len(value)}>"
    if strings and kind == "string":
        return f"<string length: {len(value)}>"
    if strings and kind == "string[]":
        return f"<array type: string, length: {len(value)}>"
    return None


@lru_cache(maxsize=256)
def _look_alike(names: tuple[str, ...], kinds: tuple[str, ...]) -> type[Ros1Message]:
    """Return a message class that takes any value, to be printed only."""
    space = {"__slots__": names, "_names": names, "_slot_types": list(kinds)}
    return type("Shown", (Ros1Message,), space)
