"""Tables of parameters: what each one does here, or why it does nothing."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from gazelle.navigation.options import idle_of, rows_of

__all__ = ["Kind", "Row", "Table", "refused", "table_of"]

Kind = Literal["number", "integer", "flag", "text", "texts", "numbers", "any", "group", "refused"]


@dataclass(frozen=True, slots=True)
class Row:
    """One parameter.

    Attributes:
        key: its name, parts joined with dots; ``<plugin>`` stands for any one word.
        kind: type of its value; ``any`` for what is read by other means, ``group`` for a subtree,
            ``refused`` for a parameter that has no effect here.
        default: the original's default.
        meaning: what it does; of a refused one why it does nothing.
        unit: SI unit, empty for none.
        low, high: limits, None for none.
        live: dynamic_reconfigure or ``ros2 param set`` changes it while the node runs.
        names: other spellings, such as the other generation's.
    """

    key: str
    kind: Kind
    default: Any
    meaning: str
    unit: str = ""
    low: float | None = None
    high: float | None = None
    live: bool = False
    names: tuple[str, ...] = ()

    def matches(self, key: str) -> bool:
        """Tell whether a name with dots is this row's."""
        for name in (self.key, *self.names):
            if _pattern(name).fullmatch(key) is not None:
                return True
            if self.kind in ("group", "refused") and key.startswith(f"{name}."):
                return True
        return False


def refused(why: str, *keys: str) -> tuple[Row, ...]:
    """Return rows of parameters that have no effect, for one reason."""
    return tuple(Row(key, "refused", None, why) for key in keys)


@dataclass(frozen=True, slots=True)
class Table:
    """The parameters of one node, layer or plug-in.

    Attributes:
        family: its name in the documentation.
        summary: what it is, one or two sentences.
        types: the names it goes by in parameter files, or ``package/type`` of a node.
    """

    family: str
    summary: str
    types: tuple[str, ...]
    rows: tuple[Row, ...]

    def row(self, key: str) -> Row:
        """Return the row of a key.

        Raises:
            KeyError: there is none.
        """
        for row in self.rows:
            if row.key == key:
                return row
        raise KeyError(f"{self.family} has no parameter {key}")

    def row_for(self, key: str) -> Row | None:
        """Return the row that a parameter of a file belongs to, None when it is unknown."""
        return next((row for row in self.rows if row.matches(key)), None)

    def keys(self) -> list[str]:
        """Return the names of all parameters that have an effect."""
        return [row.key for row in self.rows if row.kind != "refused"]

    def plus(self, rows: Iterable[Row]) -> Table:
        """Return a table with more rows."""
        return Table(self.family, self.summary, self.types, (*self.rows, *rows))


def table_of(
    options: type,
    family: str,
    summary: str,
    types: tuple[str, ...] = (),
    *,
    defaults: Mapping[str, Any] | None = None,
    live: Iterable[str] = (),
) -> Table:
    """Return the table of an option class (`gazelle.navigation.options`).

    Args:
        options: the class.
        family: see `Table`.
        summary: see `Table`.
        types: see `Table`.
        defaults: those that differ, such as Nav2's.
        live: keys that can be changed while the node runs.
    """
    others, changeable = dict(defaults or {}), frozenset(live)
    rows = [
        Row(
            one.key,
            one.kind,  # type: ignore[arg-type]
            others.get(one.key, one.default),
            one.meaning,
            one.unit,
            one.low,
            one.high,
            one.key in changeable,
            one.names,
        )
        for one in rows_of(options)
    ]
    idle = [Row(key, "refused", None, why) for key, why in idle_of(options).items()]
    return Table(family, summary, types, (*rows, *idle))


def _pattern(key: str) -> re.Pattern[str]:
    return re.compile(re.sub(r"<\w+>", r"[^.]+", re.escape(key)))
