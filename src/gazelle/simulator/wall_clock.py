"""How simulated time follows the wall clock."""

from __future__ import annotations

import time
from collections.abc import Callable
from enum import Enum

__all__ = ["Mode", "Pace"]


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
