"""Lines and circles of a link, with its orientation turning about one axis."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from gazelle.motion.constraints.kinematic_constraints import (
    Parameterization,
    matrix_of,
    rotation_vector,
)
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.pilz.command import Auxiliary, AuxiliaryKind
from gazelle.motion.planning.error_codes import ErrorCode, PlanningError

__all__ = ["CartesianPath", "circle", "line"]

_COLINEAR = 1e-5
_RADIUS_DIFFERENCE_M = 1e-2
_MIN_RADIUS_M = 1e-5


@dataclass(frozen=True, eq=False)
class CartesianPath:
    """Poses of a link between two poses.

    Attributes:
        length_m: of the way; a turn by an angle counts as an arc of the equivalent radius.
        position: gives the position (3,), m, at a part of the way, 0 to 1.
        start: 3×3 orientation at the start.
        turn: rotation vector (3,), rad, to the orientation at the end, in the frame of `start`.
    """

    length_m: float
    position: Callable[[float], FloatArray]
    start: FloatArray
    turn: FloatArray

    def pose(self, part: float) -> FloatArray:
        """Return the pose, 4×4, at a part of the way, 0 to 1."""
        pose = np.eye(4)
        pose[:3, :3] = self.start @ matrix_of(part * self.turn, Parameterization.ROTATION_VECTOR)
        pose[:3, 3] = self.position(part)
        return pose


def line(start: FloatArray, goal: FloatArray, radius_m: float) -> CartesianPath:
    """Return the straight path between two poses.

    Args:
        start: 4×4.
        goal: 4×4.
        radius_m: equivalent radius of turns: the quotient of the limits of both velocities.
    """
    way = goal[:3, 3] - start[:3, 3]
    return _path(
        start, goal, float(np.linalg.norm(way)), lambda s: start[:3, 3] + s * way, radius_m
    )


def circle(
    start: FloatArray, goal: FloatArray, auxiliary: Auxiliary, radius_m: float
) -> CartesianPath:
    """Return the arc between two poses, (4, 4) each.

    With a center it is the shorter one; with an interim point the one that passes it.

    Raises:
        PlanningError: INVALID_MOTION_PLAN where there is no such arc.
    """
    p0, p1, point = start[:3, 3], goal[:3, 3], np.asarray(auxiliary.point_m, dtype=np.float64)
    if auxiliary.kind is AuxiliaryKind.CENTER:
        center = point
        normal = np.cross(p0 - center, p1 - center)
        _check_radii(float(np.linalg.norm(p0 - center)), float(np.linalg.norm(p1 - center)))
    else:
        normal = np.cross(point - p0, p1 - p0)
        center = _center(p0, point, p1, normal)
    if float(np.linalg.norm(normal)) < _COLINEAR:
        _fail(f"the start, the goal and the {auxiliary.kind} point of CIRC lie on a line")
    first, last = p0 - center, p1 - center
    r0, r1 = float(np.linalg.norm(first)), float(np.linalg.norm(last))
    x = first / r0
    y = np.cross(normal / np.linalg.norm(normal), x)
    angle = math.atan2(float(last @ y), float(last @ x)) % (2.0 * math.pi)

    def position(part: float) -> FloatArray:
        # The radii may differ by a centimetre; the goal is met nevertheless.
        radius, turned = r0 + part * (r1 - r0), part * angle
        where: FloatArray = center + radius * (math.cos(turned) * x + math.sin(turned) * y)
        return where

    return _path(start, goal, r0 * angle, position, radius_m)


def _path(
    start: FloatArray,
    goal: FloatArray,
    length: float,
    position: Callable[[float], FloatArray],
    radius_m: float,
) -> CartesianPath:
    turn = rotation_vector(start[:3, :3].T @ goal[:3, :3])
    longest = max(length, float(np.linalg.norm(turn)) * radius_m)
    return CartesianPath(longest, position, start[:3, :3], turn)


def _center(p0: FloatArray, interim: FloatArray, p1: FloatArray, normal: FloatArray) -> FloatArray:
    """Return the center of the circle through three points."""
    square = float(normal @ normal)
    if square < _COLINEAR**2:
        return p0
    t, u = interim - p0, p1 - p0
    center: FloatArray = p0 + np.cross(float(t @ t) * u - float(u @ u) * t, normal) * (0.5 / square)
    return center


def _check_radii(first: float, last: float) -> None:
    if min(first, last) < _MIN_RADIUS_M:
        _fail("the center of CIRC is its start or its goal")
    if abs(first - last) > _RADIUS_DIFFERENCE_M:
        _fail(
            f"the center of CIRC is {first:.4f} m from the start and {last:.4f} m from the goal; "
            f"more than {_RADIUS_DIFFERENCE_M:g} m of difference is no circle"
        )


def _fail(reason: str) -> None:
    raise PlanningError(ErrorCode.INVALID_MOTION_PLAN, reason)
