"""Times that a user's controller is given: ROS 1's, that are numbers of seconds too."""

from __future__ import annotations

from gazelle.interfaces import Duration, Time

__all__ = ["ControlPeriod", "ControlTime"]

_NS = 1_000_000_000


class ControlTime(Time):
    """A moment of simulated time: ``to_sec()``, ``secs``, ``nsecs``, ``float()``."""

    __slots__ = ()

    @classmethod
    def of(cls, time_ns: int) -> ControlTime:
        """Return the time of so many nanoseconds."""
        return cls(*divmod(time_ns, _NS))

    def __float__(self) -> float:
        return self.to_sec()


class ControlPeriod(Duration):
    """The time since the last update: ``to_sec()``, ``secs``, ``nsecs``, ``float()``."""

    __slots__ = ()

    @classmethod
    def of(cls, period_ns: int) -> ControlPeriod:
        """Return the period of so many nanoseconds."""
        return cls(*divmod(period_ns, _NS))

    def __float__(self) -> float:
        return self.to_sec()
