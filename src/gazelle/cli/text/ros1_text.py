"""``--noarr`` and ``--nostr``: long fields replaced by a note of their size."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import Any

from gazelle.interfaces import Ros1Message

__all__ = ["field_filter", "hidden"]


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
