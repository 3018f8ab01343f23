"""Forces on links that last for a time."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

__all__ = ["TimedWrench", "WrenchTable"]

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class TimedWrench:
    """A wrench on a link.

    Attributes:
        link: ``model::link``.
        force_n: world frame, (3,).
        torque_nm: about the centre of mass, world frame, (3,).
        until: first step at which it no longer acts, None for ever.
    """

    link: str
    force_n: Array
    torque_nm: Array
    until: int | None


@dataclass(slots=True)
class WrenchTable:
    """All wrenches that act now; `changed` tells that the sums must be written again."""

    items: list[TimedWrench] = field(default_factory=list)
    changed: bool = False

    def add(self, item: TimedWrench) -> None:
        """Let a wrench act from now on."""
        self.items.append(item)
        self.changed = True

    def copy(self) -> WrenchTable:
        """Return a copy for a saved state; the wrenches themselves never change."""
        return WrenchTable(list(self.items), self.changed)

    def remove(self, item: TimedWrench) -> None:
        """End one wrench; one that has ended already is left alone."""
        kept = [other for other in self.items if other is not item]
        self.changed = self.changed or len(kept) != len(self.items)
        self.items = kept

    def clear(self, links: frozenset[str] | None = None) -> None:
        """Remove the wrenches on some links, or all."""
        kept = [] if links is None else [item for item in self.items if item.link not in links]
        self.changed = self.changed or len(kept) != len(self.items)
        self.items = kept

    def steps_until_change(self, step: int, wanted: int) -> int:
        """Return how many of the wanted steps can be made before a wrench ends."""
        if not self.items:
            return wanted
        ends = [item.until - step for item in self.items if item.until is not None]
        return max(1, min([wanted, *ends]))

    def expire(self, step: int) -> None:
        """Drop wrenches that have ended."""
        if not self.items:
            return
        kept = [item for item in self.items if item.until is None or item.until > step]
        self.changed = self.changed or len(kept) != len(self.items)
        self.items = kept

    def sums(self) -> dict[str, Array]:
        """Return force and torque together, (6,), by link."""
        sums: dict[str, Array] = {}
        for item in self.items:
            total = sums.setdefault(item.link, np.zeros(6))
            total[:3] += item.force_n
            total[3:] += item.torque_nm
        return sums
