"""What zones around a robot make of a velocity command (nav2_collision_monitor)."""

from __future__ import annotations

import enum
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.frontiers import are_inside

__all__ = ["Action", "Points", "Polygon", "SubPolygon", "Velocity", "Verdict", "guarded"]

Points = NDArray[np.float64]
"""x, y in the robot's frame, m; shape (n, 2)."""
Velocity = tuple[float, float, float]
"""Along x and y (m/s), around z (rad/s)."""

_STAND: Velocity = (0.0, 0.0, 0.0)


class Action(enum.Enum):
    """What a zone does; numbers of ``nav2_msgs/CollisionMonitorState``."""

    NONE = 0
    STOP = 1
    SLOWDOWN = 2
    APPROACH = 3
    LIMIT = 4


class SubPolygon(NamedTuple):
    """A range of commands and the outline that counts for them (``sub_polygon``).

    Attributes:
        outline: corners.
        linear: least and most of the speed: along x with its sign, or of its amount where the
            robot is `holonomic`.
        turn: least and most angular velocity, rad/s.
        direction: begin and end of the directions of travel, rad; only where it is holonomic.
        is_holonomic: how `linear` is meant.
    """

    outline: Points
    linear: tuple[float, float]
    turn: tuple[float, float]
    direction: tuple[float, float] = (-math.pi, math.pi)
    is_holonomic: bool = False

    def holds(self, command: Velocity) -> bool:
        """Tell whether a command is in the range."""
        x, y, turn = command
        speed = math.hypot(x, y) if self.is_holonomic else x
        if not self.linear[0] <= speed <= self.linear[1]:
            return False
        if not self.turn[0] <= turn <= self.turn[1]:
            return False
        if not self.is_holonomic:
            return True
        begin, end = self.direction
        angle = math.atan2(y, x)
        return begin <= angle <= end if begin <= end else angle >= begin or angle <= end


@dataclass(slots=True)
class Polygon:
    """An area around the robot and what happens when something is in it.

    Attributes:
        name: of the parameters.
        action: what happens.
        radius_m: of a circle; None for a polygon.
        outline: corners of a polygon; None until it is known.
        sub_polygons: outlines by command, see `SubPolygon`.
        least: so many points in it count as something.
        ratio: of the speed that is left, of `Action.SLOWDOWN`.
        limits: speed (m/s) and turn (rad/s) that are left, of `Action.LIMIT`.
        horizon_s, step_s: how far ahead `Action.APPROACH` looks, and how finely.
        sources: names of sensors that count; empty for all.
        enabled: whether it counts.
    """

    name: str
    action: Action
    radius_m: float | None = None
    outline: Points | None = None
    sub_polygons: tuple[SubPolygon, ...] = ()
    least: int = 4
    ratio: float = 0.5
    limits: tuple[float, float] = (0.5, 0.5)
    horizon_s: float = 2.0
    step_s: float = 0.1
    sources: tuple[str, ...] = ()
    enabled: bool = True

    def choose(self, command: Velocity) -> None:
        """Take the outline that belongs to a command; without one the last stays."""
        found = next(
            (sub_polygon for sub_polygon in self.sub_polygons if sub_polygon.holds(command)),
            None,
        )
        if found is not None:
            self.outline = found.outline

    def count(self, points: Points) -> int:
        """Return how many points are inside."""
        if self.radius_m is not None:
            return int((np.hypot(points[:, 0], points[:, 1]) < self.radius_m).sum())
        return 0 if self.outline is None else int(are_inside(points, self.outline).sum())

    def corners(self) -> Points:
        """Return the outline to show; a circle as 16 corners."""
        if self.radius_m is not None:
            angles = np.arange(16) * math.tau / 16
            return self.radius_m * np.column_stack([np.cos(angles), np.sin(angles)])
        return np.empty((0, 2)) if self.outline is None else self.outline

    def reach_m(self) -> float:
        """Return how far from the robot's origin the zone goes."""
        if self.radius_m is not None:
            return self.radius_m
        return 0.0 if self.outline is None else float(np.hypot(*self.outline.T).max())

    def collision_s(self, points: Points, command: Velocity) -> float | None:
        """Return when the robot meets something if it goes on so, None for not in time."""
        way = math.hypot(command[0], command[1]) * self.horizon_s
        near = points[np.hypot(points[:, 0], points[:, 1]) <= self.reach_m() + way]
        if len(near) < self.least:
            return None
        steps = int(self.horizon_s / self.step_s + 1e-9)
        x = y = yaw = 0.0
        for number in range(steps + 1):
            c, s = math.cos(yaw), math.sin(yaw)
            away = near - (x, y)
            # The points as the robot sees them from there.
            seen = np.column_stack([away @ (c, s), away @ (-s, c)])
            if self.count(seen) >= self.least:
                return number * self.step_s
            x += (command[0] * c - command[1] * s) * self.step_s
            y += (command[0] * s + command[1] * c) * self.step_s
            yaw += command[2] * self.step_s
        return None


class Verdict(NamedTuple):
    """What is left of a command.

    Attributes:
        velocity: to send.
        action: why it is that.
        polygon: whose action that is, empty without one.
    """

    velocity: Velocity
    action: Action
    polygon: str


def guarded(command: Velocity, polygons: Sequence[Polygon], seen: Mapping[str, Points]) -> Verdict:
    """Return what zones leave of a command: the slowest of what each of them leaves.

    Args:
        command: what was asked for.
        polygons: in the order of the parameters; the first that stops is the last one looked at.
        seen: points by the names of sensors.
    """
    verdict = Verdict(command, Action.NONE, "")
    for polygon in polygons:
        if not polygon.enabled or polygon.action is Action.NONE:
            continue
        polygon.choose(command)
        named = [
            points
            for name, points in seen.items()
            if not polygon.sources or name in polygon.sources
        ]
        points = np.concatenate(named) if named else np.empty((0, 2))
        share = _share(polygon, points, command)
        if share is None:
            continue
        left = (command[0] * share, command[1] * share, command[2] * share)
        if polygon.action is Action.STOP:
            return Verdict(_STAND, Action.STOP, polygon.name)
        if _amount(left) < _amount(verdict.velocity):
            verdict = Verdict(left, polygon.action, polygon.name)
    return verdict


def _share(polygon: Polygon, points: Points, command: Velocity) -> float | None:
    """Return which share of a command a zone leaves, None when nothing is in it."""
    if polygon.action is Action.APPROACH:
        time_s = polygon.collision_s(points, command)
        return None if time_s is None else time_s / polygon.horizon_s
    if polygon.count(points) < polygon.least:
        return None
    if polygon.action is Action.STOP:
        return 0.0
    if polygon.action is Action.SLOWDOWN:
        return polygon.ratio
    speeds = (math.hypot(command[0], command[1]), abs(command[2]))
    shares = [limit / v for limit, v in zip(polygon.limits, speeds, strict=True) if v > 0]
    return min([1.0, *shares])


def _amount(velocity: Velocity) -> float:
    return sum(value * value for value in velocity)
