"""Collision shapes as MuJoCo geoms: primitives, convex hulls, height fields."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, assert_never

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import (
    Box,
    Capsule,
    Collision,
    Cone,
    Cylinder,
    Ellipsoid,
    Heightmap,
    MeshShape,
    Plane,
    Polyline,
    Solid,
    Sphere,
)
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.documents.images import PictureError, opened_picture
from gazelle.engine.collision_meshes import Piece, convex_pieces, polyline_pieces, solid_pieces
from gazelle.engine.mujoco_library import mujoco
from gazelle.geometry import Pose, quat_xyzw_from_rpy

__all__ = ["GeomAssets", "GeomShape", "add_geom", "geom_shapes", "read_terrain"]


Array = NDArray[np.float64]
_CONE_CORNERS = 32


@dataclass(frozen=True, slots=True, eq=False)
class GeomShape:
    """One MuJoCo geom: a primitive, a convex hull or a height field.

    Attributes:
        kind: value of ``mjtGeom``.
        size: MuJoCo's size numbers.
        T_collision_geom: pose in the collision's frame.
        hull_m: points whose convex hull it is, (N, 3), for meshes.
        heights: rows × columns of 0…1 for height fields, first row at the smallest y.
        terrain_m: half size x, half size y, height, base thickness of a height field.
    """

    kind: Any
    size: tuple[float, ...] = ()
    T_collision_geom: Pose = Pose()  # noqa: RUF009 - frozen
    hull_m: Array | None = None
    heights: Array | None = None
    terrain_m: tuple[float, float, float, float] | None = None


def geom_shapes(
    collision: Collision, name: str, *, static: bool, scenery: bool, diagnostics: Diagnostics
) -> tuple[GeomShape, ...]:
    """Return the geoms that stand for a collision shape; several for a concave mesh.

    Args:
        collision: the collision.
        name: its full name for messages.
        static: it never moves, so infinite planes and terrains are possible.
        scenery: nothing of its model moves, so the surface of an open mesh is kept.
        diagnostics: takes what cannot be represented.
    """
    types = mujoco.mjtGeom
    shapes: tuple[GeomShape, ...]
    match collision.shape:
        case Box(size_m=size):
            shapes = (GeomShape(types.mjGEOM_BOX, tuple(edge / 2 for edge in size)),)
        case Sphere(radius_m=radius):
            shapes = (GeomShape(types.mjGEOM_SPHERE, (radius,)),)
        case Cylinder(radius_m=radius, length_m=length):
            shapes = (GeomShape(types.mjGEOM_CYLINDER, (radius, length / 2)),)
        case Capsule(radius_m=radius, length_m=length):
            shapes = (GeomShape(types.mjGEOM_CAPSULE, (radius, length / 2)),)
        case Ellipsoid(radii_m=radii):
            shapes = (GeomShape(types.mjGEOM_ELLIPSOID, tuple(radii)),)
        case Cone(radius_m=radius, length_m=length):
            shapes = (_hull(_cone_points(radius, length)),)
        case Solid():
            shapes = tuple(_hull(points) for points in solid_pieces(collision.shape))
        case Plane(normal=normal):
            shapes = (_plane(normal, collision, name, static, diagnostics),)
        case Heightmap():
            shapes = _terrain(collision.shape, collision, name, static, diagnostics)
        case MeshShape():
            pieces = convex_pieces(collision.shape, name, scenery=scenery, diagnostics=diagnostics)
            shapes = tuple(_solid(piece) for piece in pieces)
        case Polyline():
            shapes = tuple(_solid(piece) for piece in polyline_pieces(collision.shape))
        case _:
            assert_never(collision.shape)
    return tuple(shape for shape in shapes if _has_volume(shape, collision, name, diagnostics))


class GeomAssets:
    """Meshes and height fields of a spec's geoms.

    Geoms that are the hull of the very same points have one mesh: a building's hundred chairs
    are kept and compiled once.
    """

    def __init__(self, spec: Any) -> None:
        """Start without any."""
        self._spec = spec
        # The points are held: an address is no name for what is gone.
        self._meshes: dict[int, tuple[Array, str]] = {}

    def mesh(self, hull_m: Array, name: str) -> str:
        """Return the name of the mesh with these points, (n, 3); a new one has a geom's name."""
        known = self._meshes.get(id(hull_m))
        if known is None:
            mesh = self._spec.add_mesh(name=f"mesh {name}")
            mesh.uservert = hull_m.ravel()
            mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX
            known = self._meshes[id(hull_m)] = (hull_m, mesh.name)
        return known[1]

    def height_field(
        self, heights: Array, terrain_m: tuple[float, float, float, float], name: str
    ) -> str:
        """Return the name of a new height field.

        Args:
            heights: (rows, columns), 0 to 1 of its height, row 0 at −y.
            terrain_m: half sizes along x and y, height, depth of the base.
            name: of the geom.
        """
        field = self._spec.add_hfield(name=f"terrain {name}")
        field.nrow, field.ncol = heights.shape
        field.size = list(terrain_m)
        field.userdata = heights.ravel()
        return str(field.name)


