"""Making mesh parts from what file formats give: soups, or indexed corners."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry.mesh import MeshMaterial, MeshPart
from gazelle.geometry.shading import (
    face_normals,
    group_points,
    group_rows,
    rounded_normals,
    smooth_corners,
    unit_rows,
)

__all__ = ["part_from_corners", "part_from_soup"]


def part_from_soup(
    corners_m: NDArray[np.float64],
    *,
    name: str = "",
    material: MeshMaterial | None = None,
    smooth: bool = True,
) -> MeshPart:
    """Make a part of loose triangles (M, 3, 3): equal vertices shared, normals computed.

    Args:
        corners_m: the triangles.
        name: submesh name.
        material: or None.
        smooth: normals of a smooth surface with its edges; False gives each vertex the normal of
            one of its faces, which is soon done and not fit to be drawn.
    """
    flat = np.ascontiguousarray(corners_m, dtype=np.float64).reshape(-1, 3)
    if smooth:
        return part_from_corners(flat, group_points(flat), name=name, material=material)
    vertex_of_corner = group_points(flat)
    first = np.zeros(int(vertex_of_corner.max(initial=0)) + 1, np.intp)
    first[vertex_of_corner[::-1]] = np.arange(len(flat))[::-1]
    normals = unit_rows(face_normals(flat.reshape(-1, 3, 3)))
    return MeshPart(
        name=name,
        vertices_m=np.ascontiguousarray(flat[first]),
        faces=vertex_of_corner.reshape(-1, 3).astype(np.int32),
        normals=np.ascontiguousarray(normals[first // 3]),
        material=material,
    )


def part_from_corners(
    positions_m: NDArray[np.float64],
    vertex_of_corner: NDArray[np.intp],
    *,
    normals: NDArray[np.float64] | None = None,
    uv: NDArray[np.float64] | None = None,
    name: str = "",
    material: MeshMaterial | None = None,
) -> MeshPart:
    """Make a part of triangle corners, merging those alike in vertex, normal and uv.

    Args:
        positions_m: (3 M, 3) position of each corner.
        vertex_of_corner: (3 M,) which corners share a position.
        normals: (3 M, 3) unit normal of each corner; computed when None.
        uv: (3 M, 2) or None.
        name: submesh name.
        material: or None.
    """
    # Corners that share a vertex must lie at the very same place, or the surface has cracks.
    index = np.arange(len(vertex_of_corner))
    first_corner = np.zeros(int(vertex_of_corner.max(initial=0)) + 1, np.intp)
    first_corner[vertex_of_corner[::-1]] = index[::-1]
    positions_m = positions_m[first_corner[vertex_of_corner]]
    if normals is None:
        normals = smooth_corners(positions_m.reshape(-1, 3, 3), vertex_of_corner)
    columns = [vertex_of_corner[:, None].astype(np.float64), rounded_normals(normals)]
    if uv is not None:
        columns.append(uv)
    first, group = group_rows(np.concatenate(columns, axis=1))
    return MeshPart(
        name=name,
        vertices_m=np.ascontiguousarray(positions_m[first]),
        faces=group.reshape(-1, 3).astype(np.int32),
        normals=np.ascontiguousarray(normals[first]),
        uv=None if uv is None else np.ascontiguousarray(uv[first]),
        material=material,
    )
