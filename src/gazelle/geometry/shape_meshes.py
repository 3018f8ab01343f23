"""Triangles of the shapes of SDF, with normals and texture coordinates as Gazebo lays them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry.mesh import MeshPart, part_from_corners, part_from_soup
from gazelle.geometry.polygon_triangulation import triangulate
from gazelle.geometry.pose import Vector3
from gazelle.geometry.vertex_normals import group_points

__all__ = [
    "box_mesh",
    "capsule_mesh",
    "cone_mesh",
    "cylinder_mesh",
    "ellipsoid_mesh",
    "heightmap_mesh",
    "plane_mesh",
    "polyline_mesh",
    "sphere_mesh",
]

Outline = Sequence[tuple[float, float]]
Array = NDArray[np.float64]
SEGMENTS = 32
"""Divisions of a full circle, as Gazebo's unit cylinder and sphere have."""
Piece = tuple[Array, NDArray[np.intp], Array, Array]


def heightmap_mesh(
    heights: NDArray[np.float64], size_m: Vector3, position_m: Vector3 = (0.0, 0.0, 0.0)
) -> MeshPart:
    """Return terrain over a grid.

    Args:
        heights: (rows, columns), each 0…1; row 0 is the picture's top, which lies at +y.
        size_m: extent in x and y, and the height that 1 stands for.
        position_m: middle of the ground rectangle.

    Raises:
        ValueError: fewer than two rows or columns.
    """
    rows, columns = heights.shape
    if rows < 2 or columns < 2:
        raise ValueError(f"a heightmap needs at least 2 x 2 heights, found {rows} x {columns}")
    u, v = np.meshgrid(np.linspace(0.0, 1.0, columns), np.linspace(1.0, 0.0, rows))
    x = position_m[0] + (u - 0.5) * size_m[0]
    y = position_m[1] + (v - 0.5) * size_m[1]
    z = position_m[2] + heights * size_m[2]
    vertices = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    row, column = np.mgrid[0 : rows - 1, 0 : columns - 1]
    a = (row * columns + column).ravel()
    b, c, d = a + columns, a + columns + 1, a + 1
    faces = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    uv = np.stack([u, v], axis=-1).reshape(-1, 2)
    return MeshPart("heightmap", vertices, faces.astype(np.int32), _slopes(z, x, y), uv)


def polyline_mesh(outlines_m: Sequence[Outline], height_m: float) -> MeshPart:
    """Return closed outlines extruded from z = 0 to `height_m` (SDF ``<polyline>``).

    An outline inside another one is a hole; one inside a hole is solid again.

    Raises:
        ValueError: no outline has three different points, or the height is not positive.
    """
    if height_m <= 0:
        raise ValueError(f"a polyline's height must be positive, found {height_m}")
    rings, triangles = triangulate(outlines_m)
    points = np.concatenate(rings)
    flat = points[triangles]
    low = np.concatenate([flat[:, ::-1], np.zeros((*flat.shape[:2], 1))], axis=2)
    high = np.concatenate([flat, np.full((*flat.shape[:2], 1), height_m)], axis=2)
    walls = np.concatenate([_wall(ring, height_m) for ring in rings])
    soup = part_from_soup(np.concatenate([low, high, walls]), name="polyline")
    corners = soup.vertices_m[soup.faces].reshape(-1, 3)
    normals = soup.normals[soup.faces].reshape(-1, 3)
    uv = np.where(np.abs(normals[:, 2:]) > 0.5, corners[:, :2], _along(corners))
    return part_from_corners(
        corners, group_points(corners), normals=normals, uv=uv, name="polyline"
    )