def add_geom(body: Any, name: str, shape: GeomShape, T_body_geom: Pose, assets: GeomAssets) -> Any:
    """Add one geom, and the asset it needs, to a body; contacts are left to the caller."""
    geom = body.add_geom(name=name, type=shape.kind)
    geom.pos = list(T_body_geom.position_m)
    geom.quat = list(T_body_geom.quat_wxyz)
    if shape.hull_m is not None:
        geom.meshname = assets.mesh(shape.hull_m, name)
    elif shape.heights is not None and shape.terrain_m is not None:
        geom.hfieldname = assets.height_field(shape.heights, shape.terrain_m, name)
    else:
        geom.size = [*shape.size, 0.0, 0.0, 0.0][:3]
    return geom


def read_terrain(
    shape: Heightmap, name: str, span: SourceSpan | None, diagnostics: Diagnostics
) -> NDArray[np.float64] | None:
    """Return the heights of a heightmap's image, 0 for black to 1 for white, row 0 at −y.

    They are (rows, columns). Gazebo puts the image's top edge at the largest y.
    """
    if shape.path is None:
        return None
    try:
        with opened_picture(shape.path) as image:
            pixels = np.asarray(image.convert("I;16" if image.mode.startswith("I") else "L"))
    except (OSError, PictureError) as error:
        diagnostics.report(
            "engine.unreadable-terrain",
            f"the heightmap '{shape.uri}' of collision '{name}' cannot be read as an image"
            f" ({error}); it does not collide",
            shape.span or span,
        )
        return None
    top = 65535.0 if pixels.dtype.itemsize > 1 else 255.0
    return np.flipud(pixels).astype(np.float64) / top


def _hull(points: Array) -> GeomShape:
    return GeomShape(mujoco.mjtGeom.mjGEOM_MESH, hull_m=np.ascontiguousarray(points, np.float64))


def _solid(piece: Piece) -> GeomShape:
    round_shape = piece.round_shape
    if round_shape is None:
        return _hull(piece.points_m)
    radius, half_length, pose = round_shape
    if half_length is None:
        return GeomShape(mujoco.mjtGeom.mjGEOM_SPHERE, (radius,), pose)
    return GeomShape(mujoco.mjtGeom.mjGEOM_CYLINDER, (radius, half_length), pose)


def _cone_points(radius: float, length: float) -> Array:
    angles = np.linspace(0, 2 * math.pi, _CONE_CORNERS, endpoint=False)
    rim = np.stack(
        [radius * np.cos(angles), radius * np.sin(angles), np.full_like(angles, -length / 2)], 1
    )
    return np.vstack([rim, [[0.0, 0.0, length / 2]]])


def _plane(
    normal: tuple[float, float, float],
    collision: Collision,
    name: str,
    static: bool,
    diagnostics: Diagnostics,
) -> GeomShape:
    T_collision_geom = _facing(normal)
    if static:
        return GeomShape(mujoco.mjtGeom.mjGEOM_PLANE, (0.0, 0.0, 1.0), T_collision_geom)
    diagnostics.report(
        "engine.moving-plane",
        f"collision '{name}' is a plane on a link that moves; the engine uses a thin box of the"
        " plane's size instead",
        collision.span,
    )
    size = collision.shape.size_m if isinstance(collision.shape, Plane) else (1.0, 1.0)
    thin = 0.005
    below = T_collision_geom @ Pose((0.0, 0.0, -thin))
    return GeomShape(mujoco.mjtGeom.mjGEOM_BOX, (size[0] / 2, size[1] / 2, thin), below)


def _facing(normal: tuple[float, float, float]) -> Pose:
    """Return the rotation that turns z onto a normal."""
    x, y, z = normal
    norm = math.sqrt(x * x + y * y + z * z)
    if norm == 0:
        return Pose()
    yaw, pitch = math.atan2(y, x), math.acos(max(-1.0, min(1.0, z / norm)))
    if pitch == 0:
        return Pose()
    return Pose((0.0, 0.0, 0.0), quat_xyzw_from_rpy((0.0, pitch, yaw)))


def _terrain(
    shape: Heightmap, collision: Collision, name: str, static: bool, diagnostics: Diagnostics
) -> tuple[GeomShape, ...]:
    heights = read_terrain(shape, name, collision.span, diagnostics)
    if heights is None:
        return ()
    if not static:
        diagnostics.report(
            "engine.moving-terrain",
            f"collision '{name}' is a heightmap on a link that moves; it does not collide",
            collision.span,
        )
        return ()
    x, y, z = shape.size_m
    size = (x / 2, y / 2, max(z, 1e-6), 1.0)
    pose = Pose(shape.position_m)
    kind = mujoco.mjtGeom.mjGEOM_HFIELD
    return (GeomShape(kind, (), pose, heights=heights, terrain_m=size),)


def _has_volume(
    shape: GeomShape, collision: Collision, name: str, diagnostics: Diagnostics
) -> bool:
    if shape.kind == mujoco.mjtGeom.mjGEOM_PLANE or not shape.size or min(shape.size) > 0:
        return True
    diagnostics.report(
        "engine.flat-shape",
        f"collision '{name}' has a size of zero or less; it does not collide",
        collision.span,
    )
    return False
