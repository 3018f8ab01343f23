"""Stamps of the wrong clock: messages of the wall clock in a graph with simulated time."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING, Any

from gazelle.graph.errors import coded

if TYPE_CHECKING:
    from gazelle.graph.clock import Clock

__all__ = ["StampWatch"]

# Far more than what clocks and networks differ by, far less than what the two times do.
_SAME_S = 3600.0


class StampWatch:
    """Finds messages whose stamps are wall time while simulated time is used.

    Nodes that read such messages look for transforms of years to come (navigation2#3746), and the
    errors name the reader. So the writer is named, once by each process.
    """

    def __init__(self, clock: Clock) -> None:
        """Start with nobody named.

        Args:
            clock: of the nodes of this process.
        """
        self._clock = clock
        self._named: set[str] = set()
        self._lock = threading.Lock()

    def is_wrong(self, message: Any) -> bool:
        """Return whether a message has a stamp of the wall clock; cheap with wall time."""
        if not self._clock.use_sim_time:
            return False
        stamp_s = _stamp_s(message)
        if not stamp_s or abs(stamp_s - time.time()) > _SAME_S:
            return False
        now_s = self._clock.now_ns() / 1e9
        return now_s > 0 and abs(stamp_s - now_s) > _SAME_S

    def sentence(self, message: Any, topic: str, publisher: str) -> str:
        """Return what to tell about such a message, empty when its node has been named."""
        name = publisher or "a node that has gone"
        with self._lock:
            if name in self._named:
                return ""
            self._named.add(name)
        text = (
            f"{name} stamps {topic} with wall time ({_stamp_s(message)} s) while simulated time is "
            f"{self._clock.now_ns() / 1e9:.3f} s"
        )
        return coded("graph.wall-stamps", text)


def _stamp_s(message: Any) -> int:
    """Return the whole seconds of a message's stamp, or of its first transform's; else 0."""
    header = getattr(message, "header", None)
    if header is None:
        transforms = getattr(message, "transforms", None)
        if not transforms:
            return 0
        header = getattr(transforms[0], "header", None)
    stamp = getattr(header, "stamp", None)
    seconds = getattr(stamp, "sec", None)
    return int(seconds if seconds is not None else getattr(stamp, "secs", 0))
