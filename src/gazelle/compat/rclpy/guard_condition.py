"""Guard conditions (rclpy.guard_condition)."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.compat.rclpy.callback_groups import CallbackGroup

if TYPE_CHECKING:
    from gazelle.compat.rclpy.node import Node

__all__ = ["GuardCondition"]


class GuardCondition:
    """Lets the executor call something once after `trigger`; made by a node.

    Several triggers before the call are one, as in rclpy.
    """

    def __init__(
        self, node: Node, callback: Callable[[], Any] | None, group: CallbackGroup
    ) -> None:
        self.callback = callback
        self.callback_group = group
        self._node = node
        self._lock = threading.Lock()
        self._is_triggered = False
        self._is_destroyed = False
        group.add_entity(self)

    def trigger(self) -> None:
        """Ask for a call, from any thread."""
        with self._lock:
            if self._is_triggered or self._is_destroyed:
                return
            self._is_triggered = True
        self._node.post_work(self)

    def take(self) -> Callable[[], Any] | None:
        """Return the call that was asked for."""
        with self._lock:
            self._is_triggered = False
            return None if self._is_destroyed else self.callback

    def destroy(self) -> None:
        """Call nothing more."""
        self._is_destroyed = True
