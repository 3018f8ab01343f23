"""The surface of a resting mesh as thin convex solids, for meshes one can be inside of."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry import Mesh
from gazelle.geometry.mesh import part_from_soup

__all__ = ["MIN_VOLUME_M3", "connected_parts", "surface_pieces"]

Array = NDArray[np.float64]
Faces = NDArray[np.int32]

MIN_VOLUME_M3 = 1e-13
"""Solids below it are left out, cubes of 50 µm: MuJoCo refuses hulls without volume."""

_THICKNESS_RATIO = 0.01
_MAX_THICKNESS_M = 0.02
_SAME_PLANE = 1e-4
_FULL_SHARE = 0.999


def connected_parts(mesh: Mesh) -> tuple[Mesh, ...]:
    """Return the parts of a mesh that do not share corners, in the order of the file."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    vertices, faces = np.asarray(mesh.vertices_m), np.asarray(mesh.faces)
    ids = _corner_ids(vertices[faces].reshape(-1, 3), float(np.ptp(vertices, axis=0).max()))
    triangles = ids.reshape(-1, 3)
    first, second = triangles[:, [0, 1]].ravel(), triangles[:, [1, 2]].ravel()
    size = int(ids.max()) + 1
    graph = coo_matrix((np.ones(len(first)), (first, second)), shape=(size, size))
    _, labels = connected_components(graph, directed=False)
    of_face = labels[triangles[:, 0]]
    parts = [
        part_from_soup(vertices[faces[of_face == label]], name="part")
        for label in dict.fromkeys(of_face.tolist())
    ]
    return tuple(Mesh((part,), mesh.file) for part in parts)


def _corner_ids(corners: Array, size: float) -> NDArray[np.intp]:
    """Number corners; those at one place get one number."""
    keys = np.round(corners / max(1e-6 * size, 1e-12)).astype(np.int64)
    return np.asarray(np.unique(keys, axis=0, return_inverse=True)[1]).ravel()


def surface_pieces(vertices_m: Array, faces: Faces) -> tuple[Array, ...]:
    """Return prisms that together cover a surface.

    Triangles of one plane that touch and together fill their outline's hull become one prism,
    every other triangle becomes its own. Prisms extend behind the surface, against its normals,
    by 1 % of the mesh's size, at most 2 cm.

    Args:
        vertices_m: (N, 3).
        faces: (M, 3), counter-clockwise seen from outside.
    """
    corners = vertices_m[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    doubled = np.linalg.norm(normals, axis=1)
    size = float(np.ptp(vertices_m, axis=0).max())
    thickness = min(_THICKNESS_RATIO * size, _MAX_THICKNESS_M)
    kept = doubled * thickness / 2 > MIN_VOLUME_M3
    if not kept.any():
        return ()
    corners, normals = corners[kept], normals[kept] / doubled[kept, None]
    pieces: list[Array] = []
    for group in _flat_groups(corners, normals, size):
        pieces.extend(_prisms(corners[group], normals[group[0]], thickness))
    return tuple(pieces)


def _flat_groups(corners: Array, normals: Array, size: float) -> list[NDArray[np.intp]]:
    """Group triangles that lie in one plane and hang together."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    count = len(corners)
    triangles = _corner_ids(corners.reshape(-1, 3), size).reshape(-1, 3)
    edges = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    same = np.flatnonzero((edges[order][1:] == edges[order][:-1]).all(axis=1))
    first, second = order[same] // 3, order[same + 1] // 3
    flat = np.einsum("ij,ij->i", normals[first], normals[second]) > 1 - _SAME_PLANE
    first, second = first[flat], second[flat]
    graph = coo_matrix((np.ones(len(first)), (first, second)), shape=(count, count))
    number, labels = connected_components(graph, directed=False)
    order = np.argsort(labels, kind="stable")
    return np.split(order, np.searchsorted(labels[order], np.arange(1, number)))


def _prisms(corners: Array, normal: Array, thickness: float) -> list[Array]:
    if len(corners) > 1 and _is_flat(corners, normal) and _fills_outline(corners, normal):
        return [_prism(np.unique(corners.reshape(-1, 3), axis=0), normal, thickness)]
    return [_prism(triangle, normal, thickness) for triangle in corners]


def _prism(points: Array, normal: Array, thickness: float) -> Array:
    return np.vstack([points, points - thickness * normal])


def _is_flat(corners: Array, normal: Array) -> bool:
    heights = corners.reshape(-1, 3) @ normal
    return bool(np.ptp(heights) <= 1e-3 * np.ptp(corners.reshape(-1, 3), axis=0).max())


def _fills_outline(corners: Array, normal: Array) -> bool:
    from scipy.spatial import ConvexHull

    edges = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = float(np.linalg.norm(edges, axis=1).sum()) / 2
    reference = np.eye(3)[int(np.argmin(np.abs(normal)))]
    x = np.cross(reference, normal)
    x /= np.linalg.norm(x)
    plane = np.stack([x, np.cross(normal, x)], axis=1)
    return area >= _FULL_SHARE * float(ConvexHull(corners.reshape(-1, 3) @ plane).volume)
