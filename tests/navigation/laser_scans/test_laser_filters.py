"""Every filter does what its name says."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from gazelle.navigation.laser_scans import (
    FILTERS,
    FilterSetup,
    ScanArrays,
    apply_chain,
)
from gazelle.navigation.laser_scans.laser_filters import BoundsOptions


def _scan(ranges: list[float], intensities: list[float] | None = None) -> ScanArrays:
    count = len(ranges)
    return ScanArrays(
        -0.1 * (count // 2), 0.1, np.array(ranges, float), np.array(intensities or [], float),
        0.1, 10.0,
    )  # fmt: skip


def _after(scan: ScanArrays, kind: str, **params: Any) -> list[float]:
    options = FILTERS[kind.rpartition("/")[2]].options(**params)
    chain = [FilterSetup("own", kind, options)]
    return list(apply_chain(scan, chain, lambda _frame, points: points).ranges_m)


def test_range_filter() -> None:
    limits = {"lower_threshold": 0.6, "upper_threshold": 4.0, "upper_replacement_value": math.inf}
    found = _after(_scan([0.5, 1.0, 5.0]), "laser_filters/LaserScanRangeFilter", **limits)
    np.testing.assert_array_equal(found, [math.nan, 1.0, math.inf])
    scan = _scan([0.05, 1.0, 11.0])
    own = _after(scan, "LaserScanRangeFilter", use_message_range_limits=True)
    np.testing.assert_array_equal(own, [math.nan, 1.0, math.nan])


def test_angular_bounds_cut_the_scan() -> None:
    options = BoundsOptions(lower_angle=-0.1, upper_angle=0.1)
    chain = [FilterSetup("a", "LaserScanAngularBoundsFilter", options)]
    scan = apply_chain(_scan([1, 2, 3, 4, 5], [9, 8, 7, 6, 5]), chain, lambda _f, p: p)
    assert list(scan.ranges_m) == [2, 3, 4]
    assert list(scan.intensities) == [8, 7, 6]
    assert scan.angle_min_rad == pytest.approx(-0.1)


def test_angular_bounds_in_place_push_beams_out_of_range() -> None:
    found = _after(_scan([1, 2, 3, 4, 5]), "LaserScanAngularBoundsFilterInPlace",
                   lower_angle=-0.15, upper_angle=0.05)  # fmt: skip
    assert found == [1, 11.0, 11.0, 4, 5]


def test_intensity_filter() -> None:
    scan = _scan([1, 2, 3], [10, 100, 1000])
    found = _after(scan, "LaserScanIntensityFilter", lower_threshold=50, upper_threshold=500)
    np.testing.assert_array_equal(found, [math.nan, 2, math.nan])
    inverted = _after(
        scan, "LaserScanIntensityFilter", lower_threshold=50, upper_threshold=500, invert=True
    )
    np.testing.assert_array_equal(inverted, [1, math.nan, 3])


def test_box_filter() -> None:
    box = {"box_frame": "base_link", "min_x": 0.5, "max_x": 1.5, "min_y": -0.5, "max_y": 0.5,
           "min_z": -0.1, "max_z": 0.1}  # fmt: skip
    np.testing.assert_array_equal(
        _after(_scan([2.0, 1.0, 2.0]), "LaserScanBoxFilter", **box), [2.0, math.nan, 2.0]
    )
    np.testing.assert_array_equal(
        _after(_scan([2.0, 1.0, 2.0]), "LaserScanBoxFilter", **box, invert=True),
        [math.nan, 1.0, math.nan],
    )


def test_shadows_behind_edges_are_taken_out() -> None:
    ranges = [1.0] * 6 + [1.6, 2.4] + [3.0] * 6
    scan = ScanArrays(0.0, 0.01, np.array(ranges), np.zeros(0), 0.1, 10.0)
    found = _after(scan, "ScanShadowsFilter", min_angle=10, max_angle=170, neighbors=1, window=1)
    assert np.isnan(found[6])
    assert not np.isnan(found[:5]).any()


def test_interpolation_fills_gaps() -> None:
    assert _after(_scan([1.0, math.nan, math.inf, 4.0]), "InterpolationFilter") == [1, 2, 3, 4]


def test_median_takes_out_single_peaks() -> None:
    assert _after(_scan([1, 1, 9, 1, 1]), "LaserMedianSpatialFilter", window_size=3) == [1] * 5


def test_speckles_are_taken_out() -> None:
    found = _after(_scan([5, 5, 1.0, 5, 5]), "LaserScanSpeckleFilter", max_range=2.0,
                   max_range_difference=0.1, filter_window=2)  # fmt: skip
    np.testing.assert_array_equal(found, [5, 5, math.nan, 5, 5])


def test_sector_filter() -> None:
    found = _after(_scan([1, 1, 1, 3, 1]), "LaserScanSectorFilter", angle_min=-0.05,
                   angle_max=0.15, range_min=0.0, range_max=2.0)  # fmt: skip
    assert found == [1, 1, 11.0, 3, 1]


def test_footprint_filter() -> None:
    found = _after(_scan([0.2, 0.2, 2.0]), "LaserScanFootprintFilter", inscribed_radius=0.3)
    np.testing.assert_array_equal(found, [math.nan, math.nan, 2.0])
