"""Scans against distances worked out on paper."""

from __future__ import annotations

import math
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from gazelle.description.model import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    LidarSpec,
    Noise,
    Plane,
    Sphere,
)
from gazelle.geometry import Pose
from gazelle.sensors import noise_stream, scan, scan_angles, scene_kind

MILLIMETRE = 1e-3
AROUND = LidarSpec(
    samples=360, min_angle_rad=-3.0, max_angle_rad=3.0, range_min_m=0.1, range_max_m=30.0
)
FORWARD = LidarSpec(samples=1, range_min_m=0.1, range_max_m=30.0)


def _box_room_distance(yaw: np.ndarray, x: float, y: float) -> np.ndarray:
    with np.errstate(divide="ignore"):
        to_x = np.where(np.cos(yaw) > 0, 4 - x, -4 - x) / np.cos(yaw)
        to_y = np.where(np.sin(yaw) > 0, 3 - y, -3 - y) / np.sin(yaw)
    return np.minimum(to_x, to_y)


def test_walls_of_a_room_are_met_within_a_millimetre(scene_of, room) -> None:
    scene = scene_of(*room, kind="collisions")
    for x, y, yaw in ((0.0, 0.0, 0.0), (1.3, -2.2, 0.7), (-3.5, 2.5, -2.9)):
        record = scan(scene, AROUND, Pose.from_xyz_rpy((x, y, 0.4), (0, 0, yaw)))
        wanted = _box_room_distance(record.angles.horizontal + yaw, x, y)
        assert np.abs(record.ranges_m[0] - wanted).max() < MILLIMETRE


@pytest.mark.parametrize("radius", [0.05, 0.5, 8.0])
@pytest.mark.parametrize("shape", ["sphere", "cylinder", "capsule", "ellipsoid"])
def test_round_shapes_are_met_within_a_millimetre(scene_of, link, shape, radius) -> None:
    made = {
        "sphere": Sphere(radius),
        "cylinder": Cylinder(radius, 4 * radius),
        "capsule": Capsule(radius, 2 * radius),
        "ellipsoid": Ellipsoid((radius, radius, 2 * radius)),
    }[shape]
    far = radius * 2
    scene = scene_of(link("it", made, Pose((far, 0.0, 0.0))), kind="collisions")
    half = 0.9 * math.asin(radius / far)
    spec = replace(AROUND, min_angle_rad=-half, max_angle_rad=half, range_min_m=0.0)
    record = scan(scene, spec, Pose())
    yaw = record.angles.horizontal
    wanted = far * np.cos(yaw) - np.sqrt(radius**2 - (far * np.sin(yaw)) ** 2)
    assert np.abs(record.ranges_m[0] - wanted).max() < MILLIMETRE


def test_inside_of_a_sphere_is_met(scene_of, link) -> None:
    scene = scene_of(link("shell", Sphere(2.0)), kind="collisions")
    assert np.abs(scan(scene, AROUND, Pose()).ranges_m - 2.0).max() < MILLIMETRE


def test_cone_has_its_apex_up(scene_of, link) -> None:
    scene = scene_of(link("cone", Cone(1.0, 2.0), Pose((5.0, 0.0, 0.0))), kind="collisions")
    for height in (-0.9, 0.0, 0.9):
        met = scan(scene, FORWARD, Pose((0.0, 0.0, height))).ranges_m[0, 0]
        assert met == pytest.approx(5.0 - (1.0 - height) / 2, abs=MILLIMETRE)


def test_tilted_plane_is_met_within_a_millimetre(scene_of, link) -> None:
    normal = np.array([-0.6, 0.2, 0.5])
    normal /= np.linalg.norm(normal)
    plane = Plane(tuple(normal.tolist()))
    scene = scene_of(link("slope", plane, Pose((3.0, 1.0, -0.5))), kind="collisions")
    spec = replace(AROUND, range_max_m=900.0, vertical_samples=5)
    spec = replace(spec, vertical_min_angle_rad=-0.4, vertical_max_angle_rad=0.4)
    record = scan(scene, spec, Pose((0.5, -0.2, 0.3)))
    yaw, pitch = np.meshgrid(record.angles.horizontal, record.angles.vertical)
    rays = np.stack([np.cos(pitch) * np.cos(yaw), np.cos(pitch) * np.sin(yaw), np.sin(pitch)])
    slant = np.tensordot(normal, rays, 1)
    wanted = (normal @ (np.array([3.0, 1.0, -0.5]) - [0.5, -0.2, 0.3])) / slant
    steep = (np.abs(slant) > 0.05) & (wanted > 0)
    assert steep.sum() > 500
    assert np.abs(record.ranges_m - wanted)[steep].max() < MILLIMETRE
    assert np.isinf(record.ranges_m[wanted < 0]).all()


