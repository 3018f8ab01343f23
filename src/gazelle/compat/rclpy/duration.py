"""Lengths of time (rclpy.duration)."""

from __future__ import annotations

from functools import total_ordering
from typing import Any

from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import ns_of, set_stamp

__all__ = ["Duration", "DurationType", "Infinite"]

S_TO_NS = 1_000_000_000
_MAX_NS = 2**63


@total_ordering
class Duration:
    """A length of time in nanoseconds."""

    def __init__(self, *, seconds: float = 0, nanoseconds: float = 0) -> None:
        total = int(seconds * S_TO_NS) + int(nanoseconds)
        if not -_MAX_NS <= total < _MAX_NS:
            raise OverflowError("Total nanoseconds value is too large to store in C duration.")
        self._nanoseconds = total

    @property
    def nanoseconds(self) -> int:
        """The whole length in nanoseconds."""
        return self._nanoseconds

    def to_msg(self) -> Any:
        """Return ``builtin_interfaces/msg/Duration``."""
        message = message_type("builtin_interfaces/msg/Duration")()
        set_stamp(message, self._nanoseconds)
        return message

    @classmethod
    def from_msg(cls, msg: Any) -> Duration:
        """Return the duration of a message."""
        return cls(nanoseconds=ns_of(msg))

    def __repr__(self) -> str:
        return f"Duration(nanoseconds={self._nanoseconds})"

    def __str__(self) -> str:
        return "Infinite" if self == Infinite else f"{self._nanoseconds} nanoseconds"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Duration) and self._nanoseconds == other.nanoseconds

    def __lt__(self, other: object) -> bool:
        if not isinstance(other, Duration):
            return NotImplemented
        return self._nanoseconds < other.nanoseconds

    def __hash__(self) -> int:
        return hash(self._nanoseconds)

    def __add__(self, other: object) -> Duration:
        if not isinstance(other, Duration):
            return NotImplemented
        return Duration(nanoseconds=self._nanoseconds + other.nanoseconds)

    def __sub__(self, other: object) -> Duration:
        if not isinstance(other, Duration):
            return NotImplemented
        return Duration(nanoseconds=self._nanoseconds - other.nanoseconds)

    def __mul__(self, factor: float) -> Duration:
        return Duration(nanoseconds=self._nanoseconds * factor)

    __rmul__ = __mul__

    def __truediv__(self, divisor: float) -> Duration:
        return Duration(nanoseconds=self._nanoseconds / divisor)

    def __neg__(self) -> Duration:
        return Duration(nanoseconds=-self._nanoseconds)


Infinite = Duration(nanoseconds=_MAX_NS - 1)
DurationType = Duration
