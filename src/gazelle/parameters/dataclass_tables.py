"""Options as tables: a frozen dataclass whose fields are named as ROS's parameters.

Every field says what it does, its unit and its limits; what reads parameter files and what prints
the documentation take it from there. Parameters that exist in ROS and do nothing here are named by
the class with the reason, so that nobody is left to wonder.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import MISSING, field, fields, replace
from typing import Any

from gazelle.parameters.table import Parameter, ParameterKind, ParameterTable

__all__ = [
    "flag",
    "idle_of",
    "integer",
    "number",
    "numbers",
    "rows_of",
    "table_of",
    "text",
    "texts",
]


def number(
    default: float,
    meaning: str,
    unit: str = "",
    low: float | None = None,
    high: float | None = None,
    aliases: tuple[str, ...] = (),
) -> Any:
    """Return a field that is a number."""
    return _option("number", default, meaning, unit, low, high, aliases)


def integer(
    default: int,
    meaning: str,
    low: float | None = None,
    high: float | None = None,
    aliases: tuple[str, ...] = (),
) -> Any:
    """Return a field that is a whole number."""
    return _option("integer", default, meaning, "", low, high, aliases)


def flag(default: bool, meaning: str, aliases: tuple[str, ...] = ()) -> Any:
    """Return a field that is true or false."""
    return _option("flag", default, meaning, aliases=aliases)


def text(default: str, meaning: str, aliases: tuple[str, ...] = ()) -> Any:
    """Return a field that is a text."""
    return _option("text", default, meaning, aliases=aliases)


def texts(default: tuple[str, ...], meaning: str) -> Any:
    """Return a field that is a list of texts, or a text that is parted at its spaces."""
    return _option("words", default, meaning)


def numbers(default: tuple[float, ...], meaning: str, unit: str = "") -> Any:
    """Return a field that is a list of numbers."""
    return _option("numbers", default, meaning, unit)


def rows_of(options: type) -> tuple[Parameter, ...]:
    """Return the rows of an option class."""
    return tuple(
        Parameter(
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


def table_of(
    options: type,
    family: str,
    summary: str,
    types: tuple[str, ...] = (),
    *,
    defaults: Mapping[str, Any] | None = None,
    live: Iterable[str] = (),
) -> ParameterTable:
    """Return the table of an option class.

    Args:
        options: the class.
        family: see `ParameterTable`.
        summary: see `ParameterTable`.
        types: see `ParameterTable`.
        defaults: those that differ, such as Nav2's.
        live: keys that can be changed while the node runs.
    """
    others, changeable = dict(defaults or {}), frozenset(live)
    rows = [
        replace(row, default=others.get(row.key, row.default), live=row.key in changeable)
        for row in rows_of(options)
    ]
    idle = [Parameter(key, "refused", None, why) for key, why in idle_of(options).items()]
    return ParameterTable(family, summary, types, (*rows, *idle))


def _option(
    kind: ParameterKind,
    default: Any,
    meaning: str,
    unit: str = "",
    low: float | None = None,
    high: float | None = None,
    aliases: tuple[str, ...] = (),
) -> Any:
    row = {
        "kind": kind,
        "meaning": meaning,
        "unit": unit,
        "low": low,
        "high": high,
        "aliases": aliases,
    }
    return field(default=default, metadata=row)
