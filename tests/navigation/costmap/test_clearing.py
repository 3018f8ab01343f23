"""A robot beside an obstacle does not stand in it: its outline's own cells are cleared."""

from __future__ import annotations

import numpy as np
import pytest

from gazelle.navigation.costmap import (
    CostmapOptions,
    Footprint,
    LayeredCostmap,
    Observation,
    ObstacleLayer,
    ObstacleOptions,
    SourceOptions,
    footprint_cost,
)

_OUTLINE = Footprint(((-0.115, -0.115), (-0.115, 0.115), (0.051, 0.115), (0.051, -0.115)))


@pytest.mark.parametrize("yaw", np.linspace(0, 6, 13))
def test_outline_is_free_after_clearing(yaw: float) -> None:
    options = CostmapOptions(width=2.0, height=2.0, resolution=0.05)
    layer = ObstacleLayer(ObstacleOptions(), {"scan": SourceOptions()})
    costmap = LayeredCostmap(options, [layer], _OUTLINE)
    pose = (1.013, 0.987, float(yaw))
    # Obstacles on the outline, where the robot cannot be if it is there.
    points = np.column_stack([_OUTLINE.at(pose), np.full(4, 0.1)])
    costmap.observe("scan", Observation(0, (1.0, 1.0, 0.1), points))
    costmap.update(pose, 0)
    assert footprint_cost(costmap.grid, _OUTLINE, pose) == 0
