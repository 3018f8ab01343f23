"""What a scan means."""

from __future__ import annotations

import math

import numpy as np

from gazelle.mapping.laser_scan import Scan


def _scan(ranges: list[float], **options: object) -> Scan:
    values = np.array(ranges, dtype=np.float32)
    return Scan(0, -math.pi / 2, math.pi / 2, values, 0.1, 10.0, **options)  # type: ignore[arg-type]


def test_beams_end_where_they_point() -> None:
    points = _scan([1.0, 2.0, 3.0]).points()
    np.testing.assert_allclose(points, [(0, -1), (2, 0), (0, 3)], atol=1e-6)


def test_infinite_short_and_missing_ranges_meet_nothing() -> None:
    scan = _scan([math.inf, math.nan, 0.05])
    assert not scan.hits().any()
    assert scan.points().shape == (0, 2)


def test_a_lidar_that_hangs_upside_down_sees_left_as_right() -> None:
    points = _scan([1.0, 2.0, 3.0], upside_down=True).points()
    np.testing.assert_allclose(points, [(0, 1), (2, 0), (0, -3)], atol=1e-6)


def test_the_mounting_of_the_lidar_moves_its_points() -> None:
    points = _scan([1.0, 2.0, 3.0], T_base_laser=(0.5, 0.0, math.pi / 2)).points()
    np.testing.assert_allclose(points, [(1.5, 0), (0.5, 2), (-2.5, 0)], atol=1e-6)


def test_bearings_are_directions_in_the_robots_frame() -> None:
    scan = _scan([1.0, 1.0, 1.0], T_base_laser=(0.0, 0.0, 0.3), upside_down=True)
    np.testing.assert_allclose(scan.bearings_rad, [0.3 + math.pi / 2, 0.3, 0.3 - math.pi / 2])
