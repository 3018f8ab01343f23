"""When a stamp of the bag is due on the wall's clock."""

from __future__ import annotations

import time
from collections.abc import Callable

__all__ = ["Timeline"]


class Timeline:
    """Maps stamps to the wall's clock, at a rate; it can be held and shifted.

    Attributes:
        rate: seconds of the bag in a second.
    """

    def __init__(
        self, start_ns: int, rate: float, now_ns: Callable[[], int] = time.monotonic_ns
    ) -> None:
        """Start now at a stamp."""
        self.rate = rate
        self._now_ns = now_ns
        self._stamp_ns = start_ns
        self._wall_ns = now_ns()
        self._held = False

    @property
    def held(self) -> bool:
        """Whether time stands still."""
        return self._held

    def wait_ns(self, stamp_ns: int) -> int:
        """Return how long it is until a stamp is due; not positive when it is."""
        due_ns = self._wall_ns + int((stamp_ns - self._stamp_ns) / self.rate)
        return due_ns - self._now_ns()

    def stamp_ns(self) -> int:
        """Return the stamp that is due now."""
        if self._held:
            return self._stamp_ns
        return self._stamp_ns + int((self._now_ns() - self._wall_ns) * self.rate)

    def hold(self, stamp_ns: int | None = None) -> None:
        """Stand still, at a stamp or at that of now."""
        self._stamp_ns = self.stamp_ns() if stamp_ns is None else stamp_ns
        self._held = True

    def go_on(self) -> None:
        """Run from where it was held."""
        self._wall_ns = self._now_ns()
        self._held = False

    def jump(self, stamp_ns: int) -> None:
        """Be at a stamp now."""
        self._stamp_ns, self._wall_ns = stamp_ns, self._now_ns()

    def set_rate(self, rate: float) -> None:
        """Go on from now at another rate."""
        self.jump(self.stamp_ns())
        self.rate = rate
