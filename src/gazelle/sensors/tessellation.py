"""Shapes as what rays meet: triangles, or exact spheres.

Round shapes lie within 0.00001 of their radius (512 sides, the corners as far outside as the
middles of the sides lie inside), spheres and ellipsoids are exact. Texture coordinates run as
Gazebo's do: u to the right, v up, 0 to 1 over each face.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["SIDES", "Facets", "unit_box", "unit_cone", "unit_cylinder", "unit_plane", "unit_tube"]

SIDES = 512
"""Sides of a cylinder: off by at most radius · (π / SIDES)² / 4 = 9.4e-6 · radius."""


@dataclass(frozen=True, slots=True, eq=False)
class Facets:
    """Triangles with what shading needs.

    Attributes:
        vertices: (N, 3) float32, metres.
        faces: (M, 3) int32.
        normals: (N, 3) float32, unit length.
        uv: (N, 2) float32.
    """

    vertices: NDArray[np.float32]
    faces: NDArray[np.int32]
    normals: NDArray[np.float32]
    uv: NDArray[np.float32]


def unit_plane() -> Facets:
    """A square of side 1 in the xy plane, facing +z."""
    corners = np.array([[-0.5, -0.5, 0], [0.5, -0.5, 0], [0.5, 0.5, 0], [-0.5, 0.5, 0]], np.float32)
    normals = np.tile(np.array([0, 0, 1], np.float32), (4, 1))
    faces = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    return Facets(corners, faces, normals, corners[:, :2] + np.float32(0.5))


def unit_box() -> Facets:
    """A cube of side 1 about the origin, each face with its own corners."""
    square = unit_plane()
    turns = []
    for axis in range(3):
        for sign in (1.0, -1.0):
            normal = np.zeros(3)
            normal[axis] = sign
            right = np.cross([0, 0, 1], normal) if axis < 2 else np.array([1.0, 0, 0])
            turns.append(np.stack([right, np.cross(normal, right), normal], axis=1))
    offset = np.array([0, 0, 0.5])
    vertices = np.concatenate([(square.vertices + offset) @ turn.T for turn in turns])
    normals = np.concatenate([square.normals @ turn.T for turn in turns])
    faces = np.concatenate([square.faces + 4 * face for face in range(6)])
    return _facets(vertices, faces, normals, np.tile(square.uv, (6, 1)))


def unit_tube() -> Facets:
    """The side of a cylinder of radius 1 and length 1 about z, without caps."""
    around = _circle(_balanced_radius())
    low, high = _at_height(around, -0.5), _at_height(around, 0.5)
    directions = _at_height(_circle(1.0), 0.0)
    turn = np.linspace(0, 1, SIDES + 1)
    uv = np.concatenate([np.stack([turn, np.full_like(turn, end)], axis=1) for end in (0.0, 1.0)])
    first = np.arange(SIDES)
    above = first + SIDES + 1
    faces = np.concatenate(
        [np.stack([first, first + 1, above], 1), np.stack([first + 1, above + 1, above], 1)]
    )
    return _facets(np.concatenate([low, high]), faces, np.concatenate([directions] * 2), uv)


def unit_cylinder() -> Facets:
    """A closed cylinder of radius 1 and length 1 about z."""
    return _joined([unit_tube(), _disc(0.5), _disc(-0.5)])


def unit_cone() -> Facets:
    """A closed cone of radius 1 at z = -0.5 with its apex at z = 0.5."""
    rim = _at_height(_circle(_balanced_radius()), -0.5)
    apex = np.tile(np.array([0, 0, 0.5]), (SIDES, 1))
    outward = _at_height(_circle(1.0), 1.0) / math.sqrt(2.0)
    turn = np.linspace(0, 1, SIDES + 1)
    uv = np.concatenate(
        [np.stack([turn, np.zeros_like(turn)], 1), np.stack([turn[:-1], np.ones(SIDES)], 1)]
    )
    first = np.arange(SIDES)
    faces = np.stack([first, first + 1, first + SIDES + 1], 1)
    side = _facets(np.concatenate([rim, apex]), faces, np.concatenate([outward, outward[:-1]]), uv)
    return _joined([side, _disc(-0.5)])


def _disc(height: float) -> Facets:
    """A cap: facing up at a positive height, down at a negative one."""
    facing = math.copysign(1.0, height)
    rim = _circle(_balanced_radius())[:-1]
    vertices = np.concatenate([[[0.0, 0.0, height]], _at_height(rim, height)])
    normals = np.tile([0.0, 0.0, facing], (len(vertices), 1))
    first = 1 + np.arange(SIDES)
    following = 1 + (np.arange(SIDES) + 1) % SIDES
    pair = (first, following) if facing > 0 else (following, first)
    faces = np.stack([np.zeros(SIDES, int), *pair], 1)
    return _facets(vertices, faces, normals, vertices[:, :2] / 2 + 0.5)


def _balanced_radius() -> float:
    """Radius of the corners that leaves the sides half inside, half outside the circle."""
    return 2.0 / (1.0 + math.cos(math.pi / SIDES))


def _circle(radius: float) -> NDArray[np.float64]:
    turn = np.linspace(0, 2 * math.pi, SIDES + 1)
    return radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)


def _at_height(around: NDArray[np.float64], height: float) -> NDArray[np.float64]:
    return np.concatenate([around, np.full((len(around), 1), height)], axis=1)


def _joined(parts: list[Facets]) -> Facets:
    starts = np.cumsum([0, *(len(part.vertices) for part in parts)])
    return _facets(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate([part.faces + start for part, start in zip(parts, starts, strict=False)]),
        np.concatenate([part.normals for part in parts]),
        np.concatenate([part.uv for part in parts]),
    )


def _facets(
    vertices: NDArray[np.floating],
    faces: NDArray[np.integer],
    normals: NDArray[np.floating],
    uv: NDArray[np.floating],
) -> Facets:
    return Facets(
        np.ascontiguousarray(vertices, np.float32),
        np.ascontiguousarray(faces, np.int32),
        np.ascontiguousarray(normals, np.float32),
        np.ascontiguousarray(uv, np.float32),
    )
