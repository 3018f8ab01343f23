"""Triangles of heightmaps and extruded outlines."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry.mesh import MeshPart, part_from_corners, part_from_soup
from gazelle.geometry.polygon_triangulation import triangulate
from gazelle.geometry.vertex_normals import group_points

__all__ = ["heightmap_mesh", "polyline_mesh"]

Vector3 = tuple[float, float, float]
Outline = Sequence[tuple[float, float]]


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
