"""Regions that a point of a link must stay in."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gazelle.motion.space import FloatArray

__all__ = ["Region"]

_DIMENSIONS = {"box": 3, "sphere": 1, "cylinder": 2}


@dataclass(frozen=True, eq=False)
class Region:
    """A solid primitive at a pose.

    Attributes:
        kind: ``"box"``, ``"sphere"`` or ``"cylinder"`` (along its z axis).
        dimensions_m: box: sides along x, y, z; sphere: radius; cylinder: height, radius (the
            order of ``shape_msgs/SolidPrimitive``).
        pose: 4×4, of the region in the planning frame.
    """

    kind: str
    dimensions_m: tuple[float, ...]
    pose: FloatArray

    def __post_init__(self) -> None:
        wanted = _DIMENSIONS.get(self.kind)
        if wanted is None:
            known = ", ".join(_DIMENSIONS)
            raise ValueError(f"a region of kind '{self.kind}' is not one of {known}")
        sides = self.dimensions_m[:wanted]
        if len(sides) < wanted or not all(0.0 <= side < math.inf for side in sides):
            raise ValueError(f"a {self.kind} needs {wanted} dimensions, finite and not negative")

    def beyond(self, point: FloatArray, share: float) -> FloatArray:
        """Return the way from the region to a point, zero within; 3 numbers in the region's axes.

        Args:
            point: shape (3,), m, in the planning frame.
            share: how much of the region's size counts.
        """
        local: FloatArray = self.pose[:3, :3].T @ (point - self.pose[:3, 3])
        if self.kind == "box":
            half = np.array(self.dimensions_m[:3]) * (0.5 * share)
            outside: FloatArray = local - np.clip(local, -half, half)
            return outside
        if self.kind == "sphere":
            return _beyond_radius(local, self.dimensions_m[0] * share)
        half_height, radius = 0.5 * self.dimensions_m[0] * share, self.dimensions_m[1] * share
        height = local[2] - np.clip(local[2], -half_height, half_height)
        return np.append(_beyond_radius(local[:2], radius), height)

    def sample(self, rng: np.random.Generator) -> FloatArray:
        """Return a point, (3,), m, drawn uniformly from the region, in the planning frame."""
        if self.kind == "box":
            local = (rng.random(3) - 0.5) * np.array(self.dimensions_m[:3])
        elif self.kind == "sphere":
            direction = rng.standard_normal(3)
            radius = self.dimensions_m[0] * rng.random() ** (1.0 / 3.0)
            local = direction / np.linalg.norm(direction) * radius
        else:
            angle, radius = 2.0 * np.pi * rng.random(), self.dimensions_m[1] * rng.random() ** 0.5
            height = (rng.random() - 0.5) * self.dimensions_m[0]
            local = np.array([radius * np.cos(angle), radius * np.sin(angle), height])
        drawn: FloatArray = self.pose[:3, :3] @ local + self.pose[:3, 3]
        return drawn


def _beyond_radius(local: FloatArray, radius: float) -> FloatArray:
    distance = float(np.linalg.norm(local))
    return np.zeros_like(local) if distance <= radius else local * (1.0 - radius / distance)
