"""What waits to be run by an executor."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from gazelle.compat.rclpy.callback_groups import CallbackGroup

__all__ = ["Once", "Work"]


class Work(Protocol):
    """A subscription, timer, service … that has something to do."""

    callback_group: CallbackGroup

    def take(self) -> Callable[[], Any] | None:
        """Return the next thing to do, None when it is done already."""
        ...


class Once:
    """One call."""

    def __init__(self, callback_group: CallbackGroup, callback: Callable[[], Any]) -> None:
        self.callback_group = callback_group
        self._callback: Callable[[], Any] | None = callback

    def take(self) -> Callable[[], Any] | None:
        """Return the call, the first time."""
        callback, self._callback = self._callback, None
        return callback
