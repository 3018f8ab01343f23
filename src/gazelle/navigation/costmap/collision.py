"""Whether a robot fits somewhere."""

from __future__ import annotations

import math

from gazelle.navigation.costmap.footprint import Footprint
from gazelle.navigation.costmap.grid import CostGrid

__all__ = ["footprint_cost"]


def footprint_cost(grid: CostGrid, footprint: Footprint, pose: tuple[float, float, float]) -> int:
    """Return the highest cost under a robot's centre and outline.

    Returns:
        0 … 253 where it fits; −1 when an obstacle is in the way, −2 when it stands on what is
        unknown, −3 when it is outside the grid, as ``CostmapModel::footprintCost``.
    """
    from gazelle.navigation.costmap.kernels import outline_cost

    x, y, yaw = pose
    return int(
        outline_cost(
            grid.cells, footprint.points, float(x), float(y), math.cos(yaw), math.sin(yaw), 1.0
        )
    )
