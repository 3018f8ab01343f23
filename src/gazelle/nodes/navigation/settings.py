"""Reading parameters by a table: typed values, defaults, and what is wrong, all at once."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import fields
from typing import Any, TypeVar

from gazelle.control.sources.trees import leaves
from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.nodes.navigation.table import Row, Table

__all__ = ["Settings", "nested"]

_T = TypeVar("_T")
_MISSING = object()
# Nav2's files list some fifty libraries in one parameter.
_LONGEST = 60
_READ = {
    "number": "number", "integer": "integer", "flag": "flag", "text": "text", "texts": "texts",
    "numbers": "numbers", "any": "raw",
}  # fmt: skip
# Nav2's launch files give autostart to all nodes of a container; lifecycle_manager reads it.
_EVERYWHERE = frozenset(
    {"use_sim_time", "bond_disable_heartbeat_timeout", "qos_overrides", "autostart"}
)


def nested(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return a tree of names whose parts are joined with ``/`` or dots; trees are taken too."""
    tree: dict[str, Any] = {}
    for key, value in values.items():
        *path, last = str(key).replace("/", ".").strip(".").split(".")
        branch = tree
        for word in path:
            deeper = branch.get(word)
            if not isinstance(deeper, dict):
                deeper = branch[word] = {}
            branch = deeper
        if isinstance(value, Mapping):
            known = branch.get(last)
            branch[last] = {**(known if isinstance(known, dict) else {}), **nested(value)}
        else:
            branch[last] = value
    return tree


