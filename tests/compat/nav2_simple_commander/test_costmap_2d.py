"""nav2_simple_commander's costmap, lines and footprints."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from gazelle.compat.nav2_simple_commander.costmap_2d import (
    FootprintCollisionChecker,
    LineIterator,
    PyCostmap2D,
)
from gazelle.interfaces import message_type


def _costmap() -> PyCostmap2D:
    """Ten by eight cells of half a metre; the corner is at (-1, -2)."""
    message = message_type("nav2_msgs/Costmap")()
    message.header.frame_id = "map"
    message.metadata.size_x, message.metadata.size_y = 10, 8
    message.metadata.resolution = 0.5
    message.metadata.origin.position.x, message.metadata.origin.position.y = -1.0, -2.0
    message.data = [0] * 80
    return PyCostmap2D(message)


def _square(half_m: float) -> Any:
    polygon = message_type("geometry_msgs/Polygon")()
    for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        polygon.points.append(message_type("geometry_msgs/Point32")(x=x * half_m, y=y * half_m))
    return polygon


def test_costmaps_have_cells_and_places() -> None:
    costmap = _costmap()
    assert (costmap.getSizeInCellsX(), costmap.getSizeInMetersY()) == (10, 4.0)
    assert (costmap.getOriginX(), costmap.getResolution()) == (-1.0, 0.5)
    assert costmap.getGlobalFrameID() == "map"
    costmap.setCost(3, 2, 99)
    assert costmap.getCostXY(3, 2) == costmap.getCostIdx(23) == 99
    assert costmap.mapToWorld(3, 2) == (0.75, -0.75)
    assert costmap.worldToMapValidated(0.75, -0.75) == (3, 2)
    assert costmap.worldToMapValidated(-1.1, 0.0) == (None, None)
    assert costmap.worldToMapValidated(0.0, 2.1) == (None, None)
    assert costmap.worldToMap(-1.1, 0.0) == (-1, 4)


@pytest.mark.parametrize(
    ("ends", "points"),
    [
        ((0, 0, 2, 1), [(0, 0), (1, 0.5), (2, 1)]),
        ((2, 1, 0, 0), [(2, 1), (1, 0.5), (0, 0)]),
        ((1, 3, 1, 1), [(1, 3), (1, 2), (1, 1)]),
        ((0, 5, 1.5, 5), [(0, 5), (1, 5), (1.5, 5)]),
    ],
)
def test_lines_lead_from_end_to_end(ends: Any, points: Any) -> None:
    line, found = LineIterator(*ends), []
    while line.isValid():
        found.append((line.getX(), line.getY()))
        line.advance()
    assert found == points
    assert line.get_line_length() == math.hypot(ends[2] - ends[0], ends[3] - ends[1])


def test_lines_that_are_none_are_refused() -> None:
    with pytest.raises(TypeError, match=r"y0 must be a number \(int or float\)"):
        LineIterator(0, "1", 2, 3)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="step_size must be a positive number"):
        LineIterator(0, 0, 1, 1, 0)
    with pytest.raises(ValueError, match="Line has zero length"):
        LineIterator(1, 1, 1, 1)


def test_footprints_cost_the_most_of_their_edges() -> None:
    checker, costmap = FootprintCollisionChecker(), _costmap()
    with pytest.raises(ValueError, match="Costmap not specified, use setCostmap"):
        checker.pointCost(0, 0)
    checker.setCostmap(costmap)
    square = _square(0.6)
    assert checker.footprintCostAtPose(1.2, 0.0, 0.0, square) == 0.0
    costmap.setCost(*costmap.worldToMap(1.8, 0.1), 40)
    assert checker.footprintCostAtPose(1.2, 0.0, 0.0, square) == 40.0
    assert checker.footprintCostAtPose(1.2, 0.0, math.pi / 2, square) == 40.0
    costmap.setCost(*costmap.worldToMap(0.6, 0.1), 254)
    assert checker.footprintCostAtPose(1.2, 0.0, 0.0, square) == 254
    assert checker.footprintCostAtPose(3.9, 0.0, 0.0, square) == 254
    assert checker.footprintCost(_square(0.01)) == 0.0


def test_programs_use_them_by_the_original_names(passes: Callable[..., Any]) -> None:
    passes("""
import rclpy
from nav2_msgs.msg import Costmap
from nav2_simple_commander.costmap_2d import PyCostmap2D
from nav2_simple_commander.footprint_collision_checker import (
    FootprintCollisionChecker, LETHAL_OBSTACLE, NO_INFORMATION)
from nav2_simple_commander.line_iterator import LineIterator
assert (LETHAL_OBSTACLE, NO_INFORMATION) == (254, 255)
assert PyCostmap2D(Costmap()).getSizeInCellsX() == 0
""")
