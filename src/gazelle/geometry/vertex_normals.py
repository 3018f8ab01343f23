"""Triangle soup to shared vertices, and normals that are smooth up to a crease angle."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "CREASE_ANGLE_RAD",
    "face_normals",
    "group_points",
    "group_rows",
    "rounded_normals",
    "smooth_corners",
    "unit_rows",
]

CREASE_ANGLE_RAD = math.radians(35.0)
"""Faces that meet at a smaller angle are shaded as one curved surface."""
_WELD_SHARE = 1e-7
_MAX_NEIGHBOURS = 256
_NORMAL_STEPS = 1 << 14


def group_rows(rows: NDArray[np.float64]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Group equal rows.

    Args:
        rows: (N, K) values, compared exactly (−0 equals 0).

    Returns:
        index of one row of each group, (G,); group of each row, (N,). Groups are in no order
        that has a meaning, but the same input gives the same groups.
    """
    bits = np.ascontiguousarray(rows + 0.0).view(np.uint64)
    key = np.zeros(len(rows), np.uint64)
    with np.errstate(over="ignore"):
        for column in bits.T:
            # FNV-like mixing; the check below makes a collision harmless.
            key = (key ^ column) * np.uint64(0x9E3779B97F4A7C15)
            key ^= key >> np.uint64(29)
    _, first, group = np.unique(key, return_index=True, return_inverse=True)
    if not np.array_equal(bits[first[group]], bits):
        _, first, group = np.unique(bits, axis=0, return_index=True, return_inverse=True)
        group = group.reshape(-1)
    return first, group


def group_points(points_m: NDArray[np.float64]) -> NDArray[np.intp]:
    """Return the group of each point; points closer than float32 can tell apart are one.

    Exporters compute the same corner twice and get 0 once and 5e-18 the other time.

    Args:
        points_m: (N, 3), finite.
    """
    extent = float(np.ptp(points_m, axis=0).max(initial=0.0)) if len(points_m) else 0.0
    cell = _WELD_SHARE * extent or 1.0
    return group_rows(np.round(points_m / cell))[1]


def face_normals(corners_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return normals whose length is twice the area, (M, 3), of triangles (M, 3, 3)."""
    edge1 = corners_m[:, 1] - corners_m[:, 0]
    edge2 = corners_m[:, 2] - corners_m[:, 0]
    return np.cross(edge1, edge2)


def smooth_corners(
    corners_m: NDArray[np.float64], vertex_of_corner: NDArray[np.intp]
) -> NDArray[np.float64]:
    """Return a unit normal for each corner, (3 M, 3).

    A corner's normal is the mean of the faces around its vertex that differ from its own face by
    less than `CREASE_ANGLE_RAD`; flat faces stay flat, edges stay sharp. Faces weigh as much as
    the angle they fill at the vertex, so that it does not matter how a flat side is cut into
    triangles (Thürmer and Wüthrich 1998).

    Args:
        corners_m: (M, 3, 3) triangles.
        vertex_of_corner: (3 M,) which corners share a vertex.
    """
    unit = np.repeat(unit_rows(face_normals(corners_m)), 3, axis=0)
    weighted = unit * _corner_angles(corners_m)[:, None]
    order = np.argsort(vertex_of_corner, kind="stable")
    vertex, weight, direction = vertex_of_corner[order], weighted[order], unit[order]
    total = weight.copy()
    first = np.arange(len(order))
    for shift in range(1, _MAX_NEIGHBOURS):
        first = first[first < len(order) - shift]
        first = first[vertex[first] == vertex[first + shift]]
        if not len(first):
            break
        second = first + shift
        cosine = np.einsum("ij,ij->i", direction[first], direction[second])
        near = cosine > math.cos(CREASE_ANGLE_RAD)
        # Within one shift no corner stands twice on the same side: plain indexing adds right.
        total[first[near]] += weight[second[near]]
        total[second[near]] += weight[first[near]]
    normals = np.empty_like(total)
    normals[order] = total
    return unit_rows(normals)


def rounded_normals(normals: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return normals, (n, 3), rounded so that sums of the same faces in any order are equal."""
    return np.round(normals * _NORMAL_STEPS)


def unit_rows(rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return rows of shape (N, 3) with length 1; zero rows become +z."""
    lengths = np.sqrt(np.einsum("ij,ij->i", rows, rows))
    unit: NDArray[np.float64] = rows / np.where(lengths > 0, lengths, 1.0)[:, None]
    unit[lengths == 0] = (0.0, 0.0, 1.0)
    return unit


def _corner_angles(corners_m: NDArray[np.float64]) -> NDArray[np.float64]:
    after = unit_rows((np.roll(corners_m, -1, axis=1) - corners_m).reshape(-1, 3))
    before = unit_rows((np.roll(corners_m, 1, axis=1) - corners_m).reshape(-1, 3))
    angles: NDArray[np.float64] = np.arccos(np.clip(np.einsum("ij,ij->i", after, before), -1, 1))
    return angles
