"""Shapes of links and things as convex solids, and as the rows of numbers that kernels collide."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Collision
from gazelle.diagnostics import Diagnostics
from gazelle.engine.collision_geoms import GeomShape, geom_shapes
from gazelle.engine.mujoco_library import mujoco
from gazelle.geometry import Mesh, MeshError, MeshPart, Pose, convex_hull, convex_parts
from gazelle.motion.collision.gjk_kernels import (
    BOX,
    BOX_HALF,
    CENTRE,
    CYLINDER,
    ELLIPSOID,
    HALF,
    HULL,
    OTHER,
    PLANE,
    POSITION,
    RADIUS,
    ROTATION,
    ROUNDING,
    SEGMENT,
    SLACK,
    outside_m,
)
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.model import RobotModel
from gazelle.motion.scene import SceneMesh, SceneShape, WorldObject

__all__ = ["ConvexRows", "Solid", "link_solids", "object_solids", "rows_of"]


class Solid(NamedTuple):
    """A convex solid in the frame of its link or thing."""

    shape: GeomShape
    T_owner_shape: Pose


def link_solids(robot: RobotModel, diagnostics: Diagnostics) -> dict[str, tuple[Solid, ...]]:
    """Return the solids of all links that have collisions; concave meshes are several.

    Args:
        robot: the robot.
        diagnostics: receives what cannot be collided, the first time a robot is asked for.
    """
    found, told = _link_solids(robot)
    diagnostics.extend(told)
    return found


def object_solids(item: WorldObject, diagnostics: Diagnostics) -> tuple[Solid, ...]:
    """Return the solids of a thing.

    Args:
        item: the thing.
        diagnostics: receives what cannot be collided.
    """
    found: list[Solid] = []
    for placed in item.shapes:
        shapes = _solids_of(placed.shape, item.name, diagnostics)
        found += [Solid(shape, placed.T_object_shape @ shape.T_collision_geom) for shape in shapes]
    return tuple(found)


@lru_cache(maxsize=8)
def _link_solids(robot: RobotModel) -> tuple[dict[str, tuple[Solid, ...]], Diagnostics]:
    told = Diagnostics()
    found: dict[str, tuple[Solid, ...]] = {}
    for link in robot.description.links:
        solids: list[Solid] = []
        for collision in link.collisions:
            shapes = geom_shapes(
                collision, f"{link.name}::{collision.name}",
                static=False, scenery=False, diagnostics=told,
            )  # fmt: skip
            pose = collision.T_link_collision
            solids += [Solid(shape, pose @ shape.T_collision_geom) for shape in shapes]
        if solids:
            found[link.name] = tuple(solids)
    return found, told


def _solids_of(shape: SceneShape, name: str, diagnostics: Diagnostics) -> tuple[GeomShape, ...]:
    if not isinstance(shape, SceneMesh):
        collision = Collision(name, shape)
        return geom_shapes(collision, name, static=True, scenery=True, diagnostics=diagnostics)
    try:
        parts = _parts_of(shape)
    except (MeshError, ValueError) as error:
        message = f"the mesh of object '{name}' cannot be used ({error}); it does not collide"
        diagnostics.report("engine.bad-mesh", message)
        return ()
    kind = mujoco.mjtGeom.mjGEOM_MESH
    return tuple(
        GeomShape(kind, hull_m=np.ascontiguousarray(part.vertices_m, np.float64)) for part in parts
    )


@lru_cache(maxsize=64)
def _parts_of(mesh: SceneMesh) -> tuple[MeshPart, ...]:
    if not len(mesh.faces):
        return (convex_hull(mesh.vertices_m),)
    faces = np.ascontiguousarray(mesh.faces, np.int32)
    vertices = np.array(mesh.vertices_m, np.float64)
    part = MeshPart("", vertices, faces, np.zeros_like(vertices))
    return convex_parts(Mesh((part,))).parts


IntArray = NDArray[np.int64]

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
    row[ROTATION:POSITION], row[POSITION:HALF] = matrix[:3, :3].ravel(), matrix[:3, 3]
    row[CENTRE:RADIUS] = matrix[:3, 3]
    size = (*shape.size, 0.0, 0.0, 0.0)[:3]
    kind, ball = OTHER, np.inf
    if shape.kind == types.mjGEOM_SPHERE:
        kind, row[ROUNDING], ball = SEGMENT, size[0], size[0]
    elif shape.kind == types.mjGEOM_CAPSULE:
        kind, row[HALF + 1], row[ROUNDING], ball = SEGMENT, size[1], size[0], size[0] + size[1]
    elif shape.kind == types.mjGEOM_BOX:
        kind, row[HALF:ROUNDING], ball = BOX, size, float(np.linalg.norm(size))
    elif shape.kind == types.mjGEOM_CYLINDER:
        kind, row[HALF : HALF + 2], ball = CYLINDER, size[:2], float(np.hypot(size[0], size[1]))
    elif shape.kind == types.mjGEOM_ELLIPSOID:
        kind, row[HALF:ROUNDING], ball = ELLIPSOID, size, max(size)
    elif shape.kind == types.mjGEOM_PLANE:
        kind = PLANE
    row[SLACK], row[RADIUS] = margin_m, ball + margin_m
    row[BOX_HALF:] = _seen_along(matrix[:3, :3], _half_sizes(row, kind)) + margin_m
    return row, kind, _NONE


def _hull_row(hull: _Hull, margin_m: float) -> tuple[FloatArray, int]:
    row = np.zeros(_ROW)
    row[ROTATION:POSITION] = np.eye(3).ravel()
    corners = hull.corners_m
    centre = (corners.min(axis=0) + corners.max(axis=0)) / 2.0
    row[SLACK] = hull.slack_m + margin_m
    row[CENTRE:RADIUS] = centre
    row[RADIUS] = float(np.linalg.norm(corners - centre, axis=1).max()) + row[SLACK]
    row[BOX_HALF:] = corners.max(axis=0) - centre + row[SLACK]
    return row, HULL


def _around(
    made: list[tuple[FloatArray, int, FloatArray]], margin_m: float
) -> tuple[FloatArray, int, FloatArray]:
    """Return a hull around all; one of which nothing is known where a solid has no end."""
    corners = []
    for row, kind, own in made:
        if kind == HULL:
            corners.append(own)
        elif not np.isfinite(row[RADIUS]):
            return _endless(), OTHER, _NONE
        else:
            corners.append(_box_around(row, kind))
    slack = max((row[SLACK] - margin_m for row, kind, _ in made if kind == HULL), default=0.0)
    hull = _reduced(np.concatenate(corners))
    hull = hull._replace(slack_m=hull.slack_m + slack)
    return (*_hull_row(hull, margin_m), hull.corners_m)


def _endless() -> FloatArray:
    row = np.zeros(_ROW)
    row[RADIUS:] = np.inf
    return row


def _seen_along(rotation: FloatArray, half_m: FloatArray) -> FloatArray:
    """Return the half sizes of the upright box around a turned one."""
    if not np.isfinite(half_m).all():
        return half_m
    return np.asarray(np.abs(rotation) @ half_m)


def _half_sizes(row: FloatArray, kind: int) -> FloatArray:
    """Return the half sizes of the box around a primitive, along its own axes."""
    if kind in {PLANE, OTHER}:
        return np.full(3, np.inf)
    half = row[HALF:ROUNDING].copy()
    if kind == CYLINDER:
        half[:] = row[HALF], row[HALF], row[HALF + 1]
    elif kind == SEGMENT:
        half[:] = 0.0, 0.0, row[HALF + 1]
    return np.asarray(half + row[ROUNDING])


def _box_around(row: FloatArray, kind: int) -> FloatArray:
    """Return the corners of the box around a primitive."""
    signs = np.array(np.meshgrid(*[(-1.0, 1.0)] * 3)).reshape(3, -1).T
    return (
        signs * _half_sizes(row, kind) @ row[ROTATION:POSITION].reshape(3, 3).T + row[POSITION:HALF]
    )


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
