"""Positions of large clouds in 16 bits an axis."""

from __future__ import annotations

import numpy as np
import pytest

from gazelle.studio.displays.points import pack


@pytest.mark.parametrize("extent_m", [0.5, 20.0, 130.0])
def test_packed_points_are_within_half_a_level_of_the_measured_ones(extent_m: float) -> None:
    xyz = np.random.default_rng(3).uniform(-0.5, 0.5, (5000, 3)).astype(np.float32) * extent_m
    packed = pack(xyz)
    assert packed is not None
    again = packed.origin_m + packed.step_m * packed.levels
    assert np.abs(again - xyz).max() <= extent_m / 65_535 * 0.6 + 1e-5
    assert packed.levels.max() == 65_535
    assert packed.levels.min() == 0


def test_flat_cloud_keeps_its_plane() -> None:
    xyz = np.random.default_rng(3).uniform(-1, 1, (5000, 3)).astype(np.float32)
    xyz[:, 2] = 0.75
    packed = pack(xyz)
    assert packed is not None
    again = packed.origin_m + packed.step_m * packed.levels
    assert np.allclose(again[:, 2], 0.75, atol=2e-5)


@pytest.mark.parametrize(("count", "extent_m"), [(100, 1.0), (5000, 200.0)])
def test_small_and_wide_clouds_are_sent_as_they_are(count: int, extent_m: float) -> None:
    xyz = np.random.default_rng(3).uniform(-0.5, 0.5, (count, 3)).astype(np.float32) * extent_m
    assert pack(xyz) is None


def test_cloud_of_one_place_is_that_place() -> None:
    packed = pack(np.full((5000, 3), 0.25, np.float32))
    assert packed is not None
    assert np.allclose(packed.origin_m + packed.step_m * packed.levels, 0.25)
