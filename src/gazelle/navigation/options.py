"""Options as tables: a frozen dataclass whose fields are named as ROS's parameters.

Every field says what it does, its unit and its limits; what reads parameter files and what prints
the documentation take it from there. Parameters that exist in ROS and do nothing here are named by
the class with the reason, so that nobody is left to wonder.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import MISSING, dataclass, field, fields
from typing import Any

__all__ = [
    "OptionRow",
    "flag",
    "idle_of",
    "integer",
    "number",
    "numbers",
    "rows_of",
    "text",
    "texts",
]


@dataclass(frozen=True, slots=True)
class OptionRow:
    """One option.

    Attributes:
        key: the parameter's name in ROS.
        kind: ``number``, ``integer``, ``flag``, ``text``, ``texts`` or ``numbers``.
        default: value when it is absent.
        meaning: what it does.
        unit: SI unit, empty for none.
        low, high: limits, None for none.
        names: other spellings, such as the other generation's.
    """

    key: str
    kind: str
    default: Any
    meaning: str
    unit: str = ""
    low: float | None = None
    high: float | None = None
    names: tuple[str, ...] = ()


def number(
    default: float,
    meaning: str,
    unit: str = "",
    low: float | None = None,
    high: float | None = None,
    names: tuple[str, ...] = (),
) -> Any:
    """Return a field that is a number."""
    return _option("number", default, meaning, unit, low, high, names)


def integer(
    default: int,
    meaning: str,
    low: float | None = None,
    high: float | None = None,
    names: tuple[str, ...] = (),
) -> Any:
    """Return a field that is a whole number."""
    return _option("integer", default, meaning, "", low, high, names)


def flag(default: bool, meaning: str, names: tuple[str, ...] = ()) -> Any:
    """Return a field that is true or false."""
    return _option("flag", default, meaning, names=names)


def text(default: str, meaning: str, names: tuple[str, ...] = ()) -> Any:
    """Return a field that is a text."""
    return _option("text", default, meaning, names=names)


def texts(default: tuple[str, ...], meaning: str) -> Any:
    """Return a field that is a list of texts."""
    return _option("texts", default, meaning)


def numbers(default: tuple[float, ...], meaning: str, unit: str = "") -> Any:
    """Return a field that is a list of numbers."""
    return _option("numbers", default, meaning, unit)


def rows_of(options: type) -> tuple[OptionRow, ...]:
    """Return the rows of an option class."""
    return tuple(
        OptionRow(
            item.metadata.get("key") or item.name,
            default=None if item.default is MISSING else item.default,
            **{name: value for name, value in item.metadata.items() if name != "key"},
        )
        for item in fields(options)
        if "kind" in item.metadata
    )


def idle_of(options: type) -> Mapping[str, str]:
    """Return parameters of ROS that have no effect here, with the reason."""
    found: Mapping[str, str] = getattr(options, "IDLE", {})
    return found


def _option(
    kind: str,
    default: Any,
    meaning: str,
    unit: str = "",
    low: float | None = None,
    high: float | None = None,
    names: tuple[str, ...] = (),
) -> Any:
    row = {"kind": kind, "meaning": meaning, "unit": unit, "low": low, "high": high, "names": names}
    return field(default=default, metadata=row)
