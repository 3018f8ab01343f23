"""The velocity command of a wheeled base: Twist or TwistStamped, and for how long it holds."""

from __future__ import annotations

import math
from typing import Any

from gazelle.control.controller_node_interface import Ports
from gazelle.control.wheels.kinematics import PlanarTwist
from gazelle.interfaces.stamps import ns_of

__all__ = ["REST", "TwistInput"]

REST = PlanarTwist(0.0, 0.0, 0.0)
_BOTH = ("geometry_msgs/Twist", "geometry_msgs/TwistStamped")


class TwistInput:
    """Keeps the newest command.

    A `Twist` counts from the update after its arrival, and so does a `TwistStamped` in ROS 1;
    ROS 2's controllers count a `TwistStamped` from its stamp, when it has one of simulated time.

    Args:
        ports: the outside world.
        timeout_s: how long a command holds.
        uses_stamps: whether stamps count.
        endless: a timeout of 0 means that a command holds until the next one; else it holds for
            one update.
    """

    def __init__(
        self, ports: Ports, timeout_s: float, *, uses_stamps: bool, endless: bool = False
    ) -> None:
        self.timeout_s = timeout_s
        self._ports = ports
        self._uses_stamps = uses_stamps
        self._endless = endless
        self._now_ns = 0
        self._twist = REST
        self._since_ns: int | None = None
        self._waiting: Any = None
        self._is_open = False
        self._said: set[str] = set()

    def listen(self, topic: str, *, stamped_first: bool = False) -> None:
        """Take commands from a topic; the type of the original is announced."""
        types = _BOTH[::-1] if stamped_first else _BOTH
        self._ports.subscription(topic, types, self.take)

    @property
    def since_ns(self) -> int:
        """From when the newest command counts, −1 before any."""
        return -1 if self._since_ns is None else self._since_ns

    def open(self, time_ns: int) -> None:
        """Take commands from now on; what came before is forgotten."""
        self._now_ns, self._is_open = time_ns, True
        self._twist, self._since_ns, self._waiting = REST, None, None
        self._said.clear()

    def close(self) -> None:
        """Take no more commands."""
        self._is_open = False

    def take(self, message: Any) -> None:
        """Hear a message."""
        if not self._is_open:
            self._say("warn", "Can't accept new commands. Controller is not running.")
            return
        twist = getattr(message, "twist", message)
        values = (twist.linear.x, twist.linear.y, twist.angular.z)
        if not all(map(math.isfinite, values)):
            self._say("warn", "Received NaN in velocity command. Ignoring.")
            return
        self._waiting = (PlanarTwist(*map(float, values)), self._stamp_ns(message))

    def current(self, time_ns: int) -> PlanarTwist | None:
        """Return the command that holds at an update, None when none does (any more)."""
        self._now_ns = time_ns
        if self._waiting is not None:
            twist, stamp_ns = self._waiting
            self._waiting = None
            self._accept(twist, stamp_ns, time_ns)
        if self._since_ns is None:
            return None
        if self.timeout_s == 0:
            twist = self._twist
            if not self._endless:
                self._since_ns = None
            return twist
        return self._twist if time_ns - self._since_ns <= self._timeout_ns() else None

    def _accept(self, twist: PlanarTwist, stamp_ns: int, time_ns: int) -> None:
        since_ns = stamp_ns or time_ns
        if since_ns > time_ns + self._timeout_ns():
            text = f"a command's stamp is {(since_ns - time_ns) * 1e-9:.3f} s ahead of simulated "
            self._say("warn", text + "time; its arrival counts (set use_sim_time in its sender)")
            since_ns = time_ns
        elif self.timeout_s and time_ns - since_ns > self._timeout_ns():
            text = f"Ignoring the received message because it is {(time_ns - since_ns) * 1e-9:.3f}"
            self._say("warn", text + f" s old, more than the allowed timeout ({self.timeout_s:g})")
            return
        self._twist, self._since_ns = twist, since_ns

    def _stamp_ns(self, message: Any) -> int:
        header = getattr(message, "header", None)
        if header is None or not self._uses_stamps:
            return 0
        return ns_of(header.stamp)

    def _timeout_ns(self) -> int:
        return round(self.timeout_s * 1e9)

    def _say(self, level: str, text: str) -> None:
        # Once per run and reason; a stream of commands would fill the console.
        reason = text.split(" ", 3)[0:3]
        if " ".join(reason) not in self._said:
            self._said.add(" ".join(reason))
            self._ports.log(level, text)
