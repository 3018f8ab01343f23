"""Reads parameters by a table: typed values, defaults, and what is wrong, all of it told.

Values come from a source: a tree, or whatever else offers the names below a prefix.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any, Final, Protocol, TypeVar

from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean
from gazelle.errors import GazelleError
from gazelle.parameters.table import Parameter, ParameterTable
from gazelle.parameters.trees import flattened, nested

__all__ = [
    "MISSING",
    "ParameterOwner",
    "ParameterReader",
    "ParameterSource",
    "TreeSource",
    "branch_of",
    "flag_of",
    "number_of",
    "shortened",
]


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


@dataclass(frozen=True, slots=True)
class ParameterOwner:
    """A controller, plug-in, node, or a part of one.

    Attributes:
        name: its own, such as ``arm_controller`` or ``/move_base/local_costmap``.
        label: what messages begin with, such as ``controller 'arm_controller'``; the name when
            empty.
        unknown: of a parameter that the table lacks; ``{name}`` and ``{family}`` stand in it.
        idle: of one without effect; ``{name}``, ``{value}`` and ``{why}`` stand in it.
        bad_phrase: what ROS prints where a value is of the wrong kind.
        managed: first words of names that somebody else reads.
        refused: names of every such owner's that change nothing, with the reason.
        takes_nan: whether ``.nan`` is a value, by which ROS 2's controllers write that there is
            none.
        missing: what `ParameterReader.require` raises.
    """

    name: str
    label: str = ""
    unknown: str = "parameter '{name}' is not one of {family}; it has no effect"
    idle: str = "parameter '{name}' ({value}) has no effect here: {why}"
    bad_phrase: str = ""
    managed: frozenset[str] = frozenset()
    refused: Mapping[str, str] = field(default_factory=dict)
    takes_nan: bool = False
    missing: type[Exception] = GazelleError

    @property
    def beginning(self) -> str:
        """What messages begin with."""
        return self.label or self.name

    def below(self, key: str) -> ParameterOwner:
        """Return the owner of a part."""
        return replace(self, name=f"{self.name}/{key}", label="")


MISSING: Final = object()

"""What a source has for a name that nobody gave a value."""


class ParameterSource(Protocol):
    """Values by name: a tree of YAML, a ``<plugin>`` element, a store."""

    def find(self, name: str) -> Any:
        """Return the value of a name with dots, `MISSING` when there is none."""
        ...

    def leaves(self) -> Iterable[tuple[str, Any]]:
        """Return all that was given, by name with dots."""
        ...

    def full_name(self, name: str) -> str:
        """Return the name that a user knows a parameter by, such as ``/mira/arm/pid/p``."""
        ...

    def span(self, name: str) -> SourceSpan | None:
        """Return where a parameter stands, None when that is not known."""
        ...


class TreeSource:
    """Values of a tree, such as YAML files give.

    Args:
        tree: nested, or keys with dots or slashes.
        full_name: see `ParameterSource.full_name`.
        span: see `ParameterSource.span`.

    Attributes:
        tree: the values, nested.
    """

    def __init__(
        self,
        tree: Mapping[str, Any],
        *,
        full_name: Callable[[str], str] = str,
        span: Callable[[str], SourceSpan | None] = lambda name: None,
    ) -> None:
        self.tree = nested(tree)
        self._full_name = full_name
        self._span = span

    def find(self, name: str) -> Any:
        """Return the value of a name with dots, `MISSING` when there is none."""
        return branch_of(self.tree, name)

    def leaves(self) -> Iterable[tuple[str, Any]]:
        """Return all that was given; an empty branch is a leaf."""
        return flattened(self.tree)

    def full_name(self, name: str) -> str:
        """Return the name that a user knows a parameter by."""
        return self._full_name(name)

    def span(self, name: str) -> SourceSpan | None:
        """Return where a parameter stands."""
        return self._span(name)


def branch_of(tree: Mapping[str, Any], name: str) -> Any:
    """Return what a tree has at a name with dots, `MISSING` when there is nothing."""
    branch: Any = tree
    for word in name.split("."):
        if not isinstance(branch, Mapping) or word not in branch:
            return MISSING
        branch = branch[word]
    return branch


_T = TypeVar("_T")

_READ = {
    "any": "raw", "flag": "flag", "group": "group", "integer": "integer", "number": "number",
    "numbers": "numbers", "text": "text", "texts": "texts", "words": "texts",
}  # fmt: skip


class ParameterReader:
    """Typed access to the parameters of one owner, defaults from its table.

    Args:
        table: the names that there are, with defaults.
        source: what was given.
        owner: whose they are, for messages.
        diagnostics: receives what is wrong, where it is read.
        ros_version: of ROS; spellings and defaults of the other do not count. 0 for both.
    """

    def __init__(
        self,
        table: ParameterTable,
        source: ParameterSource,
        owner: ParameterOwner,
        diagnostics: Diagnostics,
        *,
        ros_version: int = 0,
    ) -> None:
        self.ros_version = ros_version
        self.table = table
        self.source = source
        self.owner = owner
        self.diagnostics = diagnostics

    @property
    def name(self) -> str:
        """The owner's name."""
        return self.owner.name

    @property
    def tree(self) -> dict[str, Any]:
        """What was given, nested; of a source that is a tree its own, which may be changed."""
        if isinstance(self.source, TreeSource):
            return self.source.tree
        return nested(dict(self.source.leaves()))

    def full_name(self, key: str) -> str:
        """Return the name that a user knows a parameter by, such as ``/mira/arm/pid/p``."""
        return self.source.full_name(key)

    def span(self, key: str) -> SourceSpan | None:
        """Return where a parameter stands, None when that is not known."""
        return self.source.span(key)

    def has(self, key: str) -> bool:
        """Tell whether a parameter was given, under any of its spellings."""
        return self._given(key) is not MISSING

    def raw(self, key: str, default: Any = None) -> Any:
        """Return what was given as it is, or a default of the caller's."""
        value = self._given(key)
        return default if value is MISSING else value

    def number(self, key: str, default: float | None = None) -> float:
        """Return a number within the row's limits; `default` in place of the table's."""
        value = self._given(key)
        fallback = float(self.default(key, default, 0.0))
        if value is MISSING:
            return fallback
        number = number_of(value)
        if number is None:
            return float(self._bad(key, value, "a number", fallback))
        if isinstance(value, str):
            text = f"parameter '{self.full_name(key)}' is the text '{value}', used as the number"
            text += f" {number:g}; real ROS would not take it (YAML 1.1 reads 1e-3 as a text)"
            self.report("parameter.number-as-text", text, key=key, fix=f"write {number!r}")
        return self._limited(key, number, fallback)

    def integer(self, key: str, default: int | None = None) -> int:
        """Return a whole number within the row's limits."""
        value = self.number(key, default)
        if not math.isfinite(value) or value != int(value):
            fallback = self.default(key, default, 0)
            return int(self._bad(key, value, "a whole number", fallback))
        return int(value)

    def flag(self, key: str, default: bool | None = None) -> bool:
        """Return a truth value; ROS' ``true``/``false`` as text and 0/1 are understood."""
        value = self._given(key)
        fallback = bool(self.default(key, default, False))
        if value is MISSING:
            return fallback
        found = flag_of(value)
        return bool(self._bad(key, value, "true or false", fallback)) if found is None else found

    def text(self, key: str, default: str | None = None) -> str:
        """Return a text; `default` in place of the table's."""
        value = self._given(key)
        fallback = str(self.default(key, default, ""))
        if value is MISSING:
            return fallback
        if isinstance(value, list | dict):
            return str(self._bad(key, value, "a text", fallback))
        return str(value)

    def texts(self, key: str) -> tuple[str, ...]:
        """Return texts: a list, or a text, which for ``words`` is parted at its spaces."""
        value = self._given(key)
        if value is MISSING:
            value = self.default(key, None, ())
        if isinstance(value, str):
            row = self.table.row_for(key)
            return tuple(value.split()) if row is not None and row.kind == "words" else (value,)
        if not isinstance(value, list | tuple):
            return tuple(self._bad(key, value, "a list of texts", ()))
        return tuple(str(item) for item in value)

    def numbers(self, key: str) -> tuple[float, ...]:
        """Return a list of numbers; a single one is a list of one."""
        value = self._given(key)
        default = tuple(self.default(key, None, ()))
        if value is MISSING:
            return default
        found = [
            number_of(item) for item in (value if isinstance(value, list | tuple) else [value])
        ]
        if any(item is None for item in found):
            return tuple(self._bad(key, value, "a list of numbers", default))
        return tuple(item for item in found if item is not None)

    def vector(self, key: str) -> tuple[float, float, float]:
        """Return three numbers."""
        found = self.numbers(key)
        if len(found) != 3:
            default = tuple(self.default(key, None, (0.0, 0.0, 0.0)))
            found = self._bad(key, list(found), "three numbers", default)
        x, y, z = found
        return (x, y, z)

    def group(self, key: str) -> dict[str, Any]:
        """Return a subtree, empty when it is absent."""
        value = self._given(key)
        return value if isinstance(value, dict) else {}

    def value(self, row: Parameter) -> Any:
        """Return the value of a row by its kind."""
        return getattr(self, _READ[row.kind])(row.key)

    def fill(self, options: type[_T], **others: Any) -> _T:
        """Return an instance of the option class that the table was made of.

        Args:
            options: the class, see `gazelle.parameters.dataclass_tables`.
            **others: values of fields that take the place of what was given.
        """
        own = {
            item.metadata.get("key") or item.name: item.name
            for item in fields(options)  # type: ignore[arg-type]
        }
        rows = [row for row in self.table.rows if row.kind in _READ and row.key in own]
        named = {own[row.key]: self.value(row) for row in rows}
        return options(**{**named, **others})

    def below(self, key: str, table: ParameterTable) -> ParameterReader:
        """Return a reader of a subtree."""
        return self.with_table(table, self.group(key), key)

    def with_table(
        self, table: ParameterTable, tree: Mapping[str, Any], name: str
    ) -> ParameterReader:
        """Return a reader of something below, with a table and values of its own."""
        return ParameterReader(table, TreeSource(tree), self.owner.below(name), self.diagnostics)

    def require(self, key: str) -> None:
        """Insist on a parameter.

        Raises:
            Exception: the owner's `ParameterOwner.missing`: it is absent; the message names the
                nearest one that is there.
        """
        if self.has(key):
            return
        names = (name for name, _ in self.source.leaves())
        there = [name for name in names if name.partition(".")[0] not in self.owner.managed]
        hint = did_you_mean(key, there)
        if not there and self.source.find("type") is MISSING:
            hint = f"it has no parameters at all: is its section named '{self.name}'?"
        row, full_name = self.table.row_for(key), self.full_name(key)
        others = "".join(f" or '{alias}'" for alias in row.aliases) if row is not None else ""
        # In ROS 2 parameters belong to their owner's node and have no longer name.
        told_as = f"parameter {full_name}" if full_name != key else f"parameter of node {self.name}"
        text = f"{self.owner.beginning}: no '{key}'{others} given ({told_as})"
        raise self.owner.missing(f"{text}; {hint}" if hint else text)

    def report(self, code: str, text: str, fix: str = "", *, key: str = "") -> None:
        """Report something about these parameters, at the place of one."""
        span = self.span(key) if key else None
        phrase = self.owner.bad_phrase if code == "parameter.bad-value" else ""
        message = f"{self.owner.beginning}: {text}"
        self.diagnostics.report(code, message, span, fix=fix, phrase=phrase)

    def report_unknown(self, *others: str) -> None:
        """Report what was given and is not known, and what changes nothing.

        Args:
            *others: names that somebody else reads, of subtrees too.
        """
        for name, value in self.source.leaves():
            word = name.partition(".")[0]
            if word in others or word in self.owner.managed:
                continue
            why = self.owner.refused.get(name, "")
            row = self.table.row_for(name)
            if why:
                self._report_idle(name, value, why)
            elif row is not None and row.is_refused:
                if row.asks_in_vain(value):
                    self._report_idle(name, value, row.meaning)
            elif row is None and value != {}:
                self._report_unknown(name, others)
            elif row is not None and self.ros_version not in (0, *row.ros_versions):
                self._report_idle(name, value, f"it is one of ROS {row.ros_versions[0]}")

    def _report_unknown(self, name: str, others: tuple[str, ...]) -> None:
        known = (*self.table.keys(), *others)
        filled = {"name": self.full_name(name), "family": self.table.family}
        hint = did_you_mean(name, known) or did_you_mean(name.partition(".")[0], known)
        self.report("parameter.unknown", self.owner.unknown.format(**filled), hint, key=name)

    def _report_idle(self, name: str, value: Any, why: str) -> None:
        filled = {"name": self.full_name(name), "value": shortened(value), "why": why}
        self.report("parameter.idle", self.owner.idle.format(**filled), key=name)

    def spellings(self, key: str) -> tuple[str, ...]:
        """Return the names under which a parameter may have been given."""
        # A key of a pattern's row (gains.joint_1.p) has no aliases of its own.
        row = self.table.exact_row(key)
        return (key,) if row is None else row.spellings(self.ros_version)

    def default(self, key: str, default: Any, otherwise: Any) -> Any:
        """Return the value of an absent parameter.

        Args:
            key: its name.
            default: takes the place of the table's, unless None.
            otherwise: what it is where the table has none.

        Raises:
            KeyError: the table has no such parameter: whoever reads it made a mistake.
        """
        if default is not None:
            return default
        row = self.table.row_for(key)
        # The table of a user's own class is empty: what there is, it alone knows.
        if row is None and self.table.rows:
            raise KeyError(f"{self.table.family} has no parameter {key}")
        found = None if row is None else row.default_in(self.ros_version)
        return otherwise if found is None else found

    def _given(self, key: str) -> Any:
        found = map(self.source.find, self.spellings(key))
        return next((value for value in found if value is not MISSING), MISSING)

    def _limited(self, key: str, value: float, fallback: float) -> float:
        row = self.table.row_for(key)
        if row is None or (row.low is None and row.high is None):
            if math.isnan(value) and not self.owner.takes_nan:
                return float(self._bad(key, value, "a number", fallback))
            return value
        low = -math.inf if row.low is None else row.low
        high = math.inf if row.high is None else row.high
        if low <= value <= high:
            return value
        used = min(max(value, low), high) if math.isfinite(value) else fallback
        return float(self._bad(key, value, f"a number of {low:g} to {high:g}", used))

    def _bad(self, key: str, value: Any, wanted: str, used: Any) -> Any:
        text = f"parameter '{self.full_name(key)}' is {value!r}, not {wanted}; {used!r} is used"
        self.report("parameter.bad-value", text, f"write {wanted}", key=key)
        return used