def box_mesh(size_m: Vector3) -> MeshPart:
    """Return a box centred on its frame; each side shows the whole texture."""
    corners, normals, uv = [], [], []
    square = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    for axis in range(3):
        for sign in (1.0, -1.0):
            normal, across = np.zeros(3), np.zeros(3)
            normal[axis] = sign
            # Pictures on the sides stand upright: v runs along z, or along y on top and bottom.
            up = np.array([0.0, 1.0, 0.0]) if axis == 2 else np.array([0.0, 0.0, 1.0])
            across = np.cross(up, normal)
            corners.append(normal + square[:, :1] * across + square[:, 1:] * up)
            normals.append(np.repeat(normal[None], 4, axis=0))
            uv.append((square + 1) / 2)
    faces = np.concatenate([np.array([[0, 1, 2], [0, 2, 3]]) + 4 * side for side in range(6)])
    vertices = np.concatenate(corners) * (np.asarray(size_m, np.float64) / 2)
    return _part("box", vertices, faces, np.concatenate(normals), np.concatenate(uv))


def plane_mesh(size_m: tuple[float, float], normal: Vector3 = (0.0, 0.0, 1.0)) -> MeshPart:
    """Return a rectangle through the origin, seen from the side its normal points to."""
    z = np.asarray(normal, np.float64)
    length = float(np.linalg.norm(z))
    z = z / length if length > 0 else np.array([0.0, 0.0, 1.0])
    hint = np.array([1.0, 0.0, 0.0]) if abs(z[0]) < 0.9 else np.array([0.0, 0.0, -1.0])
    y = np.cross(z, hint)
    y /= np.linalg.norm(y)
    x = np.cross(y, z)
    square = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]) / 2
    vertices = square[:, :1] * size_m[0] * x + square[:, 1:] * size_m[1] * y
    faces = np.array([[0, 1, 2], [0, 2, 3]])
    return _part("plane", vertices, faces, np.repeat(z[None], 4, axis=0), square + 0.5)


def sphere_mesh(radius_m: float, *, segments: int = SEGMENTS) -> MeshPart:
    """Return a sphere; u runs once round the equator, v from the south to the north pole."""
    return ellipsoid_mesh((radius_m, radius_m, radius_m), segments=segments, name="sphere")