def test_ground_plane_is_endless_for_rays_that_see_collisions(scene_of, link) -> None:
    ground = link("ground", Plane(size_m=(1.0, 1.0)))
    down = Pose.from_xyz_rpy((200.0, -300.0, 2.0), (0.0, math.radians(30), 0.0))
    assert scan(scene_of(ground, kind="collisions"), FORWARD, down).ranges_m[0, 0] == (
        pytest.approx(4.0, abs=MILLIMETRE)
    )
    assert np.isinf(scan(scene_of(ground, kind="visuals"), FORWARD, down).ranges_m[0, 0])


def test_shapes_without_thickness_are_met(scene_of, link) -> None:
    sheet = link("sheet", Box((0.0, 2.0, 2.0)), Pose((3.0, 0.0, 0.0)))
    disc = link("disc", Cylinder(1.0, 0.0), Pose((0.0, 0.0, -2.0)))
    scene = scene_of(sheet, disc, kind="collisions")
    assert scan(scene, FORWARD, Pose()).ranges_m[0, 0] == pytest.approx(3.0, abs=MILLIMETRE)
    down = Pose.from_xyz_rpy((0.0, 0.0, 0.0), (0.0, math.pi / 2, 0.0))
    assert scan(scene, FORWARD, down).ranges_m[0, 0] == pytest.approx(2.0, abs=MILLIMETRE)


def test_turned_sensor_frame_turns_the_scan(scene_of, room) -> None:
    scene = scene_of(*room, kind="collisions")
    rolled = Pose.from_xyz_rpy((0.0, 0.0, 1.0), (math.pi / 2, 0.0, 0.0))
    quarter = replace(FORWARD, samples=3, min_angle_rad=-math.pi / 2, max_angle_rad=math.pi / 2)
    down, ahead, up = scan(scene, quarter, rolled).ranges_m[0]
    assert down == pytest.approx(1.0, abs=MILLIMETRE)
    assert ahead == pytest.approx(4.0, abs=MILLIMETRE)
    assert np.isinf(up)


def test_angles_reach_from_the_smallest_to_the_largest() -> None:
    angles = scan_angles(AROUND)
    assert len(angles.horizontal) == 360
    assert angles.horizontal[0] == -3.0
    assert angles.horizontal[-1] == pytest.approx(3.0, abs=1e-12)
    assert angles.increment == pytest.approx(0.016713091, abs=1e-9)
    assert angles.vertical.tolist() == [0.0]


def test_resolution_multiplies_the_samples() -> None:
    angles = scan_angles(replace(AROUND, resolution=0.5, vertical_samples=4, vertical_resolution=2))
    assert (len(angles.vertical), len(angles.horizontal)) == (8, 180)
    assert angles.increment == pytest.approx(6.0 / 179)


def test_single_sample_looks_straight_ahead() -> None:
    angles = scan_angles(replace(FORWARD, min_angle_rad=0.3, max_angle_rad=0.5))
    assert angles.horizontal.tolist() == [0.0]
    assert angles.increment == 0.0


def test_rows_go_upwards(scene_of, room) -> None:
    spec = replace(FORWARD, vertical_samples=3)
    spec = replace(spec, vertical_min_angle_rad=-1.0, vertical_max_angle_rad=1.0)
    ranges = scan(scene_of(*room), spec, Pose((0.0, 0.0, 0.5))).ranges_m[:, 0]
    assert ranges[0] == pytest.approx(0.5 / math.sin(1.0), abs=MILLIMETRE)
    assert ranges[1] == pytest.approx(4.0, abs=MILLIMETRE)
    assert np.isinf(ranges[2])


