"""Reads the parameters of a controller; keys that nobody asked for are reported."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from gazelle.control.errors import ControllerError
from gazelle.control.table import ControllerTable
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean

__all__ = ["ControllerParameters", "flattened", "nested"]

# Keys every controller may have that the controller manager itself reads. Launch files give the
# description to all nodes of the process.
_MANAGED = frozenset(
    {
        "type",
        "use_sim_time",
        "params_file",
        "node_options_args",
        "update_rate",
        "is_async",
        "robot_description",
    }
)
# Keys of every controller's that change nothing here, and why.
_IDLE = {"fallback_controllers": "a controller that fails is stopped, no other takes its place"}
_MISSING = object()


def nested(tree: Mapping[str, Any]) -> dict[str, Any]:
    """Return a tree whose keys with dots or slashes became branches."""
    result: dict[str, Any] = {}
    for key, value in tree.items():
        *path, last = str(key).replace("/", ".").strip(".").split(".")
        branch = result
        for word in path:
            deeper = branch.setdefault(word, {})
            branch = deeper if isinstance(deeper, dict) else {}
        if isinstance(value, Mapping):
            inner = nested(value)
            known = branch.get(last)
            branch[last] = {**known, **inner} if isinstance(known, dict) else inner
        else:
            branch[last] = value
    return result


def flattened(tree: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Yield every leaf of a tree by its name with dots; empty branches are leaves."""
    for key, value in tree.items():
        name = f"{prefix}{key}"
        if isinstance(value, Mapping) and value:
            yield from flattened(value, f"{name}.")
        else:
            yield name, value


