"""Fewer triangles for a closed surface, by collapsing the edges that matter least."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["decimated"]

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

_MOST_ROUNDS = 100
_SHARE_A_ROUND = 0.4
# The pull to an edge's middle where the planes around it leave the place open.
_PULL = 1e-4
# Cosine between a triangle's normals before and after: beyond it the surface folds.
_LEAST_TURN = 0.3
# Triangles this much thinner than long have no direction to keep.
_SLIVER = 1e-3


class _Edges(NamedTuple):
    """The edges that two triangles share, and where each would collapse to at which cost."""

    ends: Indices
    place: Array
    cost: Array


def decimated(
    vertices_m: Array, faces: Indices, *, most_faces: int, tolerance_ratio: float
) -> tuple[Array, Indices]:
    """Return the surface with about as many triangles as asked, or more where it needs them.

    Edges collapse in rounds of those that do not touch, each to the point nearest to the planes
    of the triangles that met there (Garland and Heckbert's quadrics). Closed surfaces stay
    closed, and equal surfaces get equal results.

    Args:
        vertices_m: (N, 3), no two at one place.
        faces: (M, 3).
        most_faces: the aim.
        tolerance_ratio: no point leaves its planes by more than this share of the surface's size.
    """
    vertices, faces = np.array(vertices_m, np.float64), np.array(faces, np.intp)
    if len(faces) <= most_faces:
        return vertices, faces
    size = float(np.ptp(vertices, axis=0).max())
    quadrics = _quadrics(vertices, faces)
    refused = np.empty(0, np.intp)
    for _ in range(_MOST_ROUNDS):
        surplus = (len(faces) - most_faces + 1) // 2
        edges = _cheap_edges(vertices, faces, quadrics, (tolerance_ratio * size) ** 2, refused)
        if surplus <= 0 or not len(edges.cost):
            break
        apart = _apart(edges, faces, len(vertices))
        keeps = _keeps_surface(edges, apart, vertices, faces)
        refused = np.append(refused, _key(edges.ends[apart[~keeps]], len(vertices)))
        faces = _collapse(edges, apart[keeps][:surplus], vertices, quadrics, faces)
    used, faces = np.unique(faces, return_inverse=True)
    return vertices[used], faces.reshape(-1, 3)


def _collapse(
    edges: _Edges, chosen: Indices, vertices: Array, quadrics: Array, faces: Indices
) -> Indices:
    """Move the kept ends of edges in place, and return the triangles that are left."""
    kept, gone = edges.ends[chosen].T
    vertices[kept] = edges.place[chosen]
    quadrics[kept] += quadrics[gone]
    target = np.arange(len(vertices))
    target[gone] = kept
    faces = target[faces]
    whole: NDArray[np.bool_] = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    return faces[whole]


def _quadrics(vertices: Array, faces: Indices) -> Array:
    """The sum of squared distances to the planes at each vertex, as (N, 4, 4) matrices."""
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.divide(normals, length, out=np.zeros_like(normals), where=length > 0)
    planes = np.column_stack([normals, -np.einsum("ij,ij->i", normals, corners[:, 0])])
    squares = np.einsum("ij,ik->ijk", planes, planes)
    quadrics = np.zeros((len(vertices), 4, 4))
    for corner in range(3):
        np.add.at(quadrics, faces[:, corner], squares)
    return quadrics


def _cheap_edges(
    vertices: Array, faces: Indices, quadrics: Array, most_cost: float, refused: Indices
) -> _Edges:
    halves = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    ends, count = np.unique(halves, axis=0, return_counts=True)
    open_vertices = np.zeros(len(vertices), bool)
    open_vertices[ends[count != 2]] = True
    ends = ends[~open_vertices[ends].any(axis=1)]
    ends = ends[~np.isin(_key(ends, len(vertices)), refused)]
    both = quadrics[ends[:, 0]] + quadrics[ends[:, 1]]
    middle = vertices[ends].mean(axis=1)
    pull = _PULL * np.eye(3)
    place = np.linalg.solve(
        both[:, :3, :3] + pull, (middle @ pull - both[:, :3, 3])[..., None]
    ).reshape(-1, 3)
    point = np.column_stack([place, np.ones(len(place))])
    cost = np.einsum("ij,ijk,ik->i", point, both, point)
    if not len(cost):
        return _Edges(ends, place, cost)
    cheap = cost <= min(most_cost, float(np.quantile(cost, _SHARE_A_ROUND)))
    return _Edges(ends[cheap], place[cheap], cost[cheap])


def _key(ends: Indices, vertices: int) -> Indices:
    """Number edges, a collapsed vertex's number not being given again."""
    return ends[:, 0] * vertices + ends[:, 1]


def _apart(edges: _Edges, faces: Indices, vertices: int) -> Indices:
    """Return the edges that are cheaper than every other within one edge of their ends."""
    rank = np.empty(len(edges.cost), np.intp)
    rank[np.lexsort((edges.ends[:, 1], edges.ends[:, 0], edges.cost))] = np.arange(len(rank))
    least = np.full(vertices, len(rank))
    np.minimum.at(least, edges.ends, rank[:, None])
    around = least.copy()
    nearest = least[faces].min(axis=1)
    np.minimum.at(around, faces, nearest[:, None])
    return np.flatnonzero((around[edges.ends] == rank[:, None]).all(axis=1))


def _keeps_surface(
    edges: _Edges, chosen: Indices, vertices: Array, faces: Indices
) -> NDArray[np.bool_]:
    """Tell which collapses leave a closed surface of the same kind, and fold no triangle."""
    from scipy.sparse import csr_matrix

    size = len(vertices)
    start, stop = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    joined = csr_matrix((np.ones(len(start)), (start, stop)), shape=(size, size))
    joined = ((joined + joined.T) > 0).astype(np.int8)
    kept, gone = edges.ends[chosen].T
    common = np.asarray(joined[kept].multiply(joined[gone]).sum(axis=1)).ravel()
    moved_by = np.full(size, -1)
    moved_by[kept] = moved_by[gone] = np.arange(len(chosen))
    corners = moved_by[faces]
    moving = (corners >= 0).sum(axis=1) == 1
    owner = corners[moving].max(axis=1)
    before = vertices[faces[moving]]
    after = before.copy()
    at = corners[moving] >= 0
    after[at] = edges.place[chosen][owner]
    first, second = _normals(before), _normals(after)
    area, lengths = np.linalg.norm(first, axis=1), np.linalg.norm(second, axis=1)
    sliver = area <= _SLIVER * np.square(before - np.roll(before, 1, axis=1)).sum(axis=(1, 2))
    folds = ~sliver & (np.einsum("ij,ij->i", first, second) <= _LEAST_TURN * area * lengths)
    good: NDArray[np.bool_] = common == 2
    good[owner[folds]] = False
    return good


def _normals(corners: Array) -> Array:
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
