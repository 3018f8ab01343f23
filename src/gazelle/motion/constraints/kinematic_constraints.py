"""Kinds of constraints: what a joint, a point of a link or its orientation must keep to."""

from __future__ import annotations

import enum
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from gazelle.motion.joint_space import FloatArray

__all__ = [
    "ForwardKinematics",
    "JointConstraint",
    "OrientationConstraint",
    "Parameterization",
    "PathConstraint",
    "PositionConstraint",
    "Region",
    "euler_xyz",
    "matrix_of",
    "rotation_error",
    "rotation_vector",
]


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


class Parameterization(enum.IntEnum):
    """``moveit_msgs/OrientationConstraint.parameterization``."""

    XYZ_EULER_ANGLES = 0
    ROTATION_VECTOR = 1


def euler_xyz(rotation: FloatArray) -> FloatArray:
    """Return angles about x, then the new y, then the new z (Eigen's ``eulerAngles(0, 1, 2)``)."""
    middle = math.asin(max(-1.0, min(1.0, float(rotation[0, 2]))))
    first = math.atan2(-rotation[1, 2], rotation[2, 2])
    last = math.atan2(-rotation[0, 1], rotation[0, 0])
    return np.array([first, middle, last])


def rotation_vector(rotation: FloatArray) -> FloatArray:
    """Return the axis of a rotation (3, 3) times its angle, (3,), rad."""
    twice_sine = np.array(
        [
            rotation[2, 1] - rotation[1, 2],
            rotation[0, 2] - rotation[2, 0],
            rotation[1, 0] - rotation[0, 1],
        ]
    )
    norm = float(np.linalg.norm(twice_sine))
    angle = math.atan2(norm, float(np.trace(rotation)) - 1.0)
    if norm > 1e-7:
        return twice_sine * (angle / norm)
    if angle < 1.0:
        return twice_sine * 0.5
    # Half a turn: the axis is the column of (R + I) / 2 that is longest.
    columns = (rotation + np.eye(3)) / 2.0
    column = columns[:, int(np.diag(columns).argmax())]
    axis: FloatArray = column / np.linalg.norm(column) * angle
    return axis


def matrix_of(angles: FloatArray, kind: Parameterization) -> FloatArray:
    """Return the rotation (3, 3) whose error is `angles` (3,); `rotation_error` inverted."""
    if kind is Parameterization.ROTATION_VECTOR:
        angle = float(np.linalg.norm(angles))
        if angle == 0.0:
            return np.eye(3)
        x, y, z = angles / angle
        cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        turned: FloatArray = (
            np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * cross @ cross
        )
        return turned
    (ca, cb, cc), (sa, sb, sc) = np.cos(angles), np.sin(angles)
    about_x = np.array([[1.0, 0.0, 0.0], [0.0, ca, -sa], [0.0, sa, ca]])
    about_y = np.array([[cb, 0.0, sb], [0.0, 1.0, 0.0], [-sb, 0.0, cb]])
    about_z = np.array([[cc, -sc, 0.0], [sc, cc, 0.0], [0.0, 0.0, 1.0]])
    product: FloatArray = about_x @ about_y @ about_z
    return product


def rotation_error(wanted: FloatArray, actual: FloatArray, kind: Parameterization) -> FloatArray:
    """Return how far `actual` is from `wanted` (3×3 each), about the axes of `wanted`, rad."""
    difference = wanted.T @ actual
    if kind is Parameterization.ROTATION_VECTOR:
        return rotation_vector(difference)
    return euler_xyz(difference)


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