def test_nothing_within_the_range_is_infinite(scene_of, room) -> None:
    near = replace(AROUND, range_max_m=3.5)
    ranges = scan(scene_of(*room), near, Pose((0.0, 0.0, 0.5))).ranges_m[0]
    yaw = scan_angles(near).horizontal
    assert np.array_equal(np.isposinf(ranges), _box_room_distance(yaw, 0, 0) > 3.5)


def test_surfaces_nearer_than_the_smallest_range_are_not_seen(scene_of, room, link) -> None:
    housing = link("housing", Box((0.1, 0.1, 0.1)), Pose((0.0, 0.0, 0.5)))
    ranges = scan(scene_of(*room, housing), FORWARD, Pose((0.0, 0.0, 0.5))).ranges_m
    assert ranges[0, 0] == pytest.approx(4.0, abs=MILLIMETRE)
    inward = replace(FORWARD, range_min_m=0.01)
    ranges = scan(scene_of(*room, housing), inward, Pose((0.0, 0.0, 0.5))).ranges_m
    assert ranges[0, 0] == pytest.approx(0.05, abs=MILLIMETRE)


def test_intensity_is_the_laser_retro_of_what_is_met(scene_of, link) -> None:
    scene = scene_of(link("mirror", Sphere(0.5), Pose((2.0, 0.0, 0.0)), retro=180.0))
    assert scan(scene, FORWARD, Pose()).intensities.tolist() == [[180.0]]
    assert scan(scene, FORWARD, Pose.from_xyz_rpy((0, 0, 0), (0, 0, 2))).intensities[0, 0] == 0.0


def test_ray_sensors_see_collisions_and_gpu_rays_visuals() -> None:
    assert scene_kind(LidarSpec(on_collisions=True)) == "collisions"
    assert scene_kind(LidarSpec(on_collisions=False)) == "visuals"


def test_hidden_visuals_are_not_met(scene_of, link) -> None:
    scene = scene_of(link("ghost", Sphere(0.5), Pose((2.0, 0.0, 0.0)), visibility_flags=0))
    assert np.isinf(scan(scene, FORWARD, Pose()).ranges_m[0, 0])


def test_noise_has_the_mean_and_sigma_asked_for(scene_of, link) -> None:
    scene = scene_of(link("shell", Sphere(2.0)), kind="collisions")
    count, sigma = 10_000, 0.01
    spec = replace(AROUND, samples=count, noise=Noise("gaussian", stddev=sigma))
    exact = scan(scene, spec, Pose()).ranges_m
    noisy = scan(scene, spec, Pose(), noise=noise_stream(spec.noise, 7, "robot::laser"))
    error = noisy.ranges_m.astype(float) - exact
    assert abs(error.mean()) < 4 * sigma / math.sqrt(count)
    assert error.std() == pytest.approx(sigma, rel=0.05)


def test_noise_keeps_within_the_limits_and_leaves_infinity(scene_of, room) -> None:
    spec = replace(AROUND, range_min_m=2.9, range_max_m=3.5)
    source = noise_stream(Noise("gaussian", stddev=0.5), 1, "laser")
    exact = scan(scene_of(*room), spec, Pose((0.0, 0.0, 0.5))).ranges_m
    noisy = scan(scene_of(*room), spec, Pose((0.0, 0.0, 0.5)), noise=source).ranges_m
    seen = np.isfinite(exact)
    assert noisy[seen].min() == np.float32(2.9)
    assert noisy[seen].max() == np.float32(3.5)
    assert np.isposinf(noisy[~seen]).all()


def test_equal_seeds_give_equal_scans(scene_of, room) -> None:
    scene, noise = scene_of(*room), Noise("gaussian", stddev=0.01)
    first, again, other = (
        scan(scene, AROUND, Pose((0.0, 0.0, 0.5)), noise=noise_stream(noise, 3, name)).ranges_m
        for name in ("a", "a", "b")
    )
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)


def test_scanning_needs_no_compiled_kernels() -> None:
    code = (
        "import sys\n"
        "from gazelle.sensors import RayScene, scan\n"
        "from gazelle.description.model import LidarSpec, World\n"
        "from gazelle.geometry import Pose\n"
        "scan(RayScene(World()), LidarSpec(range_max_m=1.0), Pose())\n"
        "assert 'llvmlite' not in sys.modules and 'scipy' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
