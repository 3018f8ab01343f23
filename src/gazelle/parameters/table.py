"""Tables of parameters: a row for each parameter and topic of one controller, plug-in or node."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import KW_ONLY, dataclass, field
from functools import lru_cache
from typing import Any, Literal

__all__ = ["Parameter", "ParameterKind", "ParameterTable", "Topic", "TopicKind", "refused"]


ParameterKind = Literal[
    "any", "flag", "group", "integer", "number", "numbers", "refused", "text", "texts", "vector",
    "words",
]  # fmt: skip

_ROS2 = 2

# What is below them is theirs, too.
_WITH_BRANCHES = ("group", "refused")


@dataclass(frozen=True, slots=True)
class Parameter:
    """One parameter.

    Attributes:
        key: its name, parts joined with dots; ``<joint>`` stands for any one word, as in
            ``gains.<joint>.p``.
        kind: type of its value. A single text is a list of one for ``texts`` and parted at its
            spaces for ``words``; ``vector`` is three numbers; ``any`` is read by other means and
            so is ``group``, a subtree; ``refused`` is known and has no effect here.
        default: value when it is absent; None when it is required or the absence means something.
            Of a refused one the value that asks for nothing, so that it is not told.
        meaning: what it does; of a refused one why it does nothing.
        unit: SI unit, empty for none.
        low: smallest value, None for none.
        high: largest value, None for none.
        aliases: other spellings, such as the other generation's.
        live: dynamic_reconfigure or ``ros2 param set`` changes it while its owner runs.
        ros_versions: those of ROS that know it.
        ros2_default: what ROS 2 takes for an absent one where that differs, None where not.
    """

    key: str
    kind: ParameterKind
    default: Any
    meaning: str
    unit: str = ""
    low: float | None = None
    high: float | None = None
    _: KW_ONLY
    aliases: tuple[str, ...] = ()
    live: bool = False
    ros_versions: tuple[int, ...] = (1, 2)
    ros2_default: Any = None

    @property
    def names(self) -> tuple[str, ...]:
        """All spellings, the table's own first."""
        return (self.key, *self.aliases)

    @property
    def is_refused(self) -> bool:
        """True when it is known and has no effect."""
        return self.kind == "refused"

    def asks_in_vain(self, value: Any) -> bool:
        """Tell whether a value asks for something that does not happen here."""
        return self.is_refused and (self.default is None or value != self.default)

    @property
    def is_exact(self) -> bool:
        """True when it stands for one name, no pattern and no branch."""
        return self.kind not in _WITH_BRANCHES and not any("<" in name for name in self.names)

    def matches(self, name: str) -> bool:
        """Tell whether a name with dots is this row's, or lies below it where it is a branch."""
        branches = self.kind in _WITH_BRANCHES
        return any(_pattern(own, branches).fullmatch(name) for own in self.names)

    def spellings(self, ros_version: int) -> tuple[str, ...]:
        """Return the names that count in a generation of ROS, 0 for any.

        ROS 1's plug-ins write camelCase and ROS 2's snake_case; a key that is spelled in one way
        only is spelled so in both.
        """
        if not ros_version:
            return self.names
        if ros_version not in self.ros_versions:
            return ()
        own = tuple(name for name in self.names if _is_written_in(name, ros_version))
        return own or self.names

    def default_in(self, ros_version: int) -> Any:
        """Return the value of an absent one in a generation of ROS."""
        if ros_version == _ROS2 and self.ros2_default is not None:
            return self.ros2_default
        return self.default


def refused(why: str, *keys: str, unless: Any = None) -> tuple[Parameter, ...]:
    """Return rows of parameters that have no effect, for one reason.

    Args:
        why: the reason.
        *keys: the names.
        unless: the value that asks for nothing, None where every value asks for something.
    """
    return tuple(Parameter(key, "refused", unless, why) for key in keys)


@lru_cache(maxsize=4096)
def _pattern(key: str, branches: bool) -> re.Pattern[str]:
    below = r"(\..*)?" if branches else ""
    return re.compile(re.sub(r"<\w+>", r"[^.]+", re.escape(key)) + below)


def _is_written_in(name: str, ros_version: int) -> bool:
    if ros_version == _ROS2:
        return name == name.lower()
    return "_" not in name


TopicKind = Literal["publishes", "listens", "service", "action"]


@dataclass(frozen=True, slots=True)
class Topic:
    """A topic, service or action of a controller, plug-in or node.

    Attributes:
        name: ``~/command`` lies in the owner's namespace, ``joint_states`` in the one above; words
            in braces are parameters.
        type: ROS type.
        kind: what is done with it.
        rate: how often, in words.
        frame: ``header.frame_id``, in words; empty for none.
        ros_versions: those of ROS that have it.
        ros2: the name in ROS 2, where that is another.
    """

    name: str
    type: str
    kind: TopicKind = "publishes"
    rate: str = ""
    frame: str = ""
    ros_versions: tuple[int, ...] = (1, 2)
    ros2: str = ""


@dataclass(frozen=True, slots=True)
class ParameterTable:
    """All parameters that there are, what has an effect and what not.

    Attributes:
        family: its name in the documentation.
        summary: what it is, one or two sentences.
        types: the names it goes by: types of a controller or of a plug-in in parameter files,
            libraries without ``lib`` and ``.so``, ``package/type`` of a node.
        rows: one of them each.
    """

    family: str
    summary: str
    types: tuple[str, ...] = ()
    rows: tuple[Parameter, ...] = ()
    _by_name: dict[str, Parameter] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    def row(self, key: str) -> Parameter:
        """Return the row of a key as the table writes it, or of one of its other spellings.

        Raises:
            KeyError: there is none.
        """
        found = self.exact_row(key)
        if found is None:
            raise KeyError(f"{self.family} has no parameter {key}")
        return found

    def exact_row(self, name: str) -> Parameter | None:
        """Return the row that is spelled so letter for letter, None when there is none."""
        return self._index().get(name)

    def row_for(self, name: str) -> Parameter | None:
        """Return the row that a parameter's name belongs to, None when it is unknown."""
        found = self.exact_row(name)
        if found is not None:
            return found
        return next((row for row in self.rows if not row.is_exact and row.matches(name)), None)

    def keys(self) -> list[str]:
        """Return the names of all parameters that have an effect."""
        return [row.key for row in self.rows if not row.is_refused]

    def plus(self, rows: Iterable[Parameter]) -> ParameterTable:
        """Return a table with more rows."""
        return ParameterTable(self.family, self.summary, self.types, (*self.rows, *rows))

    def _index(self) -> dict[str, Parameter]:
        if not self._by_name:
            for row in self.rows:
                for name in row.names:
                    self._by_name.setdefault(name, row)
        return self._by_name
