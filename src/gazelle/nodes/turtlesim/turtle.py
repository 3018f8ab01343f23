"""How a turtle moves: velocities, walls, teleports, turning to a heading.

Facts are those of turtlesim (``turtlesim/src/turtle.cpp`` of ros_tutorials, noetic and rolling).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

__all__ = [
    "METER_PX",
    "PERIOD_S",
    "SIZE_PX",
    "WORLD_M",
    "Pen",
    "Stroke",
    "Teleport",
    "Turtle",
    "normalized",
    "single",
]

SIZE_PX = 500
# Height of the original's first turtle picture.
METER_PX = 45.0
PERIOD_S = 0.016
# A turtle may hold a command for so long before it stops.
_TIMEOUT_S = 1.0
_TURN_SPEED_RAD_S = 1.0
_TURN_TOLERANCE_RAD = 0.02


def single(value: float) -> float:
    """Return a number as the original's single precision has it."""
    return float(np.float32(value))


WORLD_M = single((SIZE_PX - 1) / METER_PX)


def normalized(angle_rad: float) -> float:
    """Return an angle from -π up to but without π."""
    return angle_rad - 2 * math.pi * math.floor((angle_rad + math.pi) / (2 * math.pi))


@dataclass(frozen=True, slots=True)
class Pen:
    """What a turtle draws with.

    Attributes:
        color: red, green and blue, 0 to 255.
        width_px: of a line.
        is_on: whether it draws.
    """

    color: tuple[int, int, int] = (0xB3, 0xB8, 0xFF)
    width_px: int = 3
    is_on: bool = True


@dataclass(frozen=True, slots=True)
class Stroke:
    """A line in pixels, x to the right and y downwards."""

    start_px: tuple[float, float]
    end_px: tuple[float, float]
    pen: Pen


@dataclass(frozen=True, slots=True)
class Teleport:
    """A jump that the next step makes.

    Attributes:
        x_m, y_m, theta_rad: where to, or how far it turns, in the world.
        linear_m: how far ahead, for a relative one.
        is_relative: turn by `theta_rad`, then go ahead.
    """

    theta_rad: float
    x_m: float = 0.0
    y_m: float = 0.0
    linear_m: float = 0.0
    is_relative: bool = False


@dataclass(slots=True)
class Turtle:
    """One turtle.

    Attributes:
        x_m: to the right.
        down_m: from the upper edge; the original counts so, and its warnings show it.
        theta_rad: heading, anticlockwise.
        pen: what it draws with.
        linear_x_m_s, linear_y_m_s, angular_rad_s: velocities it has now.
    """

    x_m: float
    down_m: float
    theta_rad: float
    pen: Pen = field(default_factory=Pen)
    linear_x_m_s: float = 0.0
    linear_y_m_s: float = 0.0
    angular_rad_s: float = 0.0
    _commanded_for_s: float = field(default=math.inf, init=False)
    _teleports: list[Teleport] = field(default_factory=list, init=False)

    @classmethod
    def at(cls, x_m: float, y_m: float, theta_rad: float) -> Turtle:
        """Return a turtle at a place of the world, y upwards."""
        return cls(x_m, single(WORLD_M - y_m), theta_rad)

    @property
    def y_m(self) -> float:
        """Height above the lower edge."""
        return WORLD_M - self.down_m

    @property
    def place_px(self) -> tuple[float, float]:
        """Where it is in the picture."""
        return self.x_m * METER_PX, self.down_m * METER_PX

    def command(self, x_m_s: float, y_m_s: float, angular_rad_s: float) -> None:
        """Go on with these velocities for a second, of steps: a slow machine cuts nothing off."""
        self.linear_x_m_s, self.linear_y_m_s = x_m_s, y_m_s
        self.angular_rad_s = angular_rad_s
        self._commanded_for_s = 0.0

    def teleport(self, request: Teleport) -> None:
        """Jump at the next step."""
        self._teleports.append(request)

    def turn_towards(self, theta_rad: float) -> tuple[float, bool]:
        """Turn towards a heading for one step; return what remains and whether it is reached."""
        remaining = normalized(normalized(theta_rad) - single(self.theta_rad))
        if abs(remaining) < _TURN_TOLERANCE_RAD:
            self.halt()
            return remaining, True
        speed = -_TURN_SPEED_RAD_S if remaining < 0 else _TURN_SPEED_RAD_S
        self.command(0.0, 0.0, speed)
        return remaining, False

    def halt(self) -> None:
        """Stand still."""
        self.linear_x_m_s = self.linear_y_m_s = self.angular_rad_s = 0.0

    def jump(self) -> list[Stroke]:
        """Make the jumps that were asked for; return what the pen draws by them."""
        strokes = []
        for request in self._teleports:
            before = self.place_px
            if request.is_relative:
                self.theta_rad += request.theta_rad
                self.x_m += math.cos(self.theta_rad) * request.linear_m
                self.down_m -= math.sin(self.theta_rad) * request.linear_m
            else:
                self.x_m = request.x_m
                self.down_m = max(0.0, WORLD_M - request.y_m)
                self.theta_rad = request.theta_rad
            strokes.append(Stroke(before, self.place_px, self.pen))
        self._teleports.clear()
        return [stroke for stroke in strokes if stroke.pen.is_on]

    def move(self) -> tuple[list[Stroke], tuple[float, float] | None]:
        """Go on by one period.

        Returns:
            What the pen draws, and where the turtle would be beyond a wall (x to the right and
            y downwards, metres), None when it is not.
        """
        if self._commanded_for_s > _TIMEOUT_S:
            self.halt()
        self._commanded_for_s += PERIOD_S
        before = self.place_px
        self.theta_rad = normalized(self.theta_rad + self.angular_rad_s * PERIOD_S)
        cos, sin = math.cos(self.theta_rad), math.sin(self.theta_rad)
        self.x_m += (cos * self.linear_x_m_s - sin * self.linear_y_m_s) * PERIOD_S
        self.down_m -= (cos * self.linear_y_m_s + sin * self.linear_x_m_s) * PERIOD_S
        wanted = (self.x_m, self.down_m)
        self.x_m = min(max(self.x_m, 0.0), WORLD_M)
        self.down_m = min(max(self.down_m, 0.0), WORLD_M)
        hit = None if wanted == (self.x_m, self.down_m) else wanted
        after = self.place_px
        draws = self.pen.is_on and after != before
        return [Stroke(before, after, self.pen)] if draws else [], hit
