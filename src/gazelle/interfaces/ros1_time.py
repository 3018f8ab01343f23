"""The ``time`` and ``duration`` values of ROS 1, as its Python nodes know them.

Whole seconds and nanoseconds, kept with nanoseconds in [0, 1e9); a negative duration has
negative seconds. Behaviour follows http://wiki.ros.org/rospy/Overview/Time.
"""

from __future__ import annotations

import numbers
from typing import Any, TypeVar

__all__ = ["Duration", "TVal", "Time"]

_NANO = 1_000_000_000
_T = TypeVar("_T", bound="TVal")


def _is_whole(value: object) -> bool:
    """Whether a number is an integer, numpy's too."""
    return isinstance(value, numbers.Integral)


class TVal:
    """A number of seconds and nanoseconds; base of `Time` and `Duration`.

    Args:
        secs: seconds; a float is split into seconds and nanoseconds.
        nsecs: nanoseconds, any whole number.

    Raises:
        ValueError: `secs` is a float and `nsecs` is given too.
    """

    __slots__ = ("nsecs", "secs")
    _slot_types = ("int32", "int32")
    _fields = ("secs", "nsecs")

    secs: int
    nsecs: int

    def __init__(self, secs: float = 0, nsecs: float = 0) -> None:
        if _is_whole(secs):
            whole, nano = int(secs), int(nsecs)
        else:
            if nsecs != 0:
                raise ValueError("if secs is a float, nsecs cannot be set")
            whole = int(secs)
            nano = int((secs - whole) * _NANO)
        self.secs = whole + nano // _NANO
        self.nsecs = nano % _NANO

    @classmethod
    def from_sec(cls: type[_T], float_secs: float) -> _T:
        """Return the value of so many seconds, cut to whole nanoseconds."""
        whole = int(float_secs)
        return cls(whole, int((float_secs - whole) * _NANO))

    def set(self, secs: int, nsecs: int) -> None:
        """Set both parts as they are; see `canon`."""
        self.secs = secs
        self.nsecs = nsecs

    def canon(self) -> None:
        """Bring nanoseconds back into [0, 1e9)."""
        total = self.secs * _NANO + self.nsecs
        self.secs, self.nsecs = divmod(total, _NANO)

    def is_zero(self) -> bool:
        """Return whether both parts are zero."""
        return self.secs == 0 and self.nsecs == 0

    def to_sec(self) -> float:
        """Return seconds as a float."""
        return self.secs + self.nsecs / 1e9

    def to_nsec(self) -> int:
        """Return nanoseconds, exactly."""
        return self.secs * _NANO + self.nsecs

    def __hash__(self) -> int:
        return hash((self.secs, self.nsecs))

    def __str__(self) -> str:
        return str(self.to_nsec())

    def __repr__(self) -> str:
        return f"genpy.{type(self).__name__}[{self.to_nsec()}]"

    def __bool__(self) -> bool:
        return not self.is_zero()

    def __getstate__(self) -> list[int]:
        return [self.secs, self.nsecs]

    def __setstate__(self, state: list[int]) -> None:
        self.secs, self.nsecs = state

    def _comparable(self, other: object) -> bool:
        return isinstance(other, TVal)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, TVal) or not self._comparable(other):
            return False
        return self.to_nsec() == other.to_nsec()

    def __lt__(self, other: Any) -> bool:
        return self.to_nsec() < other.to_nsec() if self._comparable(other) else NotImplemented

    def __le__(self, other: Any) -> bool:
        return self.to_nsec() <= other.to_nsec() if self._comparable(other) else NotImplemented

    def __gt__(self, other: Any) -> bool:
        return self.to_nsec() > other.to_nsec() if self._comparable(other) else NotImplemented

    def __ge__(self, other: Any) -> bool:
        return self.to_nsec() >= other.to_nsec() if self._comparable(other) else NotImplemented


class Time(TVal):
    """A point in time since the epoch (or since the start of the simulation).

    Raises:
        TypeError: the value would be negative.
    """

    __slots__ = ()

    def __init__(self, secs: float = 0, nsecs: float = 0) -> None:
        super().__init__(secs, nsecs)
        if self.secs < 0:
            raise TypeError("time values must be positive")

    def to_time(self) -> float:
        """Return seconds as a float, like ``time.time()``."""
        return self.to_sec()

    def _comparable(self, other: object) -> bool:
        return isinstance(other, Time)

    def __add__(self, other: Any) -> Any:
        if not isinstance(other, Duration):
            return NotImplemented
        return type(self)(self.secs + other.secs, self.nsecs + other.nsecs)

    __radd__ = __add__

    def __sub__(self, other: Any) -> Any:
        if isinstance(other, Time):
            return Duration(self.secs - other.secs, self.nsecs - other.nsecs)
        if isinstance(other, Duration):
            return type(self)(self.secs - other.secs, self.nsecs - other.nsecs)
        return NotImplemented


class Duration(TVal):
    """A span of time; may be negative."""

    __slots__ = ()

    def _comparable(self, other: object) -> bool:
        return isinstance(other, Duration)

    def __neg__(self) -> Duration:
        return type(self)(-self.secs, -self.nsecs)

    def __abs__(self) -> Duration:
        return self if self.secs >= 0 else -self

    def __add__(self, other: Any) -> Any:
        if not isinstance(other, Duration):
            return NotImplemented
        return type(self)(self.secs + other.secs, self.nsecs + other.nsecs)

    __radd__ = __add__

    def __sub__(self, other: Any) -> Any:
        if not isinstance(other, Duration):
            return NotImplemented
        return type(self)(self.secs - other.secs, self.nsecs - other.nsecs)

    def __mul__(self, factor: Any) -> Any:
        if isinstance(factor, numbers.Integral):
            return type(self)(self.secs * int(factor), self.nsecs * int(factor))
        if isinstance(factor, numbers.Real):
            return type(self).from_sec(self.to_sec() * float(factor))
        return NotImplemented

    __rmul__ = __mul__

    def __floordiv__(self, divisor: Any) -> Any:
        if isinstance(divisor, Duration):
            return self.to_nsec() // divisor.to_nsec()
        if isinstance(divisor, numbers.Integral):
            return type(self)(0, self.to_nsec() // int(divisor))
        if isinstance(divisor, numbers.Real):
            return type(self).from_sec(self.to_sec() // float(divisor))
        return NotImplemented

    def __truediv__(self, divisor: Any) -> Any:
        if isinstance(divisor, Duration):
            return self.to_sec() / divisor.to_sec()
        if isinstance(divisor, numbers.Real):
            return type(self).from_sec(self.to_sec() / float(divisor))
        return NotImplemented

    def __mod__(self, divisor: Any) -> Any:
        if isinstance(divisor, Duration):
            return type(self)(0, self.to_nsec() % divisor.to_nsec())
        if isinstance(divisor, numbers.Real):
            return type(self).from_sec(self.to_sec() % float(divisor))
        return NotImplemented

    def __divmod__(self, divisor: Any) -> Any:
        return self // divisor, self % divisor
