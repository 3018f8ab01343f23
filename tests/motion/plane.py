"""Robots in the plane, whose collisions are known exactly."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from gazelle.motion.joint_space import FloatArray, JointSpace

Circle = tuple[float, float, float]


def space_of(size: int, *, reach: float = math.pi, continuous: bool = False) -> JointSpace:
    """Joints that go from -reach to reach at 1 rad/s and 1 rad/s²."""
    return JointSpace(
        names=tuple(f"joint_{i + 1}" for i in range(size)),
        lower=np.full(size, -reach),
        upper=np.full(size, reach),
        continuous=np.full(size, continuous),
        velocity=np.ones(size),
        acceleration=np.ones(size),
        jerk=np.full(size, np.inf),
    )


@dataclass
class Stepwise:
    """A motion is checked state by state; counts the checks."""

    checks: int = field(default=0, init=False)

    def clearance(self, q: FloatArray) -> tuple[float, str]:
        raise NotImplementedError

    def is_valid(self, q: FloatArray) -> bool:
        self.checks += 1
        return self.clearance(q)[0] > 0.0

    def motion_is_valid(self, q0: FloatArray, q1: FloatArray, step: float) -> bool:
        count = max(1, math.ceil(float(np.linalg.norm(q1 - q0)) / step))
        order = sorted(range(count, 0, -1), key=lambda k: (k != count, k % 2 == 0))
        return all(self.is_valid(q0 + (q1 - q0) * (k / count)) for k in order)

    def why(self, q: FloatArray) -> str:
        distance, name = self.clearance(q)
        return "" if distance > 0.0 else f"the robot collides with {name}"


@dataclass
class Map2D(Stepwise):
    """A point among circles; turns wrap where the space's joints are continuous."""

    circles: tuple[Circle, ...]
    wraps: bool = False

    def clearance(self, q: FloatArray) -> tuple[float, str]:
        best = (math.inf, "")
        for number, (x, y, radius) in enumerate(self.circles):
            dx, dy = q[0] - x, q[1] - y
            if self.wraps:
                dx = (dx + math.pi) % math.tau - math.pi
                dy = (dy + math.pi) % math.tau - math.pi
            best = min(best, (math.hypot(dx, dy) - radius, f"circle {number}"))
        return best


@dataclass
class PlanarArm(Stepwise):
    """Links of equal length from the origin, in a plane with circles."""

    circles: tuple[Circle, ...]
    links: int = 3
    length_m: float = 0.4

    def corners(self, q: FloatArray) -> FloatArray:
        angles = np.cumsum(q)
        steps = self.length_m * np.column_stack([np.cos(angles), np.sin(angles)])
        return np.vstack([np.zeros(2), np.cumsum(steps, axis=0)])

    def clearance(self, q: FloatArray) -> tuple[float, str]:
        corners = self.corners(q)
        best = (math.inf, "")
        for number, (x, y, radius) in enumerate(self.circles):
            for first, last in pairwise(corners):
                way, to = last - first, np.array([x, y]) - first
                part = min(1.0, max(0.0, float(to @ way) / float(way @ way)))
                distance = float(np.linalg.norm(to - part * way)) - radius
                best = min(best, (distance, f"circle {number}"))
        return best

    def fk(self, q: FloatArray, link: str) -> FloatArray:
        angle = float(np.sum(q))
        pose = np.eye(4)
        pose[:2, :2] = [
            [math.cos(angle), -math.sin(angle)],
            [math.sin(angle), math.cos(angle)],
        ]
        pose[:2, 3] = self.corners(q)[-1]
        assert link == "tip"
        return pose
