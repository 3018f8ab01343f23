"""A robot that sees nothing it knows."""

from __future__ import annotations

import math

import numpy as np

from gazelle.mapping.scans import Scan
from gazelle.mapping.slam import Slam


def _scan(ranges_m: np.ndarray) -> Scan:
    return Scan(0, 0.0, math.tau / 90, np.asarray(ranges_m, np.float32), 0.1, 30.0)


def test_a_lost_robot_goes_on_by_odometry_where_nothing_is_alike() -> None:
    scattered = np.random.default_rng(1)
    slam = Slam()
    slam.begin((0.0, 0.0, 0.0))
    slam.add(_scan(np.full(90, 2.0)), (0.0, 0.0, 0.0))
    for step in range(6):
        ranges_m = np.full(90, np.inf)
        ranges_m[scattered.integers(0, 90, 40)] = scattered.uniform(4, 25, 40)
        odometry = 0.5 * (step + 1), 0.0, 0.0
        found = slam.add(_scan(ranges_m), odometry)
    assert found is not None
    np.testing.assert_allclose(found.pose[:2], odometry[:2], atol=0.5)
