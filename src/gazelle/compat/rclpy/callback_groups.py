"""Which callbacks of a node may run at the same time (rclpy.callback_groups)."""

from __future__ import annotations

import threading
from typing import Any

__all__ = ["CallbackGroup", "MutuallyExclusiveCallbackGroup", "ReentrantCallbackGroup"]


class CallbackGroup:
    """Base of groups; this one sets no limits."""

    def __init__(self) -> None:
        self.entities: set[Any] = set()

    def add_entity(self, entity: Any) -> None:
        """Put something with callbacks into the group."""
        self.entities.add(entity)

    def has_entity(self, entity: Any) -> bool:
        """Tell whether something is in the group."""
        return entity in self.entities

    def can_execute(self, entity: Any) -> bool:
        """Tell whether a callback of this entity may start now."""
        del entity
        return True

    def beginning_execution(self, entity: Any) -> bool:
        """Claim the right to run a callback; False when it must wait."""
        del entity
        return True

    def ending_execution(self, entity: Any) -> None:
        """Give the right back."""


class ReentrantCallbackGroup(CallbackGroup):
    """All callbacks may run at the same time, each also with itself."""


class MutuallyExclusiveCallbackGroup(CallbackGroup):
    """One callback at a time."""

    def __init__(self) -> None:
        super().__init__()
        self._active: Any = None
        self._lock = threading.Lock()

    def can_execute(self, entity: Any) -> bool:
        """Tell whether a callback of this entity may start now."""
        with self._lock:
            return self._active is None

    def beginning_execution(self, entity: Any) -> bool:
        """Claim the right to run a callback; False when it must wait."""
        with self._lock:
            if self._active is not None:
                return False
            self._active = entity
            return True

    def ending_execution(self, entity: Any) -> None:
        """Give the right back."""
        with self._lock:
            if self._active is entity:
                self._active = None
