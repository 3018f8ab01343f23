"""Which release of sdformat is followed."""

from __future__ import annotations

import enum

__all__ = ["Release"]


class Release(enum.Enum):
    """A release series of sdformat; the value is its major number."""

    V9 = 9
    V12 = 12

    @property
    def spec(self) -> tuple[int, int]:
        """The SDF version it prints: 1.7 for Gazebo 11's, 1.9 for Fortress's."""
        return (1, 7) if self is Release.V9 else (1, 9)
