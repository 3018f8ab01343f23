"""Limits of velocity, acceleration and jerk of a command."""

from __future__ import annotations

import math
from typing import NamedTuple

from gazelle.control.errors import ControllerError
from gazelle.parameters.reader import ParameterReader

__all__ = [
    "AccelerationLimits",
    "SpeedLimiter",
    "SpeedLimits",
    "TractionLimiter",
    "TractionLimits",
    "read_limits",
]


class AccelerationLimits(NamedTuple):
    """Bounds of acceleration, m/s² or rad/s².

    Attributes:
        accelerate: while the value is positive or 0 and grows, ≥ 0.
        brake: while it is positive and falls, ≤ 0.
        accelerate_reverse: while it is negative or 0 and falls, ≤ 0.
        brake_reverse: while it is negative and grows, ≥ 0.
    """

    accelerate: float
    brake: float
    accelerate_reverse: float
    brake_reverse: float


class SpeedLimits(NamedTuple):
    """What bounds a commanded speed; None for no bound.

    Attributes:
        velocity: lowest and highest.
        acceleration: see there.
        jerk: lowest and highest, m/s³ or rad/s³.
        ros1_jerk: the rule of ros_controllers and of ros2_controllers up to Humble: acceleration
            may change by ``2·jerk·dt`` a period, whatever its direction. Else control_toolbox's
            ``RateLimiter``: by ``jerk·dt``, and only while the change goes on in its direction.
    """

    velocity: tuple[float, float] | None = None
    acceleration: AccelerationLimits | None = None
    jerk: tuple[float, float] | None = None
    ros1_jerk: bool = False


class SpeedLimiter:
    """Limits one component of a velocity command and remembers what it let through."""

    def __init__(self, limits: SpeedLimits) -> None:
        self.limits = limits
        self._last = self._before = 0.0

    def reset(self) -> None:
        """Start from rest."""
        self._last = self._before = 0.0

    def limit(self, speed: float, period_s: float) -> float:
        """Return the speed that may be commanded now; jerk first, velocity last."""
        speed = self._by_jerk(speed, period_s)
        speed = self._by_acceleration(speed, period_s)
        if self.limits.velocity is not None:
            speed = _clamp(speed, *self.limits.velocity)
        self._before, self._last = self._last, speed
        return speed

    def _by_jerk(self, speed: float, period_s: float) -> float:
        if self.limits.jerk is None:
            return speed
        change, previous = speed - self._last, self._last - self._before
        scale = period_s * period_s
        if self.limits.ros1_jerk:
            scale *= 2
        elif (change - previous) * change <= 0:
            return speed
        lowest, highest = self.limits.jerk
        bend = _clamp(change - previous, lowest * scale, highest * scale)
        return self._last + previous + bend

    def _by_acceleration(self, speed: float, period_s: float) -> float:
        bounds = self.limits.acceleration
        if bounds is None:
            return speed
        lowest = bounds.brake if self._last > 0 else bounds.accelerate_reverse
        highest = bounds.brake_reverse if self._last < 0 else bounds.accelerate
        return self._last + _clamp(speed - self._last, lowest * period_s, highest * period_s)


class TractionLimits(NamedTuple):
    """Least and most of a magnitude, the same in both directions; None for no bound.

    Attributes:
        value: of the value.
        increase, decrease: of its rate while its magnitude grows and falls.
        bend: of the rate of its rate.
        between: lowest and highest value, with their signs.
    """

    value: tuple[float, float] | None = None
    increase: tuple[float, float] | None = None
    decrease: tuple[float, float] | None = None
    bend: tuple[float, float] | None = None
    between: tuple[float, float] | None = None


class TractionLimiter:
    """Limits a wheel's speed or a steering angle as tricycle_controller does."""

    def __init__(self, limits: TractionLimits) -> None:
        self.limits = limits
        self._last = self._before = 0.0

    def reset(self) -> None:
        """Start from 0."""
        self._last = self._before = 0.0

    def limit(self, value: float, period_s: float) -> float:
        """Return the value that may be commanded now."""
        limits, last = self.limits, self._last
        if limits.bend is not None:
            previous = last - self._before
            scale = 2 * period_s * period_s
            value = last + previous + _magnitude(value - last - previous, limits.bend, scale)
        rate = limits.increase if abs(value) >= abs(last) else limits.decrease
        if rate is not None:
            value = last + _magnitude(value - last, rate, period_s)
        if limits.value is not None:
            value = _magnitude(value, limits.value, 1.0)
        if limits.between is not None:
            value = _clamp(value, *limits.between)
        self._before, self._last = last, value
        return value


