"""Where a map begins."""

from __future__ import annotations

import math

import numpy as np

from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.slam import Slam


def test_the_first_scan_is_where_it_is_said_to_be() -> None:
    ranges = np.full(90, 2.0, np.float32)
    scan = Scan(0, 0.0, math.tau / 90, ranges, 0.1, 3.5)
    said = (-2.0, -0.5, 0.3)
    slam = Slam()
    slam.begin(said)
    np.testing.assert_allclose(slam.add(scan, said).pose, said)
    np.testing.assert_allclose(slam.trajectory(), [said])
    grid = slam.grid()
    column, row = grid.world_to_cell(-2.0, -0.5)
    assert grid.cells[row, column] == 0
    rows, columns = np.nonzero(grid.cells == 100)
    x, y = grid.cell_to_world(columns, rows)
    np.testing.assert_allclose(np.hypot(x + 2.0, y + 0.5), 2.0, atol=0.1)
