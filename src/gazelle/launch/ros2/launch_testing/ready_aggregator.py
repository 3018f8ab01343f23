"""Being ready when several things are."""

from __future__ import annotations

import threading
from collections.abc import Callable

__all__ = ["ReadyAggregator"]


class ReadyAggregator:
    """Calls a function when `ready_fn` has been called so often."""

    def __init__(self, ready_fn: Callable[[], object], num_to_aggregate: int) -> None:
        self._tell = ready_fn
        self._left = num_to_aggregate
        self._lock = threading.Lock()

    def ready_fn(self) -> None:
        """Count one more, from any thread."""
        with self._lock:
            self._left -= 1
            is_last = self._left == 0
        if is_last:
            self._tell()