class Settings:
    """The parameters of one node, layer or plug-in.

    Attributes:
        table: what there is.
        name: what messages call the owner, such as ``/move_base/local_costmap``.
        tree: the values that were given, nested.
    """

    def __init__(
        self, table: Table, tree: Mapping[str, Any], name: str, diagnostics: Diagnostics
    ) -> None:
        """Read nothing yet; what is wrong is reported where it is read."""
        self.table = table
        self.name = name
        self.tree = dict(tree)
        self._diagnostics = diagnostics

    def has(self, key: str) -> bool:
        """Tell whether a parameter was given."""
        return self._given(key) is not _MISSING

    def raw(self, key: str, default: Any = None) -> Any:
        """Return what was given, or a default of the caller's."""
        value = self._given(key)
        return default if value is _MISSING else value

    def number(self, key: str, default: float | None = None) -> float:
        """Return a number within the row's limits; `default` in place of the table's."""
        row, value = self.table.row(key), self._given(key)
        fallback = float(row.default if default is None else default)
        if value is _MISSING:
            return fallback
        number = _number(value)
        if number is None:
            return float(self._bad(key, value, "a number", fallback))
        return self._limited(row, number)

    def integer(self, key: str) -> int:
        """Return a whole number."""
        value = self.number(key)
        if not math.isfinite(value) or value != int(value):
            return int(self._bad(key, value, "a whole number", self.table.row(key).default))
        return int(value)

    def flag(self, key: str, default: bool | None = None) -> bool:
        """Return a truth value."""
        value = self._given(key)
        fallback = bool(self.table.row(key).default if default is None else default)
        if value is _MISSING:
            return fallback
        if isinstance(value, bool) or (isinstance(value, int) and value in (0, 1)):
            return bool(value)
        if isinstance(value, str) and value.lower() in ("true", "false"):
            return value.lower() == "true"
        return bool(self._bad(key, value, "true or false", fallback))

    def text(self, key: str, default: str | None = None) -> str:
        """Return a text."""
        value = self._given(key)
        fallback = str(self.table.row(key).default if default is None else default)
        if value is _MISSING:
            return fallback
        if isinstance(value, list | dict):
            return str(self._bad(key, value, "a text", fallback))
        return str(value)

    def texts(self, key: str) -> tuple[str, ...]:
        """Return texts: a list, or a text with spaces between."""
        value = self._given(key)
        if value is _MISSING:
            value = self.table.row(key).default
        if isinstance(value, str):
            return tuple(value.split())
        if not isinstance(value, list | tuple):
            return tuple(self._bad(key, value, "a list of texts", ()))
        return tuple(str(item) for item in value)

    def group(self, key: str) -> dict[str, Any]:
        """Return a subtree, empty when it is absent."""
        value = self._given(key)
        return value if isinstance(value, dict) else {}

    def below(self, key: str, table: Table) -> Settings:
        """Return the settings of a subtree."""
        return Settings(table, self.group(key), f"{self.name}/{key}", self._diagnostics)

    def with_table(self, table: Table, tree: Mapping[str, Any], name: str) -> Settings:
        """Return settings of something below, with a table and values of its own."""
        return Settings(table, tree, f"{self.name}/{name}", self._diagnostics)

    def fill(self, options: type[_T], **others: Any) -> _T:
        """Return an instance of the option class that the table was made of.

        Args:
            options: the class, see `table_of`.
            **others: values of fields that take the place of what was given.
        """
        own = _fields(options)
        rows = [row for row in self.table.rows if row.kind in _READ and row.key in own]
        named = {own[row.key]: self.value(row) for row in rows}
        return options(**{**named, **others})

    def value(self, row: Row) -> Any:
        """Return the value of a row by its kind."""
        return getattr(self, _READ[row.kind])(row.key)

    def numbers(self, key: str) -> tuple[float, ...]:
        """Return a list of numbers."""
        value = self._given(key)
        default = tuple(self.table.row(key).default)
        if value is _MISSING:
            return default
        found = [_number(item) for item in value] if isinstance(value, list | tuple) else [None]
        if any(item is None for item in found):
            return tuple(self._bad(key, value, "a list of numbers", default))
        return tuple(item for item in found if item is not None)

    def report(self, code: str, text: str, fix: str = "") -> None:
        """Report something about these parameters."""
        self._diagnostics.report(code, f"{self.name}: {text}", None, fix=fix)

    def report_unknown(self, *others: str) -> None:
        """Report parameters that the table does not have or that have no effect.

        Args:
            *others: names that somebody else reads, of subtrees too.
        """
        for key, value in leaves(self.tree):
            word = key.partition(".")[0]
            if word in others or word in _EVERYWHERE:
                continue
            row = self.table.row_for(key)
            if row is None:
                known = (*self.table.keys(), *others)
                text = f"parameter '{key}' is not one of {self.table.family}; it has no effect"
                self.report("parameter.unknown", text, did_you_mean(word, known))
            elif row.kind == "refused":
                text = f"parameter '{key}' ({_short(value)}) has no effect here: {row.meaning}"
                self.report("parameter.idle", text)

    def _given(self, key: str) -> Any:
        row = next((row for row in self.table.rows if row.key == key), None)
        for name in (key, *(row.names if row is not None else ())):
            value = self._find(name)
            if value is not _MISSING:
                return value
        return _MISSING

    def _find(self, key: str) -> Any:
        branch: Any = self.tree
        for word in key.split("."):
            if not isinstance(branch, dict) or word not in branch:
                return _MISSING
            branch = branch[word]
        return branch

    def _limited(self, row: Row, value: float) -> float:
        low = -math.inf if row.low is None else row.low
        high = math.inf if row.high is None else row.high
        if low <= value <= high:
            return value
        used = min(max(value, low), high) if math.isfinite(value) else float(row.default)
        between = f"a number of {low:g} to {high:g}"
        return float(self._bad(row.key, value, between, used))

    def _bad(self, key: str, value: Any, wanted: str, used: Any) -> Any:
        text = f"parameter '{key}' is {value!r}, not {wanted}; {used!r} is used"
        self.report("parameter.bad-value", text, f"write {wanted}")
        return used


def _fields(options: type) -> dict[str, str]:
    """Return fields by the parameters that they are."""
    return {item.metadata.get("key") or item.name: item.name for item in fields(options)}


def _short(value: Any) -> str:
    """Return a value in words; of a long one its beginning and how much there is."""
    text = repr(value)
    if len(text) <= _LONGEST:
        return text
    count = f" of {len(value)}" if isinstance(value, list | tuple) else ""
    return f"{text[:_LONGEST]}…{count}"


def _number(value: Any) -> float | None:
    if isinstance(value, bool):
        return None
    try:
        return float(value)
    except (OverflowError, TypeError, ValueError):
        return None
