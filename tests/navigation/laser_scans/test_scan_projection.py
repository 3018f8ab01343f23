"""Scans of pictures and clouds."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.navigation.laser_scans import CloudSlice, scan_of_depth, scan_of_points

_CAMERA = {"fx": 50.0, "fy": 50.0, "cx": 39.5, "cy": 29.5}


def test_a_wall_before_the_camera_is_a_straight_line() -> None:
    scan = scan_of_depth(np.full((60, 80), 2.0), rows=5, **_CAMERA)
    angles = scan.angle_min_rad + scan.increment_rad * np.arange(80)
    ahead = scan.ranges_m * np.cos(angles)
    assert np.nanmax(np.abs(ahead - 2.0)) < 0.03
    assert scan.angle_max_rad == pytest.approx(math.atan2(39.5, 50.0))
    assert scan.angle_min_rad == pytest.approx(-math.atan2(39.5, 50.0))


def test_the_left_of_a_picture_is_the_end_of_the_scan() -> None:
    depth = np.full((60, 80), np.nan)
    depth[:, 2] = 1.0
    scan = scan_of_depth(depth, rows=1, **_CAMERA)
    (seen,) = np.nonzero(np.isfinite(scan.ranges_m))
    assert seen.min() > 70


def test_the_nearest_of_several_rows_counts() -> None:
    depth = np.full((60, 80), 3.0)
    depth[31] = 1.0
    one = scan_of_depth(depth, **_CAMERA, rows=1)
    several = scan_of_depth(depth, **_CAMERA, rows=6)
    assert np.nanmin(one.ranges_m) == pytest.approx(3.0, abs=0.01)
    assert np.nanmin(several.ranges_m) == pytest.approx(1.0, abs=0.01)


def test_what_is_no_depth_says_nothing() -> None:
    depth = np.array([[0.0, np.nan, np.inf, 0.1, 20.0, 1.0]])
    camera = {"fx": 5.0, "fy": 5.0, "cx": 2.5, "cy": 0.6}
    assert np.isfinite(scan_of_depth(depth, rows=1, **camera).ranges_m).sum() == 1


@pytest.mark.parametrize(
    ("rows", "camera", "says"),
    [
        (90, _CAMERA, r"scan_height \( 90 pixels\) is too large for the image height, 60"),
        (1, {**_CAMERA, "fx": 0.0}, "camera_info has no matrix K"),
    ],
)
def test_what_cannot_be_is_told(rows: int, camera: dict[str, float], says: str) -> None:
    with pytest.raises(ValueError, match=says):
        scan_of_depth(np.ones((60, 80)), **camera, rows=rows)


def test_clouds_are_cut_by_height_and_range() -> None:
    points = np.array(
        [[1.0, 0.0, 0.5], [0.8, 0.0, 2.0], [0.0, 2.0, 0.5], [0.0, -9.0, 0.5], [np.nan, 0, 0]]
    )
    scan = scan_of_points(points, CloudSlice(low_m=0.0, high_m=1.0, range_max_m=5.0))
    assert len(scan.ranges_m) == 360
    assert scan.ranges_m[180] == pytest.approx(1.0)
    assert scan.ranges_m[270] == pytest.approx(2.0)
    assert np.isfinite(scan.ranges_m).sum() == 2


def test_empty_directions_may_say_a_range() -> None:
    scan = scan_of_points(
        np.zeros((0, 3)), CloudSlice(angle_min_rad=-0.5, angle_max_rad=0.5, empty=6.0)
    )
    assert (scan.ranges_m == 6.0).all()
    with pytest.raises(ValueError, match="angle_increment must be above 0"):
        scan_of_points(np.zeros((0, 3)), CloudSlice(increment_rad=0.0))
