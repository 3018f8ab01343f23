"""Where the robot's joints are now, of ``joint_states``."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable
from typing import Any

from gazelle.graph import Node
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import ns_of

__all__ = ["StateMonitor"]


class StateMonitor:
    """Collects joint states; several publishers may each tell some of the joints."""

    def __init__(self, node: Node, topic: str = "joint_states") -> None:
        """Listen to a topic."""
        self._changed = threading.Condition()
        self._positions: dict[str, float] = {}
        self._velocities: dict[str, float] = {}
        self._stamps_ns: dict[str, int] = {}
        self._listeners: list[Callable[[], None]] = []
        self._clock = node.clock
        self.topic = node.resolve_name(topic)
        node.create_subscription(
            topic, message_type("sensor_msgs/msg/JointState"), self._take, queue_size=10
        )
        node.clock.on_jump(self._on_jump)

    @property
    def positions(self) -> dict[str, float]:
        """Last position of every joint that was told of, rad or m."""
        with self._changed:
            return dict(self._positions)

    @property
    def velocities(self) -> dict[str, float]:
        """Last velocity of the joints that have one, rad/s or m/s."""
        with self._changed:
            return dict(self._velocities)

    @property
    def stamp_ns(self) -> int:
        """Stamp of the newest message, 0 before the first."""
        with self._changed:
            return max(self._stamps_ns.values(), default=0)

    def on_change(self, listener: Callable[[], None]) -> None:
        """Call back after each message, in the graph's thread."""
        self._listeners.append(listener)

    def missing(self, joints: Iterable[str], since_ns: int = 0) -> tuple[str, ...]:
        """Return the joints of which no position is known that is as new as a time."""
        with self._changed:
            return tuple(name for name in joints if self._stamps_ns.get(name, -1) < since_ns)

    def wait(self, joints: Iterable[str], since_ns: int, timeout_s: float) -> tuple[str, ...]:
        """Wait in wall time for states as new as a time; return the joints that never came."""
        wanted, deadline = tuple(joints), time.monotonic() + timeout_s
        with self._changed:
            while self.missing(wanted, since_ns):
                left_s = deadline - time.monotonic()
                if left_s <= 0 or not self._changed.wait(left_s):
                    break
            return self.missing(wanted, since_ns)

    def wait_for_any(self, timeout_s: float) -> bool:
        """Wait in wall time until any joint is known; tell whether one is."""
        with self._changed:
            return self._changed.wait_for(lambda: bool(self._positions), timeout_s)

    def wait_for_next(self, timeout_s: float) -> bool:
        """Wait in wall time for any message; tell whether one came."""
        with self._changed:
            return self._changed.wait(timeout_s)

    def _take(self, message: Any) -> None:
        stamp = message.header.stamp
        # States without a stamp are those of now, as fake publishers send them.
        stamp_ns = ns_of(stamp) or self._clock.now_ns()
        with self._changed:
            self._store(self._positions, message.name, message.position)
            self._store(self._velocities, message.name, message.velocity)
            for name, _ in zip(message.name, message.position, strict=False):
                self._stamps_ns[name] = stamp_ns
            self._changed.notify_all()
        for listener in tuple(self._listeners):
            listener()

    def _store(self, into: dict[str, float], names: Iterable[str], values: Iterable[Any]) -> None:
        into.update(zip(names, map(float, values), strict=False))

    def _on_jump(self, _delta_ns: int) -> None:
        with self._changed:
            self._stamps_ns = dict.fromkeys(self._stamps_ns, 0)
