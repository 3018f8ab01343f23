"""Tells a runtime of C++ what the graph's clock shows, and where it can look itself."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gazelle.cpp.host.table import Core
    from gazelle.graph.clock import Clock

__all__ = ["ClockTeller"]


class ClockTeller:
    """Tells of each switch, message and jump of a clock."""

    def __init__(self, clock: Clock, core: Core) -> None:
        """Begin with what it shows now."""
        self._clock = clock
        self._core = core
        self._jumps = clock.told_jumps
        self._lock = threading.Lock()
        # C++ may be looking at one that is used no more.
        self._pages: dict[int, object] = {}
        clock.watch(self._tell)
        self._tell()

    def _tell(self) -> None:
        clock = self._clock
        with self._lock:
            page = clock.page
            jumps, sim_time = clock.told_jumps, clock.use_sim_time
            jump_ns = clock.last_jump_ns if jumps != self._jumps and page is None else 0
            self._jumps = jumps
            address = 0
            if page is not None:
                address = page.address
                self._pages[address] = page
            now_ns = clock.now_ns() if sim_time else 0
            self._core.on_clock(sim_time=sim_time, page=address, now_ns=now_ns, jump_ns=jump_ns)
