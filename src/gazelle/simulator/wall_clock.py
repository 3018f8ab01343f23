"""How simulated time follows the wall clock, and what happens to that clock."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from enum import Enum

__all__ = ["Disturbances", "Mode", "Pace"]


_LONG_S = 2.0
# Of the time that has passed; loading and compiling compute all the while.
_IDLE_SHARE = 0.1
# Clocks that are corrected by the network creep; who sets one jumps.
_JUMP_S = 1.0


class Mode(Enum):
    """How the loop runs.

    REAL_TIME follows the world's real-time factor, cameras render beside the loop and a late
    frame is dropped. FAST is the same without waiting. LOCKSTEP does not wait either, but every
    frame is finished before time goes on: the mode of tests and CI.
    """

    REAL_TIME = "real-time"
    FAST = "fast"
    LOCKSTEP = "lockstep"


class Pace:
    """Tells how long to sleep so that simulated time is not ahead of its target.

    A world that falls behind does not catch up later (Gazebo neither): more than `_FORGET_S`
    behind, the schedule starts over.
    """

    _FORGET_S = 0.1
    # Work is done in slices of wall time so that commands and Ctrl-C are met in time.
    SLICE_S = 0.004

    def __init__(self, factor: float, *, clock: Callable[[], float] = time.monotonic) -> None:
        self.factor = factor
        self._clock = clock
        self._wall_start = clock()
        self._sim_start_ns = 0

    def restart(self, sim_ns: int) -> None:
        """Count from now on: after a pause, a reset or a change of the factor."""
        self._wall_start = self._clock()
        self._sim_start_ns = sim_ns

    def lead_s(self, sim_ns: int) -> float:
        """Return by how many seconds of wall time simulated time is ahead; 0 when it is not."""
        if self.factor <= 0:
            return 0.0
        target = self._wall_start + (sim_ns - self._sim_start_ns) * 1e-9 / self.factor
        lead = target - self._clock()
        if lead < -self._FORGET_S:
            self.restart(sim_ns)
        return max(0.0, lead)

    def slice_steps(self, step_ns: int) -> int:
        """Return how many steps fit into one slice of wall time at the wanted factor."""
        return max(1, int(self.SLICE_S * max(self.factor, 1e-3) * 1e9 / step_ns))


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
