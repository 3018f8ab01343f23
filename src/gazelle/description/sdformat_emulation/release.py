"""Which release of sdformat is followed."""

from __future__ import annotations

import enum

__all__ = ["Release"]


class Release(enum.Enum):
    """A release series of sdformat; the value is its major number."""

    V9 = 9
    V12 = 12
    V14 = 14

    @property
    def spec(self) -> tuple[int, int]:
        """The SDF version it prints: 1.7 is Gazebo 11's, 1.9 Fortress's, 1.11 Harmonic's."""
        return _SPECS[self]

    @property
    def spec_text(self) -> str:
        """`spec` as files write it."""
        return "{}.{}".format(*self.spec)

    @property
    def is_new(self) -> bool:
        """Whether it belongs to the new Gazebo: errors have places, includes stay models."""
        return self is not Release.V9


_SPECS = {Release.V9: (1, 7), Release.V12: (1, 9), Release.V14: (1, 11)}
