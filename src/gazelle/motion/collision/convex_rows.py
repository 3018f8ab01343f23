"""Solids as the rows of numbers that the kernels of collision read."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.engine.library import mujoco
from gazelle.geometry import convex_hull
from gazelle.motion.collision.gjk_kernels import outside_m
from gazelle.motion.collision.solids import Solid
from gazelle.motion.space import FloatArray

__all__ = ["ConvexRows", "rows_of"]

IntArray = NDArray[np.int64]

_HULL, _BOX, _CYLINDER, _SEGMENT, _ELLIPSOID, _PLANE, _OTHER = range(7)
_ROW = 24
_FEW = 40


class ConvexRows(NamedTuple):
    """Solids of one link or thing, in its frame; the first is a simple one around all of them.

    Where there is only one, and a simple one, it is the one around all.

    Attributes:
        solids: (m, 24): rotation, position (m), three half sizes (m), radius by which it is larger
            all around (m), by how much it may be larger than said (m), centre and radius of a ball
            around it (m), half sizes of a box around that centre along the frame's axes (m).
        kinds: (m, 4): kind, frame, first vertex and number of vertices.
        vertices: (v, 3), m.
        own: the number of solids, without the one around all.
    """

    solids: FloatArray
    kinds: IntArray
    vertices: FloatArray
    own: int


class _Hull(NamedTuple):
    """Corners of a hull, and how far the real one reaches beyond theirs."""

    corners_m: FloatArray
    slack_m: float


def rows_of(solids: Sequence[Solid], margin_m: float = 0.0) -> ConvexRows:
    """Return solids as rows.

    Args:
        solids: at least one.
        margin_m: how near something has to come to count as touching.
    """
    made = [_row(solid, margin_m) for solid in solids]
    count = len(made)
    if count > 1 or len(made[0][2]) > _FEW:
        made.insert(0, _around(made, margin_m))
    first, kinds = 0, []
    for _, kind, corners in made:
        kinds.append((kind, 0, first, len(corners)))
        first += len(corners)
    vertices = np.concatenate([corners for _, _, corners in made])
    return ConvexRows(
        np.array([row for row, _, _ in made]), np.array(kinds, np.int64), vertices, count
    )


_NONE = np.zeros((0, 3))


def _row(solid: Solid, margin_m: float) -> tuple[FloatArray, int, FloatArray]:
    shape, pose = solid
    types = mujoco.mjtGeom
    if shape.hull_m is not None:
        points = shape.hull_m @ pose.matrix()[:3, :3].T + np.array(pose.position_m)
        hull = _Hull(_corners(points), 0.0)
        return (*_hull_row(hull, margin_m), hull.corners_m)
    row = np.zeros(_ROW)
    matrix = pose.matrix()
    row[:9], row[9:12] = matrix[:3, :3].ravel(), matrix[:3, 3]
    row[17:20] = matrix[:3, 3]
    size = (*shape.size, 0.0, 0.0, 0.0)[:3]
    kind, ball = _OTHER, np.inf
    if shape.kind == types.mjGEOM_SPHERE:
        kind, row[15], ball = _SEGMENT, size[0], size[0]
    elif shape.kind == types.mjGEOM_CAPSULE:
        kind, row[13], row[15], ball = _SEGMENT, size[1], size[0], size[0] + size[1]
    elif shape.kind == types.mjGEOM_BOX:
        kind, row[12:15], ball = _BOX, size, float(np.linalg.norm(size))
    elif shape.kind == types.mjGEOM_CYLINDER:
        kind, row[12:14], ball = _CYLINDER, size[:2], float(np.hypot(size[0], size[1]))
    elif shape.kind == types.mjGEOM_ELLIPSOID:
        kind, row[12:15], ball = _ELLIPSOID, size, max(size)
    elif shape.kind == types.mjGEOM_PLANE:
        kind = _PLANE
    row[16], row[20] = margin_m, ball + margin_m
    row[21:24] = _seen_along(matrix[:3, :3], _half_sizes(row, kind)) + margin_m
    return row, kind, _NONE


def _hull_row(hull: _Hull, margin_m: float) -> tuple[FloatArray, int]:
    row = np.zeros(_ROW)
    row[[0, 4, 8]] = 1.0
    corners = hull.corners_m
    centre = (corners.min(axis=0) + corners.max(axis=0)) / 2.0
    row[16] = hull.slack_m + margin_m
    row[17:20] = centre
    row[20] = float(np.linalg.norm(corners - centre, axis=1).max()) + row[16]
    row[21:24] = corners.max(axis=0) - centre + row[16]
    return row, _HULL


def _around(
    made: list[tuple[FloatArray, int, FloatArray]], margin_m: float
) -> tuple[FloatArray, int, FloatArray]:
    """Return a hull around all; one of which nothing is known where a solid has no end."""
    corners = []
    for row, kind, own in made:
        if kind == _HULL:
            corners.append(own)
        elif not np.isfinite(row[20]):
            return _endless(), _OTHER, _NONE
        else:
            corners.append(_box_around(row, kind))
    slack = max((row[16] - margin_m for row, kind, _ in made if kind == _HULL), default=0.0)
    hull = _reduced(np.concatenate(corners))
    hull = hull._replace(slack_m=hull.slack_m + slack)
    return (*_hull_row(hull, margin_m), hull.corners_m)


def _endless() -> FloatArray:
    row = np.zeros(_ROW)
    row[20:24] = np.inf
    return row


def _seen_along(rotation: FloatArray, half_m: FloatArray) -> FloatArray:
    """Return the half sizes of the upright box around a turned one."""
    if not np.isfinite(half_m).all():
        return half_m
    return np.asarray(np.abs(rotation) @ half_m)


def _half_sizes(row: FloatArray, kind: int) -> FloatArray:
    """Return the half sizes of the box around a primitive, along its own axes."""
    if kind in {_PLANE, _OTHER}:
        return np.full(3, np.inf)
    half = row[12:15].copy()
    if kind == _CYLINDER:
        half[:] = row[12], row[12], row[13]
    elif kind == _SEGMENT:
        half[:] = 0.0, 0.0, row[13]
    return np.asarray(half + row[15])


def _box_around(row: FloatArray, kind: int) -> FloatArray:
    """Return the corners of the box around a primitive."""
    signs = np.array(np.meshgrid(*[(-1.0, 1.0)] * 3)).reshape(3, -1).T
    return signs * _half_sizes(row, kind) @ row[:9].reshape(3, 3).T + row[9:12]


def _corners(points_m: FloatArray) -> FloatArray:
    return np.ascontiguousarray(convex_hull(points_m).vertices_m, dtype=np.float64)


def _reduced(points_m: FloatArray) -> _Hull:
    """Return few corners of a hull, with how far the rest lies outside.

    Corners that are farthest from the hull of those taken are added until there are enough.
    """
    corners = _corners(points_m)
    if len(corners) <= _FEW:
        return _Hull(corners, 0.0)
    taken = {int(np.argmax(corners @ way)) for way in _directions(_FEW // 3)}
    while True:
        some = np.ascontiguousarray(corners[sorted(taken)])
        outside = outside_m(corners, some)
        if len(taken) >= _FEW or not outside.any():
            return _Hull(some, float(outside.max()))
        taken |= {int(place) for place in np.argsort(outside)[-3:]}


def _directions(count: int) -> FloatArray:
    """Return directions spread evenly, those of Fibonacci's spiral."""
    turn = np.pi * (3.0 - np.sqrt(5.0)) * np.arange(count)
    z = 1.0 - 2.0 * (np.arange(count) + 0.5) / count
    flat = np.sqrt(1.0 - z * z)
    return np.stack([flat * np.cos(turn), flat * np.sin(turn), z], axis=1)
