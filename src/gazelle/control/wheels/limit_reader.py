"""Reads speed limits in the words of ROS 1 and ROS 2."""

from __future__ import annotations

import math

from gazelle.control.errors import ControllerError
from gazelle.control.wheels.limiter import AccelerationLimits, SpeedLimits
from gazelle.parameters.reader import ParameterReader

__all__ = ["read_limits"]


def read_limits(parameters: ParameterReader, axis: str, generation: int) -> SpeedLimits:
    """Read the limits of an axis such as ``linear.x``.

    ROS 1 wants ``has_…_limits: true`` and takes 0 for a limit that is then missing; ROS 2 takes
    every limit that is given and not NaN, unless ``has_…_limits`` is false. Up to Humble it had
    to be true: files of that time have limits of 0 that were never meant, which are left out.

    Raises:
        ControllerError: a lower limit is above its upper one.
    """
    reader = _Reader(parameters, axis, generation)
    velocity = reader.pair("velocity")
    jerk = reader.pair("jerk")
    return SpeedLimits(velocity, reader.acceleration(), jerk, ros1_jerk=generation == 1)


class _Reader:
    def __init__(self, parameters: ParameterReader, axis: str, generation: int) -> None:
        self.parameters = parameters
        self.axis = axis
        self.generation = generation

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
        flag = self.parameters.flag(key) if self.parameters.has(key) else self.generation == 2
        if flag and not given and self.parameters.has(key):
            self.report_missing(word)
        if flag and given and not self.parameters.has(key) and self.is_nothing(word):
            self.report_nothing(word)
            return False
        return flag and (given or self.generation == 1)

    def is_nothing(self, word: str) -> bool:
        """Tell whether a limit lets through nothing at all."""
        return self.number(f"max_{word}", 0.0) == 0 and self.number(f"min_{word}", 0.0) == 0

    def report_missing(self, word: str) -> None:
        outcome = "0 is used and the robot stands still" if self.generation == 1 else "none acts"
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
