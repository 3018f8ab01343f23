"""Kinds of constraints: what a joint, a point of a link or its orientation must keep to."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from gazelle.motion.constraints.region import Region
from gazelle.motion.constraints.rotation import Parameterization, rotation_error
from gazelle.motion.space import FloatArray

__all__ = [
    "ForwardKinematics",
    "JointConstraint",
    "OrientationConstraint",
    "PathConstraint",
    "PositionConstraint",
]

ForwardKinematics = Callable[[FloatArray, str], FloatArray]
"""Returns the pose of a link, 4×4 in the planning frame, at a configuration."""


class PathConstraint(Protocol):
    """Something that must hold at every configuration of a path."""

    def excess(self, q: FloatArray, share: float = 1.0) -> FloatArray:
        """Return by how much the tolerances are exceeded, signed, zeros where they are kept.

        Args:
            q: a configuration (n,), rad or m.
            share: how much of the tolerances counts; below 1 asks for a margin.
        """
        ...

    def why(self, q: FloatArray) -> str:
        """Return what is exceeded at `q` (n,), in words."""
        ...


@dataclass(frozen=True)
class JointConstraint:
    """A joint stays near a position.

    Attributes:
        joint: its name.
        index: its place in the configuration.
        position: rad or m.
        tolerance_above: how far above `position` it may be.
        tolerance_below: how far below `position` it may be.
    """

    joint: str
    index: int
    position: float
    tolerance_above: float
    tolerance_below: float

    def excess(self, q: FloatArray, share: float = 1.0) -> FloatArray:
        """Return how far the joint is outside at `q` (n,), as (1,); see `PathConstraint`."""
        off = float(q[self.index]) - self.position
        low, high = -self.tolerance_below * share, self.tolerance_above * share
        return np.array([off - min(max(off, low), high)])

    def why(self, q: FloatArray) -> str:
        """Return the joint, where it is at `q` (n,) and where it may be."""
        low, high = self.position - self.tolerance_below, self.position + self.tolerance_above
        return (
            f"joint '{self.joint}' is at {q[self.index]:.4g}, its constraint allows "
            f"[{low:.4g}, {high:.4g}]"
        )


@dataclass(frozen=True, eq=False)
class PositionConstraint:
    """A point of a link stays in one of some regions.

    Attributes:
        link: its name.
        regions: where the point may be.
        fk: gives the pose of the link.
        offset_m: the point, in the link's frame.
    """

    link: str
    regions: tuple[Region, ...]
    fk: ForwardKinematics
    offset_m: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def excess(self, q: FloatArray, share: float = 1.0) -> FloatArray:
        """Return the way, (3,), m, from the nearest region to the point; see `PathConstraint`."""
        point = self._point(q)
        ways = (region.beyond(point, share) for region in self.regions)
        return min(ways, key=lambda way: float(way @ way))

    def why(self, q: FloatArray) -> str:
        """Return the link, where its point is at `q` (n,) and how far that is outside."""
        point, distance = self._point(q), float(np.linalg.norm(self.excess(q)))
        place = ", ".join(f"{value:.3f}" for value in point)
        return (
            f"the position of link '{self.link}' is ({place}) m, {distance:.4f} m outside the "
            "region of its constraint"
        )

    def _point(self, q: FloatArray) -> FloatArray:
        pose = self.fk(q, self.link)
        point: FloatArray = pose[:3, :3] @ np.array(self.offset_m) + pose[:3, 3]
        return point


@dataclass(frozen=True, eq=False)
class OrientationConstraint:
    """A link keeps an orientation.

    Attributes:
        link: its name.
        orientation: 3×3, of the link in the planning frame.
        tolerance_rad: about x, y and z, each way.
        fk: gives the pose of the link.
        parameterization: what the tolerances measure.
    """

    link: str
    orientation: FloatArray
    tolerance_rad: tuple[float, float, float]
    fk: ForwardKinematics
    parameterization: Parameterization = Parameterization.XYZ_EULER_ANGLES

    def excess(self, q: FloatArray, share: float = 1.0) -> FloatArray:
        """Return the angles, (3,), rad, beyond the tolerances; see `PathConstraint`."""
        error = self._error(q)
        most = np.array(self.tolerance_rad) * share
        beyond: FloatArray = error - np.clip(error, -most, most)
        return beyond

    def why(self, q: FloatArray) -> str:
        """Return the link, its error at `q` (n,) and what is tolerated."""
        # Adding zero turns -0.0 into 0.0.
        error = ", ".join(f"{value:.3f}" for value in np.round(self._error(q), 3) + 0.0)
        most = ", ".join(f"{value:.3f}" for value in self.tolerance_rad)
        return (
            f"the orientation of link '{self.link}' is ({error}) rad about x, y, z from the one "
            f"of its constraint, which tolerates ({most}) rad"
        )

    def _error(self, q: FloatArray) -> FloatArray:
        rotation = self.fk(q, self.link)[:3, :3]
        return rotation_error(self.orientation, rotation, self.parameterization)
