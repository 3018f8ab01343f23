"""Time, told to viewers.

A viewer takes the server's time where the server says it has one, so it is told always: the
simulator's where ``/use_sim_time`` is true (or is not set and somebody publishes ``/clock``, as a
launch of ROS 2 has it), else wall time.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

from gazelle.errors import GazelleError

if TYPE_CHECKING:
    from gazelle.graph import Graph

__all__ = ["ViewerClock"]

_FAST_S = 1 / 30
_SLOW_S = 0.5
_USE_SIM_TIME = "/use_sim_time"


class ViewerClock:
    """Tells the time, often while somebody looks at a topic."""

    def __init__(self, graph: Graph, tell: Callable[[int], None]) -> None:
        """Start to tell.

        Args:
            graph: has the clock.
            tell: gets nanoseconds.
        """
        self._graph = graph
        self._tell = tell
        self._is_fast = False
        self._told_ns = -1
        self._wake = threading.Event()
        self._ended = False
        self._thread = threading.Thread(target=self._run, name="foxglove time", daemon=True)
        self._thread.start()

    def sim_time(self) -> int | None:
        """Return simulated time in nanoseconds, None where wall time counts."""
        clock = self._graph.clock
        return clock.now_ns() if clock.use_sim_time else None

    def beat(self, *, fast: bool) -> None:
        """Tell the time often, or seldom and without listening to ``/clock`` all the while."""
        if fast != self._is_fast:
            self._is_fast = fast
            # At once: the first messages need their time too.
            self._choose()
            self._wake.set()

    def close(self) -> None:
        """Tell the time no more."""
        self._ended = True
        self._wake.set()
        self._thread.join()

    def _run(self) -> None:
        while not self._ended:
            is_simulated = self._choose()
            now_ns = self._graph.clock.now_ns()
            # Simulated time is not known while nobody looks, and 0 until the first message.
            if now_ns and is_simulated == self._graph.clock.use_sim_time:
                self._tell_once(now_ns)
            self._wake.wait(_FAST_S if self._is_fast else _SLOW_S)
            self._wake.clear()

    def _tell_once(self, now_ns: int) -> None:
        if now_ns != self._told_ns:
            self._told_ns = now_ns
            self._tell(now_ns)

    def _choose(self) -> bool:
        """Follow the clock that counts, if somebody looks; return whether it is simulated."""
        is_simulated = self._has_sim_time()
        wanted = self._is_fast and is_simulated
        if wanted != self._graph.clock.use_sim_time:
            self._graph.clock.use(wanted)
        return is_simulated

    def _has_sim_time(self) -> bool:
        try:
            chosen = self._graph.parameters.get_cached(_USE_SIM_TIME, None)
        except GazelleError:
            # Whoever held the parameters has just gone.
            return False
        if chosen is None:
            return self._graph.publisher_count("/clock") > 0
        return chosen is True or chosen == "true"
