"""Depth pictures and clouds."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.description.model import Box, CameraSpec, Plane
from gazelle.geometry import Pose
from gazelle.sensors import POINT_DTYPE, camera_intrinsics, depth_image, point_cloud, render

CAMERA = CameraSpec(width_px=64, height_px=48, horizontal_fov_rad=1.05, near_m=0.05, far_m=8.0)
OPTICAL = Pose.from_xyz_rpy((0, 0, 0), (-math.pi / 2, 0, -math.pi / 2))
"""T_camera_optical (REP-103)."""


def test_depth_outside_the_limits_is_nan() -> None:
    depth = np.array([[0.3, 0.4, 0.41, 4.99, 5.0, np.inf]], np.float32)
    cut = depth_image(depth, near_m=0.4, far_m=5.0)
    assert cut.dtype == np.float32
    assert np.array_equal(np.isnan(cut), [[True, True, False, False, True, True]])
    assert cut[0, 2] == np.float32(0.41)


def test_points_have_the_layout_of_gazebo_ros() -> None:
    assert POINT_DTYPE.itemsize == 32
    offsets = {name: POINT_DTYPE.fields[name][1] for name in POINT_DTYPE.names}
    assert offsets == {"x": 0, "y": 4, "z": 8, "rgb": 16}


def test_cloud_lies_on_the_surfaces_within_a_millimetre(scene_of, link) -> None:
    ground = link("ground", Plane(size_m=(30.0, 30.0)))
    wall = link("wall", Box((0.2, 10.0, 4.0)), Pose((3.1, 0.0, 2.0)))
    T_world_camera = Pose.from_xyz_rpy((0.4, -0.3, 1.1), (0.05, 0.35, 0.2))
    depth = render(
        scene_of(ground, wall), CAMERA, T_world_camera, want_rgb=False, want_depth=True
    ).depth_m
    cloud = point_cloud(depth, None, camera_intrinsics(CAMERA))
    points = np.stack([cloud[name] for name in "xyz"], axis=-1).astype(float)
    world = (T_world_camera @ OPTICAL).transform(points.reshape(-1, 3))
    off = np.minimum(np.abs(world[:, 2]), np.abs(world[:, 0] - 3.0))
    assert np.isfinite(off).all()
    assert off.max() < 1e-3
    assert (np.abs(world[:, 2]) < 1e-3).sum() > 200
    assert (np.abs(world[:, 0] - 3.0) < 1e-3).sum() > 200


def test_cloud_is_the_depth_projected_back() -> None:
    depth = np.full((48, 64), 2.0, np.float32)
    lens = camera_intrinsics(CAMERA)
    cloud = point_cloud(depth, None, lens)
    assert cloud.shape == (48, 64)
    assert cloud["x"][10, 50] == pytest.approx((50 - 31.5) / lens.fx * 2.0, rel=1e-6)
    assert cloud["y"][10, 50] == pytest.approx((10 - 23.5) / lens.fy * 2.0, rel=1e-6)
    assert (cloud["z"] == 2.0).all()
    assert (cloud["rgb"] == 0.0).all()


def test_points_without_depth_are_nan_and_keep_their_colour() -> None:
    depth = np.array([[np.inf, np.nan, 0.2, 1.0]], np.float32)
    rgb = np.array([[[1, 2, 3], [4, 5, 6], [7, 8, 9], [200, 100, 50]]], np.uint8)
    spec = CameraSpec(width_px=4, height_px=1)
    cloud = point_cloud(depth, rgb, camera_intrinsics(spec), near_m=0.4, far_m=5.0)
    assert np.isnan(cloud["z"]).tolist() == [[True, True, True, False]]
    data = cloud.reshape(-1).view(np.uint8).reshape(4, 32)
    # Little-endian 0x00RRGGBB: blue comes first.
    assert data[3, 16:20].tolist() == [50, 100, 200, 0]
    assert data[0, 16:20].tolist() == [3, 2, 1, 0]


def test_cloud_does_not_depend_on_the_number_of_threads() -> None:
    depth = np.random.default_rng(0).uniform(0.1, 9.0, (50, 64)).astype(np.float32)
    spec = CameraSpec(width_px=64, height_px=50)
    one, two = (point_cloud(depth, None, camera_intrinsics(spec), threads=n) for n in (1, 2))
    assert one.tobytes() == two.tobytes()