class ControllerParameters:
    """Typed access to one controller's parameters, defaults from its table.

    Args:
        name: the controller's name, for messages.
        tree: its parameters, nested or with dots.
        table: known keys with defaults.
        diagnostics: receives what is wrong.
        full_name: the name a user knows a key by, such as ``/mira/roll_controller/pid/p``.
        place: where a key stands, None when unknown.
    """

    def __init__(
        self,
        name: str,
        tree: Mapping[str, Any],
        table: ControllerTable,
        diagnostics: Diagnostics,
        *,
        full_name: Callable[[str], str] = str,
        place: Callable[[str], SourceSpan | None] = lambda key: None,
    ) -> None:
        self.name = name
        self.table = table
        self.diagnostics = diagnostics
        self.full_name = full_name
        self.place = place
        self.tree = nested(tree)

    def raw(self, key: str, default: Any = None) -> Any:
        """Return the value of a key (a name with dots) as it stands in the file."""
        value = self._find(key)
        return default if value is _MISSING else value

    def has(self, key: str) -> bool:
        """Tell whether a key of the table stands in the file, under any of its spellings."""
        return self._value(key) is not _MISSING

    def text(self, key: str, default: str | None = None) -> str:
        """Return a text; `default` instead of the table's when given."""
        value = self._value(key)
        if value is _MISSING:
            return str(self._default(key, default, ""))
        if isinstance(value, list | dict):
            return str(self._bad(key, value, "a text", self._default(key, default, "")))
        return str(value)

    def texts(self, key: str) -> tuple[str, ...]:
        """Return a list of texts; a single text is a list of one."""
        value = self._value(key)
        if value is _MISSING:
            return tuple(self._default(key, None, ()))
        if isinstance(value, str):
            return (value,)
        if not isinstance(value, list | tuple):
            self._bad(key, value, "a list of texts", ())
            return ()
        return tuple(str(item) for item in value)

    def flag(self, key: str) -> bool:
        """Return a truth value; ROS' ``true``/``false`` as text and 0/1 are understood."""
        value = self._value(key)
        default = bool(self._default(key, None, False))
        if value is _MISSING:
            return default
        if isinstance(value, bool) or value in (0, 1):
            return bool(value)
        if isinstance(value, str) and value.lower() in {"true", "false"}:
            return value.lower() == "true"
        return bool(self._bad(key, value, "true or false", default))

    def integer(self, key: str, default: int | None = None) -> int:
        """Return a whole number."""
        value = self.number(key, default)
        if value != int(value):
            return int(self._bad(key, value, "a whole number", int(value)))
        return int(value)

    def number(self, key: str, default: float | None = None) -> float:
        """Return a number; `default` instead of the table's when given."""
        value = self._value(key)
        fallback = self._default(key, default, 0.0)
        if value is _MISSING:
            return float(fallback)
        number = _number(value)
        if number is None:
            return float(self._bad(key, value, "a number", fallback))
        if isinstance(value, str):
            text = f"parameter '{self.full_name(key)}' is the text '{value}', used as the number"
            text += f" {number:g}; real ROS would not take it (YAML 1.1 reads 1e-3 as a text)"
            self.report("control.number-as-text", text, key=key, fix=f"write {number!r}")
        return number

    def numbers(self, key: str) -> tuple[float, ...]:
        """Return a list of numbers."""
        value = self._value(key)
        default = tuple(self._default(key, None, ()))
        if value is _MISSING:
            return default
        items = value if isinstance(value, list | tuple) else [value]
        found = [_number(item) for item in items]
        if any(item is None for item in found):
            return tuple(self._bad(key, value, "a list of numbers", default))
        return tuple(item for item in found if item is not None)

    def group(self, key: str) -> dict[str, Any]:
        """Return a subtree, empty when it is absent."""
        value = self._value(key)
        return value if isinstance(value, dict) else {}

    def require(self, key: str) -> None:
        """Insist on a key.

        Raises:
            ControllerError: it is absent; the message names the nearest key that is there.
        """
        if self.has(key):
            return
        there = [name for name, _ in flattened(self.tree) if name.partition(".")[0] not in _MANAGED]
        hint = did_you_mean(key, there)
        if not there and "type" not in self.tree:
            hint = f"it has no parameters at all: is its section named '{self.name}'?"
        row, full_name = self.table.row_for(key), self.full_name(key)
        others = "".join(f" or '{alias}'" for alias in row.aliases) if row is not None else ""
        # In ROS 2 parameters belong to the controller's own node and have no longer name.
        place = f"parameter {full_name}" if full_name != key else f"parameter of node {self.name}"
        text = f"controller '{self.name}': no '{key}'{others} given ({place})"
        raise ControllerError(f"{text}; {hint}" if hint else text)

    def report(self, code: str, text: str, *, key: str = "", fix: str = "") -> None:
        """Report something about a parameter, at its place."""
        place = self.place(key) if key else None
        self.diagnostics.report(code, f"controller '{self.name}': {text}", place, fix=fix)

    def report_unknown(self) -> None:
        """Report keys that the controller does not know, and those that change nothing."""
        known = [row.key for row in self.table.parameters if row.kind != "none"]
        for name, value in flattened(self.tree):
            if name.partition(".")[0] in _MANAGED:
                continue
            if name in _IDLE:
                self._report_idle(name, _IDLE[name])
                continue
            row = self.table.row_for(name)
            if row is None and value != {}:
                text = f"parameter '{self.full_name(name)}' is not one of this controller; it has "
                hint = did_you_mean(name, known)
                self.report("control.unknown-parameter", text + "no effect", key=name, fix=hint)
            elif row is not None and row.kind == "none":
                self._report_idle(name, row.meaning)

    def _report_idle(self, name: str, why: str) -> None:
        text = f"parameter '{self.full_name(name)}' has no effect: {why}"
        self.report("control.idle-parameter", text, key=name)

    def _value(self, key: str) -> Any:
        # A key of a pattern row (gains.joint_1.p) has no aliases of its own.
        try:
            row = self.table.parameter(key)
        except KeyError:
            return self._find(key)
        names = (row.key, *row.aliases)
        return next((v for v in map(self._find, names) if v is not _MISSING), _MISSING)

    def _find(self, key: str) -> Any:
        branch: Any = self.tree
        for word in key.split("."):
            if not isinstance(branch, dict) or word not in branch:
                return _MISSING
            branch = branch[word]
        return branch

    def _default(self, key: str, default: Any, otherwise: Any) -> Any:
        if default is not None:
            return default
        row = self.table.row_for(key)
        return otherwise if row is None or row.default is None else row.default

    def _bad(self, key: str, value: Any, wanted: str, used: Any) -> Any:
        text = f"parameter '{self.full_name(key)}' is {value!r}, not {wanted}; {used!r} is used"
        self.report("control.bad-value", text, key=key)
        return used


def _number(value: Any) -> float | None:
    if isinstance(value, bool):
        return None
    try:
        return float(value)
    except (OverflowError, TypeError, ValueError):
        return None
