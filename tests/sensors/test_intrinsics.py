"""Pinhole parameters under both conventions."""

from __future__ import annotations

import pytest

from gazelle.description.model import CameraSpec
from gazelle.sensors import camera_intrinsics

SLAMBOT = CameraSpec(width_px=640, height_px=480, horizontal_fov_rad=1.05)


def test_focal_length_follows_from_width_and_view() -> None:
    lens = camera_intrinsics(SLAMBOT)
    assert lens.fx == lens.fy == pytest.approx(552.4670324537112, abs=1e-9)


def test_rendering_and_camera_info_differ_by_a_pixel() -> None:
    drawn = camera_intrinsics(SLAMBOT)
    told = camera_intrinsics(SLAMBOT, convention="camera_info")
    assert (drawn.cx, drawn.cy) == (319.5, 239.5)
    assert (told.cx, told.cy) == (320.5, 240.5)


def test_given_intrinsics_are_used() -> None:
    spec = CameraSpec(width_px=640, height_px=480, intrinsics=(500.0, 510.0, 300.0, 250.0, 0.5))
    told = camera_intrinsics(spec, convention="camera_info")
    assert (told.fx, told.fy, told.cx, told.cy, told.skew) == (500, 510, 300, 250, 0.5)
    drawn = camera_intrinsics(spec)
    assert (drawn.cx, drawn.cy) == (299.5, 249.5)
