"""What the system did to a running world: it stood still, or its clock was set."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

__all__ = ["Disturbances"]

_LONG_S = 2.0
# Of the time that has passed; loading and compiling compute all the while.
_IDLE_SHARE = 0.1
# Clocks that are corrected by the network creep; who sets one jumps.
_JUMP_S = 1.0


class Disturbances:
    """Compares the clocks of the process from look to look.

    SIGSTOP, a debugger and a machine that is busy with other things let it stand still. While a
    machine sleeps the clocks stand still themselves; that is not seen.
    """

    def __init__(
        self,
        *,
        wall: Callable[[], float] = time.time,
        monotonic: Callable[[], float] = time.monotonic,
        computing: Callable[[], float] = time.process_time,
    ) -> None:
        """Begin to look; the clocks tell seconds."""
        self._clocks = (wall, monotonic, computing)
        self._before = self._now()

    def look(self, world_s: float, idle_s: float = 0.0) -> Iterator[str]:
        """Yield what has happened since the last look.

        Args:
            world_s: what the world's clock shows.
            idle_s: for how long there was nothing to do, infinity in a pause.
        """
        wall_then_s, then_s, computed_s = self._before
        wall_now_s, now_s, computing_s = self._before = self._now()
        passed_s, work_s = now_s - then_s, computing_s - computed_s
        if passed_s - idle_s > _LONG_S and work_s < _IDLE_SHARE * passed_s:
            yield (
                f"nothing was computed for {passed_s:.1f} s: this process was stopped, or the "
                f"machine had no time for it; the world goes on from {world_s:.3f} s"
            )
        if abs(jump_s := wall_now_s - wall_then_s - passed_s) > _JUMP_S:
            way = "back" if jump_s < 0 else "ahead"
            yield (
                f"the system's clock was set {way} by {abs(jump_s):.1f} s; simulated time goes on "
                "as before, stamps of the system's clock jump"
            )

    def _now(self) -> tuple[float, float, float]:
        wall, monotonic, computing = self._clocks
        return wall(), monotonic(), computing()
