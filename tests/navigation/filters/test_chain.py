"""Every filter does what its name says."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from gazelle.errors import LaunchError
from gazelle.navigation.filters import (
    FILTERS,
    REFUSED_FILTERS,
    FilterSetup,
    ScanArrays,
    apply_chain,
)
from gazelle.nodes.filters.laser_filters import chain_of


def _scan(ranges: list[float], intensities: list[float] | None = None) -> ScanArrays:
    count = len(ranges)
    return ScanArrays(
        -0.1 * (count // 2), 0.1, np.array(ranges, float), np.array(intensities or [], float),
        0.1, 10.0,
    )  # fmt: skip


def _after(scan: ScanArrays, kind: str, **params: Any) -> list[float]:
    chain = [FilterSetup("own", kind, params)]
    return list(apply_chain(scan, chain, lambda _frame, points: points).ranges_m)


def test_range_filter() -> None:
    limits = {"lower_threshold": 0.6, "upper_threshold": 4.0, "upper_replacement_value": ".inf"}
    found = _after(_scan([0.5, 1.0, 5.0]), "laser_filters/LaserScanRangeFilter", **limits)
    np.testing.assert_array_equal(found, [math.nan, 1.0, math.inf])
    scan = _scan([0.05, 1.0, 11.0])
    own = _after(scan, "LaserScanRangeFilter", use_message_range_limits=True)
    np.testing.assert_array_equal(own, [math.nan, 1.0, math.nan])


def test_angular_bounds_cut_the_scan() -> None:
    chain = [FilterSetup("a", "LaserScanAngularBoundsFilter",
                         {"lower_angle": -0.1, "upper_angle": 0.1})]  # fmt: skip
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


def test_chains_of_both_generations_are_read() -> None:
    one = {"name": "r", "type": "laser_filters/LaserScanRangeFilter", "params": {"a": 1}}
    assert chain_of({"scan_filter_chain": [one]}) == chain_of({"filter1": one})
    assert [item.type for item in chain_of({"filter1": one, "filter2": one})] == [
        "LaserScanRangeFilter"
    ] * 2


def test_unknown_filters_are_told_all_at_once() -> None:
    bad = [{"name": "a", "type": "laser_filters/LaserScanRangFilter"},
           {"name": "b", "type": "LaserScanPolygonFilter"}, "no mapping"]  # fmt: skip
    with pytest.raises(LaunchError) as caught:
        chain_of({"scan_filter_chain": bad})
    text = str(caught.value)
    assert "did you mean 'LaserScanRangeFilter'" in text
    assert "LaserScanBoxFilter takes out beams by place" in text
    assert "filter 3 is 'no mapping'" in text
    assert not FILTERS.keys() & REFUSED_FILTERS.keys()


def test_a_parameter_that_is_no_number_is_told() -> None:
    with pytest.raises(ValueError, match="filter own: lower_threshold is 'near', not a number"):
        _after(_scan([1.0]), "LaserScanRangeFilter", lower_threshold="near")
