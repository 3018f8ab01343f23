"""The grid on the ground."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gazelle.sensors.view_cameras import camera_spec, looking_at
from gazelle.video.ground_grid import GroundGrid, grid_step_m

_SPEC = replace(camera_spec(101, 101), near_m=0.01, far_m=100.0)
_ABOVE = looking_at((0.25, 0.25, 3.0), (0.25, 0.25, 0.0))


def _drawn(depth_m: np.ndarray, grey: int = 160) -> np.ndarray:
    rgb = np.full((101, 101, 3), grey, np.uint8)
    GroundGrid(_SPEC, 0.5).draw(rgb, depth_m, _ABOVE)
    return rgb


def test_lines_are_where_they_are_in_the_world() -> None:
    rgb = _drawn(np.full((101, 101), 3.0, np.float32))
    # Straight down on x = y = 0.25: half a metre of lines is a quarter to each side of the middle.
    assert rgb[50, 50].tolist() == [160] * 3
    dark = np.flatnonzero(rgb[50, :, 0] < 150)
    pixels_per_m = 101 / (2 * 3.0 * np.tan(0.35))
    near = dark[np.abs(dark - 50) < 0.4 * pixels_per_m]
    assert np.abs(near - 50).mean() == pytest.approx(0.25 * pixels_per_m, abs=1.0)


def test_what_stands_on_the_ground_hides_lines_and_dark_grounds_get_light_ones() -> None:
    standing = _drawn(np.full((101, 101), 2.9, np.float32))
    assert (standing == 160).all()
    assert _drawn(np.full((101, 101), 3.0, np.float32), grey=20).max() > 30
    nothing = _drawn(np.full((101, 101), np.inf, np.float32))
    assert (nothing == 160).all()


def test_steps_are_round_numbers() -> None:
    assert [grid_step_m(one) for one in (0.5, 1.5, 4.0, 20.0)] == pytest.approx(
        [0.1, 0.2, 0.5, 5.0]
    )
