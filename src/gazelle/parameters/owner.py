"""Whose parameters a reader reads, and how its messages say so."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from gazelle.errors import GazelleError

__all__ = ["ParameterOwner"]


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