def _magnitude(value: float, bounds: tuple[float, float], scale: float) -> float:
    size = _clamp(abs(value), bounds[0] * scale, bounds[1] * scale)
    return size if value >= 0 else -size


def _clamp(value: float, lowest: float, highest: float) -> float:
    return min(max(value, lowest), highest)


def read_limits(parameters: ParameterReader, axis: str, ros_version: int) -> SpeedLimits:
    """Read the limits of an axis such as ``linear.x``.

    ROS 1 wants ``has_…_limits: true`` and takes 0 for a limit that is then missing; ROS 2 takes
    every limit that is given and not NaN, unless ``has_…_limits`` is false. Up to Humble it had
    to be true: files of that time have limits of 0 that were never meant, which are left out.

    Raises:
        ControllerError: a lower limit is above its upper one.
    """
    reader = _Reader(parameters, axis, ros_version)
    velocity = reader.pair("velocity")
    jerk = reader.pair("jerk")
    return SpeedLimits(velocity, reader.acceleration(), jerk, ros1_jerk=ros_version == 1)


class _Reader:
    def __init__(self, parameters: ParameterReader, axis: str, ros_version: int) -> None:
        self.parameters = parameters
        self.axis = axis
        self.ros_version = ros_version

    def pair(self, word: str) -> tuple[float, float] | None:
        """Return lowest and highest of a quantity, None for no limits."""
        if not self.acts(word):
            return None
        highest = self.number(f"max_{word}", 0.0)
        lowest = self.number(f"min_{word}", -highest)
        if lowest > highest:
            self.contradict(f"min_{word}", lowest, f"max_{word}", highest)
        return lowest, highest

    def acceleration(self) -> AccelerationLimits | None:
        pair = self.pair("acceleration")
        if pair is None:
            return None
        lowest, accelerate = pair
        reverse = self.number("max_acceleration_reverse", lowest)
        brake = self.number("max_deceleration", lowest)
        brake_reverse = self.number("max_deceleration_reverse", accelerate)
        if brake > 0:
            self.contradict("max_deceleration", brake, "0, the speed's direction", 0.0)
        return AccelerationLimits(accelerate, brake, reverse, brake_reverse)

    def acts(self, word: str) -> bool:
        key = f"{self.axis}.has_{word}_limits"
        given = not math.isnan(self.number(f"max_{word}", math.nan))
        flag = self.parameters.flag(key) if self.parameters.has(key) else self.ros_version == 2
        if flag and not given and self.parameters.has(key):
            self.report_missing(word)
        if flag and given and not self.parameters.has(key) and self.is_nothing(word):
            self.report_nothing(word)
            return False
        return flag and (given or self.ros_version == 1)

    def is_nothing(self, word: str) -> bool:
        """Tell whether a limit lets through nothing at all."""
        return self.number(f"max_{word}", 0.0) == 0 and self.number(f"min_{word}", 0.0) == 0

    def report_missing(self, word: str) -> None:
        outcome = "0 is used and the robot stands still" if self.ros_version == 1 else "none acts"
        text = f"{self.axis}.has_{word}_limits is true without {self.axis}.max_{word}: {outcome}"
        self.parameters.report(
            "control.limit-without-value",
            text,
            key=f"{self.axis}.has_{word}_limits",
            fix=f"give {self.axis}.max_{word}",
        )

    def report_nothing(self, word: str) -> None:
        key = f"{self.axis}.max_{word}"
        text = f"{key} is 0 without {self.axis}.has_{word}_limits: no limit, as up to Humble;"
        text += " from Jazzy on the robot would stand still"
        fix = f"write .NAN for no limit, or {self.axis}.has_{word}_limits: true to stand still"
        self.parameters.report("control.limit-of-nothing", text, key=key, fix=fix)

    def number(self, word: str, default: float) -> float:
        value = self.parameters.number(f"{self.axis}.{word}", default)
        return default if math.isnan(value) else value

    def contradict(self, low: str, lowest: float, high: str, highest: float) -> None:
        text = f"controller '{self.parameters.name}': {self.axis}.{low} {lowest:g} is above "
        raise ControllerError(f"{text}{high} {highest:g} (Invalid value limits)")
