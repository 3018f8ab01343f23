"""Tables that describe a controller: types, parameters, topics, interfaces.

The reader of parameters takes its defaults from them, and `docs/controllers.md` is generated from
them, so the page cannot say anything else than the code does.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

__all__ = ["ControllerTable", "Parameter", "Topic"]


@dataclass(frozen=True, slots=True)
class Parameter:
    """One parameter of a controller.

    Attributes:
        key: name with dots; ``<joint>`` stands for any word, as in ``gains.<joint>.p``.
        kind: ``text``, ``texts``, ``flag``, ``integer``, ``number``, ``numbers``, ``group`` for a
            subtree read by other means, or ``none`` for a key without effect.
        default: value when it is absent; None when it is required or the absence means something.
        meaning: what it does; for kind ``none`` why it does nothing.
        unit: SI unit, empty for none.
        aliases: other spellings, such as the other generation's.
        live: it may be set while the controller runs (ROS 2 parameters).
        generations: ROS generations that know it.
    """

    key: str
    kind: str
    default: object
    meaning: str
    unit: str = ""
    aliases: tuple[str, ...] = ()
    live: bool = False
    generations: tuple[int, ...] = (1, 2)

    def matches(self, key: str) -> bool:
        """Tell whether a parameter's name, with dots, is this row's."""
        return any(_pattern(name).fullmatch(key) for name in (self.key, *self.aliases))


@dataclass(frozen=True, slots=True)
class Topic:
    """A topic, service or action of a controller.

    Attributes:
        name: ``~/command`` is the controller's own, ``joint_states`` the manager's namespace.
        type: ROS type.
        kind: ``publishes``, ``listens``, ``service`` or ``action``.
        rate: how often, in words.
        frame: ``header.frame_id``, in words; empty for none.
        generations: ROS generations that have it.
    """

    name: str
    type: str
    kind: str = "publishes"
    rate: str = ""
    frame: str = ""
    generations: tuple[int, ...] = (1, 2)


@dataclass(frozen=True, slots=True)
class ControllerTable:
    """Everything the documentation says about one family of controllers.

    Attributes:
        family: short name.
        summary: what it does, one or two sentences.
        types: type names of both generations; ROS 1's have the hardware interface in them.
        interfaces: what it claims and reads, in words.
        behaviour: facts of behaviour, one sentence each, with their source.
    """

    family: str
    summary: str
    types: tuple[str, ...]
    interfaces: str
    parameters: tuple[Parameter, ...] = ()
    topics: tuple[Topic, ...] = ()
    behaviour: tuple[str, ...] = ()
    _by_key: dict[str, Parameter] = field(default_factory=dict, repr=False, compare=False)

    def parameter(self, key: str) -> Parameter:
        """Return the row of a key as the table writes it, or of one of its other spellings.

        Raises:
            KeyError: the table has no such row.
        """
        if not self._by_key:
            for row in self.parameters:
                for name in (row.key, *row.aliases):
                    self._by_key[name] = row
        return self._by_key[key]

    def row_for(self, key: str) -> Parameter | None:
        """Return the row that a parameter's name belongs to, None when it is unknown."""
        for row in self.parameters:
            if row.matches(key) or (
                row.kind in {"group", "none"} and _begins(key, (row.key, *row.aliases))
            ):
                return row
        return None


def _begins(key: str, names: tuple[str, ...]) -> bool:
    return any(key.startswith(f"{name}.") for name in names)


def _pattern(key: str) -> re.Pattern[str]:
    return re.compile(re.sub(r"<\w+>", r"[^.]+", key.replace(".", r"\.")))
