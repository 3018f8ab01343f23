"""Timers and rates (rclpy.timer)."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.compat.rclpy.callback_groups import CallbackGroup
from gazelle.compat.rclpy.clock import Clock
from gazelle.compat.rclpy.exceptions import ROSInterruptException

if TYPE_CHECKING:
    from gazelle.compat.rclpy.node import Node

__all__ = ["Rate", "Timer"]


class Timer:
    """Calls back once a period of its clock; made by `Node.create_timer`.

    Calls that could not be made in time are left out, as in ROS 2.
    """

    def __init__(
        self,
        node: Node,
        callback: Callable[..., Any],
        period_ns: int,
        clock: Clock,
        group: CallbackGroup,
        *,
        autostart: bool = True,
    ) -> None:
        self.callback = callback
        self.callback_group = group
        self.clock = clock
        self._node = node
        self._period_ns = period_ns
        self._lock = threading.Lock()
        self._generation = 0
        self._canceled = not autostart
        self._is_posted = False
        self._last_ns = self._next_ns = 0
        group.add_entity(self)
        if autostart:
            self.reset()

    @property
    def timer_period_ns(self) -> int:
        """The period in nanoseconds; a new one counts from the next call."""
        return self._period_ns

    @timer_period_ns.setter
    def timer_period_ns(self, value: int) -> None:
        self._period_ns = int(value)

    def is_canceled(self) -> bool:
        """Tell whether it was stopped."""
        return self._canceled

    def is_ready(self) -> bool:
        """Tell whether a call is due."""
        return not self._canceled and self.clock.now_ns() >= self._next_ns

    def cancel(self) -> None:
        """Call no more, until `reset`."""
        with self._lock:
            self._canceled = True
            self._generation += 1

    destroy = cancel

    def reset(self) -> None:
        """Begin a new period now."""
        with self._lock:
            self._canceled = False
            self._generation += 1
            self._last_ns = self.clock.now_ns()
            self._next_ns = self._last_ns + self._period_ns
            generation = self._generation
        threading.Thread(
            target=self._keep_time, args=(generation,), name="timer", daemon=True
        ).start()

    def time_since_last_call(self) -> int:
        """Return the nanoseconds since the last call."""
        return self.clock.now_ns() - self._last_ns

    def time_until_next_call(self) -> int | None:
        """Return the nanoseconds until the next call, None when it was stopped."""
        return None if self._canceled else self._next_ns - self.clock.now_ns()

    def take(self) -> Callable[[], Any] | None:
        """Return the call that is due."""
        with self._lock:
            self._is_posted = False
            if self._canceled:
                return None
            self._last_ns = self.clock.now_ns()
            return self.callback

    def _keep_time(self, generation: int) -> None:
        def is_over() -> bool:
            return self._generation != generation or self._node.is_destroyed

        while not is_over():
            if self.clock.sleep_until_ns(self._next_ns, is_over):
                self._fire()
            elif not self._node.context.ok():
                return
            else:
                # Time went back, or the clock changed: the period begins anew.
                self._next_ns = self.clock.now_ns() + self._period_ns

    def _fire(self) -> None:
        with self._lock:
            now_ns = self.clock.now_ns()
            behind = max(0, now_ns - self._next_ns) // max(self._period_ns, 1)
            self._next_ns += (behind + 1) * self._period_ns
            if self._is_posted or self._canceled:
                return
            self._is_posted = True
        self._node.post_work(self)


class Rate:
    """Sleeps at a rate; made by `Node.create_rate`. Somebody else must spin."""

    def __init__(self, node: Node, period_ns: int, clock: Clock) -> None:
        self._node = node
        self._clock = clock
        self._period_ns = period_ns
        self._next_ns = clock.now_ns() + period_ns
        self._destroyed = False

    def sleep(self) -> None:
        """Sleep until the next point of the rate.

        Raises:
            ROSInterruptException: the context was shut down.
        """
        done = self._clock.sleep_until_ns(
            self._next_ns, lambda: self._destroyed or not self._node.context.ok()
        )
        if not done and not self._node.context.ok():
            raise ROSInterruptException
        now_ns = self._clock.now_ns()
        late = now_ns - self._next_ns > self._period_ns or not done
        self._next_ns = (now_ns if late else self._next_ns) + self._period_ns

    def destroy(self) -> None:
        """Sleep no more."""
        self._destroyed = True
