"""Where what is free meets what is unknown."""

from __future__ import annotations

import numpy as np
import pytest

from gazelle.mapping.frontiers import find_frontiers
from gazelle.mapping.grids import OccupancyGrid


def _grid(text: str, resolution_m: float = 0.5) -> OccupancyGrid:
    """A picture, upper row first: # wall, . free, blank unknown."""
    values = {"#": 100, ".": 0, "?": -1}
    rows = [[values[sign] for sign in line] for line in text.split()]
    return OccupancyGrid(np.array(rows[::-1], dtype=np.int8), resolution_m)


ROOM = """
#######????
#.....#????
#.....?????
#.....?????
#.....#????
#######????
"""


def test_an_open_door_is_the_frontier_of_a_room() -> None:
    (found,) = find_frontiers(_grid(ROOM), (1.5, 1.5))
    assert found.size_m == 1.0
    assert found.centroid_m == pytest.approx((3.25, 1.5))
    assert found.distance_m == pytest.approx(1.77, abs=0.1)


def test_a_closed_room_has_no_frontier() -> None:
    assert not find_frontiers(_grid(ROOM.replace("?", "#")), (1.5, 1.5))


def test_frontiers_behind_walls_are_not_reached() -> None:
    both = "##########\n#...##...?\n#...##...?\n##########"
    assert not find_frontiers(_grid(both), (1.0, 1.0))
    assert find_frontiers(_grid(both), (4.0, 1.0))


def test_small_pieces_are_left_out() -> None:
    assert not find_frontiers(_grid(ROOM), (1.5, 1.5), least_size_m=1.5)


def test_large_near_frontiers_come_first() -> None:
    wide = "?????#####\n.........?\n##########"
    first, *_ = find_frontiers(_grid(wide), (1.0, 0.75))
    assert first.size_m == 2.5
    near = find_frontiers(_grid(wide), (4.0, 0.75), gain_scale=0.0, potential_scale=1.0)
    assert near[0].size_m == 0.5


def test_an_unknown_map_has_no_frontier() -> None:
    assert not find_frontiers(_grid("????\n????"), (1.0, 0.5))