def ellipsoid_mesh(
    radii_m: Vector3, *, segments: int = SEGMENTS, name: str = "ellipsoid"
) -> MeshPart:
    """Return an ellipsoid with these semi-axes."""
    latitudes = np.linspace(-math.pi / 2, math.pi / 2, segments // 2 + 1)
    unit = _revolved(np.cos(latitudes), np.sin(latitudes), segments)
    radii = np.asarray(radii_m, np.float64)
    normals = unit / radii
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    v = np.linspace(0.0, 1.0, len(latitudes))
    return _part(name, unit * radii, _grid_faces(len(v), segments), normals, _grid_uv(v, segments))


def cylinder_mesh(radius_m: float, length_m: float, *, segments: int = SEGMENTS) -> MeshPart:
    """Return a cylinder about z; the texture goes once round the side and once on each cap."""
    half = length_m / 2
    side = _revolved(np.full(2, radius_m), np.array([-half, half]), segments)
    normals = side * (1.0, 1.0, 0.0) / radius_m
    wall = (side, _grid_faces(2, segments), normals, _grid_uv(np.array([0.0, 1.0]), segments))
    caps = [_disc(radius_m, z, sign, segments) for z, sign in ((half, 1.0), (-half, -1.0))]
    return _joined("cylinder", [wall, *caps])


def cone_mesh(radius_m: float, length_m: float, *, segments: int = SEGMENTS) -> MeshPart:
    """Return a cone about z, apex up, centred on half its height."""
    half = length_m / 2
    side = _revolved(np.array([radius_m, 0.0]), np.array([-half, half]), segments)
    angle = _angles(segments)
    slope = np.stack(
        [length_m * np.cos(angle), length_m * np.sin(angle), np.full(len(angle), radius_m)], axis=1
    )
    normals = np.tile(slope / math.hypot(length_m, radius_m), (2, 1))
    wall = (side, _grid_faces(2, segments), normals, _grid_uv(np.array([0.0, 1.0]), segments))
    return _joined("cone", [wall, _disc(radius_m, -half, -1.0, segments)])


def capsule_mesh(radius_m: float, length_m: float, *, segments: int = SEGMENTS) -> MeshPart:
    """Return a capsule about z; `length_m` is the cylindrical part's."""
    quarter = np.linspace(0.0, math.pi / 2, segments // 4 + 1)
    latitudes = np.concatenate([quarter - math.pi / 2, quarter])
    shift = np.where(np.arange(len(latitudes)) <= segments // 4, -0.5, 0.5) * length_m
    normals = _revolved(np.cos(latitudes), np.sin(latitudes), segments)
    height = radius_m * np.sin(latitudes) + shift
    vertices = _revolved(radius_m * np.cos(latitudes), height, segments)
    v = (height - height[0]) / (height[-1] - height[0])
    return _part("capsule", vertices, _grid_faces(len(v), segments), normals, _grid_uv(v, segments))


def _along(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.stack([corners[:, 0] + corners[:, 1], corners[:, 2]], axis=1)


def _wall(ring: NDArray[np.float64], height: float) -> NDArray[np.float64]:
    after = np.roll(ring, -1, axis=0)
    zero, top = np.zeros((len(ring), 1)), np.full((len(ring), 1), height)
    a, b = np.concatenate([ring, zero], axis=1), np.concatenate([after, zero], axis=1)
    c, d = np.concatenate([after, top], axis=1), np.concatenate([ring, top], axis=1)
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def _slopes(
    z: NDArray[np.float64], x: NDArray[np.float64], y: NDArray[np.float64]
) -> NDArray[np.float64]:
    dz_dy = np.gradient(z, y[:, 0], axis=0)
    dz_dx = np.gradient(z, x[0], axis=1)
    normals = np.stack([-dz_dx, -dz_dy, np.ones_like(z)], axis=-1).reshape(-1, 3)
    unit: NDArray[np.float64] = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    return unit


def _angles(segments: int) -> Array:
    # The seam has two columns of vertices: one with u = 0, one with u = 1.
    return np.linspace(0.0, 2 * math.pi, segments + 1)


def _revolved(radius: Array, height: Array, segments: int) -> Array:
    """Rings of vertices about z, bottom to top, (rings · (segments + 1), 3)."""
    angle = _angles(segments)
    x = np.outer(radius, np.cos(angle))
    y = np.outer(radius, np.sin(angle))
    z = np.repeat(height[:, None], len(angle), axis=1)
    return np.stack([x, y, z], axis=-1).reshape(-1, 3)


def _grid_faces(rings: int, segments: int) -> NDArray[np.intp]:
    ring, column = np.mgrid[0 : rings - 1, 0:segments]
    a = (ring * (segments + 1) + column).ravel()
    b, c, d = a + 1, a + segments + 2, a + segments + 1
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def _grid_uv(v: Array, segments: int) -> Array:
    u = np.linspace(0.0, 1.0, segments + 1)
    return np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 2)


def _disc(radius: float, z: float, sign: float, segments: int) -> Piece:
    angle = _angles(segments)[:-1]
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    flat = np.concatenate([np.zeros((1, 2)), ring])
    vertices = np.concatenate([flat * radius, np.full((len(flat), 1), z)], axis=1)
    index = np.arange(segments)
    faces = np.stack([np.zeros_like(index), 1 + index, 1 + (index + 1) % segments], axis=1)
    if sign < 0:
        faces = faces[:, ::-1]
    normals = np.tile([0.0, 0.0, sign], (len(flat), 1))
    return vertices, faces, normals, (flat * (sign, 1.0) + 1) / 2


def _joined(name: str, pieces: list[Piece]) -> MeshPart:
    starts = np.cumsum([0, *(len(piece[0]) for piece in pieces[:-1])])
    faces = np.concatenate([piece[1] + start for piece, start in zip(pieces, starts, strict=True)])
    vertices, normals, uv = (np.concatenate([piece[i] for piece in pieces]) for i in (0, 2, 3))
    return _part(name, vertices, faces, normals, uv)


def _part(
    name: str, vertices: Array, faces: NDArray[np.intp], normals: Array, uv: Array
) -> MeshPart:
    corners = vertices[faces]
    # Poles and apexes are rings of radius 0: half of the triangles there have no area.
    area = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    kept = faces[area > 1e-12 * max(float(area.max(initial=0.0)), 1e-300)]
    return MeshPart(name, np.ascontiguousarray(vertices), kept.astype(np.int32), normals, uv)
