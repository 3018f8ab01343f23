"""Occupancy grids of Gazebo models: what a lidar at one height can meet."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Cylinder, MeshShape
from gazelle.description.sdf_reader.document import read_model_file
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import load_mesh
from gazelle.mapping.grids import OccupancyGrid
from gazelle.workspace import Workspace

_MARGIN_M = 0.5


def rasterise(
    model_file: Path, workspace: Workspace, *, height_m: float, resolution_m: float = 0.05
) -> OccupancyGrid:
    """Return the grid of a model's cylinders and meshes; the inside of meshes stays free."""
    model = read_model_file(model_file, workspace=workspace, diagnostics=Diagnostics())
    assert model is not None
    dots = np.concatenate(list(_outlines(model, height_m, resolution_m / 4)))
    low, high = dots.min(axis=0) - _MARGIN_M, dots.max(axis=0) + _MARGIN_M
    low = np.floor(low / resolution_m) * resolution_m
    shape = np.ceil((high - low) / resolution_m).astype(int)
    cells = np.zeros((shape[1], shape[0]), np.int8)
    columns, rows = np.floor((dots - low) / resolution_m).astype(int).T
    cells[rows, columns] = 100
    return OccupancyGrid(cells, resolution_m, (float(low[0]), float(low[1]), 0.0))


def _outlines(model, height_m: float, step_m: float) -> Iterator[NDArray[np.float64]]:
    """Yield points on the outline of each collision at a height."""
    for link in model.links:
        for collision in link.collisions:
            pose = model.T_world_model @ link.T_model_link @ collision.T_link_collision
            shape = collision.shape
            if isinstance(shape, Cylinder):
                angles = np.arange(0.0, 2 * np.pi, step_m / shape.radius_m)
                ring = shape.radius_m * np.column_stack([np.cos(angles), np.sin(angles)])
                yield ring + np.array(pose.position_m[:2])
            elif isinstance(shape, MeshShape):
                mesh = load_mesh(shape.path, smooth=False).scaled(shape.scale)
                corners = pose.transform(mesh.vertices_m)[mesh.faces]
                yield from _cuts(corners, height_m, step_m)


def _cuts(
    triangles: NDArray[np.float64], height_m: float, step_m: float
) -> Iterator[NDArray[np.float64]]:
    """Yield points where triangles cross a height."""
    for corners in triangles:
        above = corners[:, 2] > height_m
        if above.all() or not above.any():
            continue
        ends = []
        for a, b in ((0, 1), (1, 2), (2, 0)):
            if above[a] != above[b]:
                share = (height_m - corners[a, 2]) / (corners[b, 2] - corners[a, 2])
                ends.append(corners[a, :2] + share * (corners[b, :2] - corners[a, :2]))
        count = max(int(np.hypot(*(ends[1] - ends[0])) / step_m), 1)
        yield ends[0] + (ends[1] - ends[0]) * (np.arange(count + 1) / count)[:, None]
