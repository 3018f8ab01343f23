"""Pictures against projections and light worked out on paper."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from gazelle.description.model import (
    Box,
    CameraSpec,
    LensDistortion,
    Light,
    LightType,
    Material,
    Noise,
    Plane,
    Sphere,
)
from gazelle.geometry import Pose
from gazelle.sensors import camera_intrinsics, picture_noise, render
from gazelle.sensors.pixel_kernels import mark_edges

CAMERA = CameraSpec(width_px=160, height_px=120, horizontal_fov_rad=1.05, near_m=0.05, far_m=50.0)
WHITE = Material(ambient=(1, 1, 1, 1), diffuse=(1, 1, 1, 1))
SUN = Light("sun", LightType.DIRECTIONAL, direction=(0.0, 0.0, -1.0), cast_shadows=True)
DOWN = Pose.from_xyz_rpy((0.0, 0.0, 5.0), (0.0, math.pi / 2, 0.0))
"""Looks down: the picture's top is +x, its left is +y."""


def _project(point: tuple[float, float, float]) -> tuple[float, float]:
    """Pixel of a point in front of a camera at the origin that looks along +x."""
    lens = camera_intrinsics(CAMERA)
    x, y, z = point
    return lens.cx - lens.fx * y / x, lens.cy - lens.fy * z / x


def _paint(**colours: object) -> Material:
    return replace(WHITE, **colours)


def test_silhouette_of_a_box_is_its_projection_to_the_pixel(scene_of, link) -> None:
    box = link("box", Box((0.5, 0.3, 0.2)), Pose((2.25, 0.2, -0.1)), material=WHITE)
    record = render(scene_of(box), CAMERA, Pose(), want_depth=True)
    left, top = _project((2.0, 0.35, 0.0))
    right, bottom = _project((2.0, 0.05, -0.2))
    rows, columns = np.nonzero(np.isfinite(record.depth_m))
    assert (columns.min(), columns.max()) == (math.ceil(left), math.floor(right))
    # The top face lies in the camera's height: only the near face is seen.
    assert (rows.min(), rows.max()) == (math.ceil(top), math.floor(bottom))
    assert len(rows) == (np.ptp(rows) + 1) * (np.ptp(columns) + 1)
    assert np.abs(record.depth_m[rows, columns] - 2.0).max() < 1e-5


def test_corners_seen_from_a_turned_camera_project_exactly(scene_of, link) -> None:
    T_world_camera = Pose.from_xyz_rpy((-1.0, 0.4, 0.8), (0.1, 0.3, -0.2))
    lens = camera_intrinsics(CAMERA)
    for corner in ((1.5, 0.3, 0.1), (2.0, -0.6, 0.4), (1.2, 0.1, -0.4)):
        scene = scene_of(link("dot", Sphere(0.02), Pose(corner), material=WHITE))
        depth = render(scene, CAMERA, T_world_camera, want_rgb=False, want_depth=True).depth_m
        rows, columns = np.nonzero(np.isfinite(depth))
        x, y, z = T_world_camera.inverse().transform(np.array(corner))
        assert columns.mean() == pytest.approx(lens.cx - lens.fx * y / x, abs=0.4)
        assert rows.mean() == pytest.approx(lens.cy - lens.fy * z / x, abs=0.4)


def test_depth_is_planar_and_within_a_millimetre(scene_of, link) -> None:
    normal = np.array([-1.0, 0.3, 0.2]) / math.sqrt(1.13)
    wall = Plane(tuple(normal.tolist()), size_m=(40.0, 40.0))
    scene = scene_of(link("wall", wall, Pose((3.0, 0.0, 0.0))))
    depth = render(scene, CAMERA, Pose(), want_rgb=False, want_depth=True).depth_m
    lens = camera_intrinsics(CAMERA)
    u, v = np.meshgrid(np.arange(160), np.arange(120))
    rays = np.stack([np.ones_like(u, float), (lens.cx - u) / lens.fx, (lens.cy - v) / lens.fy], -1)
    assert np.abs(depth - 3.0 * normal[0] / (rays @ normal)).max() < 1e-3


def test_given_intrinsics_move_the_picture(scene_of, link) -> None:
    scene = scene_of(link("dot", Sphere(0.02), Pose((2.0, 0.0, 0.0))))
    shifted = replace(CAMERA, intrinsics=(200.0, 150.0, 100.0, 40.0, 0.0))
    depth = render(scene, shifted, Pose(), want_rgb=False, want_depth=True).depth_m
    rows, columns = np.nonzero(np.isfinite(depth))
    assert (columns.mean(), rows.mean()) == pytest.approx((99.5, 39.5), abs=0.3)


def test_nothing_is_seen_outside_the_clip_distances(scene_of, link) -> None:
    near, far = (
        link("near", Sphere(0.1), Pose((0.5, 0, 0))),
        link("far", Sphere(3), Pose((30, 0, 0))),
    )
    spec = replace(CAMERA, near_m=1.0, far_m=20.0)
    record = render(
        scene_of(near, far, background=(0.2, 0.4, 0.6, 1)), spec, Pose(), want_depth=True
    )
    assert np.isinf(record.depth_m).all()
    assert np.array_equal(np.unique(record.rgb.reshape(-1, 3), axis=0), [[51, 102, 153]])


def test_colour_is_ambient_plus_lights_by_the_cosine(scene_of, link) -> None:
    paint = _paint(ambient=(0.5, 1, 0, 1), diffuse=(0.2, 0.4, 0.8, 1), emissive=(0, 0, 0.1, 1))
    floor = link("floor", Plane(size_m=(20.0, 20.0)), material=paint)
    tilted = replace(SUN, direction=(0.0, math.sin(1.0), -math.cos(1.0)), diffuse=(1, 0.5, 0.5, 1))
    scene = scene_of(floor, lights=(tilted,), ambient=(0.4, 0.4, 0.4, 1))
    wanted = 0.4 * np.array([0.5, 1, 0]) + [0, 0, 0.1]
    wanted = wanted + math.cos(1.0) * np.array([1, 0.5, 0.5]) * [0.2, 0.4, 0.8]
    assert render(scene, CAMERA, DOWN).rgb[60, 80] == pytest.approx(wanted * 255, abs=0.6)


def test_highlight_stands_where_the_light_is_mirrored(scene_of, link) -> None:
    paint = _paint(
        ambient=(0, 0, 0, 1), diffuse=(0, 0, 0, 1), specular=(1, 1, 1, 1), shininess=50.0
    )
    floor = link("floor", Plane(size_m=(20.0, 20.0)), material=paint)
    light = replace(SUN, direction=(-0.3, 0.0, -1.0), specular=(1, 0.5, 0, 1))
    rgb = render(scene_of(floor, lights=(light,)), CAMERA, DOWN).rgb
    rows, columns = np.nonzero(rgb[:, :, 0] > 250)
    lens = camera_intrinsics(CAMERA)
    assert rows.mean() == pytest.approx(lens.cy - lens.fy * 0.3, abs=1)
    assert columns.mean() == pytest.approx(lens.cx, abs=0.5)
    assert rgb[round(rows.mean()), round(columns.mean())].tolist() == pytest.approx(
        [255, 128, 0], abs=3
    )


def test_point_light_fades_with_distance_and_ends_at_its_range(scene_of, link) -> None:
    floor = link("floor", Plane(size_m=(40.0, 40.0)), material=_paint(ambient=(0, 0, 0, 1)))
    lamp = Light(
        "lamp",
        LightType.POINT,
        Pose((0.0, 0.0, 2.0)),
        range_m=3.0,
        attenuation_constant=0.5,
        attenuation_linear=0.1,
        attenuation_quadratic=0.2,
    )
    rgb = render(scene_of(floor, lights=(lamp,)), CAMERA, DOWN).rgb
    lens = camera_intrinsics(CAMERA)
    for aside in (0.0, 1.0, 2.0):
        reach = math.hypot(2.0, aside)
        wanted = 2.0 / reach / (0.5 + 0.1 * reach + 0.2 * reach**2)
        column = round(lens.cx - lens.fx * aside / 5.0)
        assert rgb[60, column, 0] == pytest.approx(255 * wanted, abs=4)
    assert rgb[60, round(lens.cx - lens.fx * 2.4 / 5.0), 0] == 0


def test_spot_light_ends_at_its_cone(scene_of, link) -> None:
    floor = link("floor", Plane(size_m=(40.0, 40.0)), material=_paint(ambient=(0, 0, 0, 1)))
    spot = Light(
        "spot",
        LightType.SPOT,
        Pose((0.0, 0.0, 2.0)),
        spot_inner_angle_rad=0.6,
        spot_outer_angle_rad=1.0,
        spot_falloff=1.0,
    )
    rgb = render(scene_of(floor, lights=(spot,)), CAMERA, DOWN).rgb
    lens = camera_intrinsics(CAMERA)

    def at(angle: float) -> float:
        return float(rgb[60, round(lens.cx + lens.fx * 2.0 * math.tan(angle) / 5.0), 0])

    assert at(0.2) > 240
    assert 60 < at(0.4) < 190
    assert at(0.52) == 0


def test_shadow_falls_where_geometry_says(scene_of, link) -> None:
    floor = link("floor", Plane(size_m=(20.0, 20.0)), material=_paint(ambient=(0, 0, 0, 1)))
    plate = link("plate", Box((0.6, 0.4, 0.01)), Pose((0.0, 0.0, 1.0)))
    sun = replace(SUN, direction=(0.0, -1.0, -1.0))
    rgb = render(scene_of(floor, plate, lights=(sun,)), CAMERA, DOWN).rgb
    lens = camera_intrinsics(CAMERA)
    # One metre below, the shadow lies one metre towards -y, which is right in the picture.
    left, right = (lens.cx + lens.fx * (1.0 + side) / 5.0 for side in (-0.2, 0.2))
    top, bottom = (lens.cy + lens.fy * side / 5.0 for side in (-0.3, 0.3))
    rows, columns = np.nonzero(rgb[:, 80:, 0] < 20)
    dark = columns + 80 > lens.cx + lens.fx * 0.5 / 5.0
    rows, columns = rows[dark], columns[dark] + 80
    assert (columns.min(), columns.max()) == pytest.approx((left, right), abs=1.01)
    assert (rows.min(), rows.max()) == pytest.approx((top, bottom), abs=1.01)


@pytest.mark.parametrize("what", ["scene", "light", "visual"])
def test_shadows_can_be_switched_off(scene_of, link, what) -> None:
    floor = link("floor", Plane(size_m=(20.0, 20.0)), material=_paint(ambient=(0, 0, 0, 1)))
    plate = link("plate", Box((0.6, 0.4, 0.01)), Pose((0, 0, 1)), cast_shadows=what != "visual")
    sun = replace(SUN, direction=(0.0, -1.0, -1.0), cast_shadows=what != "light")
    scene = scene_of(floor, plate, lights=(sun,), shadows=what != "scene")
    assert render(scene, CAMERA, DOWN).rgb[60, 80 + 28].min() > 150


def test_light_shines_through_no_wall_near_a_point_light(scene_of, link) -> None:
    floor = link("floor", Plane(size_m=(20.0, 20.0)), material=_paint(ambient=(0, 0, 0, 1)))
    lamp = Light("lamp", LightType.POINT, Pose((0.0, 0.0, 2.0)), cast_shadows=True)
    beyond = link("beyond", Box((1.0, 1.0, 0.1)), Pose((0.0, 0.0, 3.0)))
    between = link("between", Box((1.0, 1.0, 0.1)), Pose((0.0, 0.0, 1.0)))
    up = Pose.from_xyz_rpy((-2.0, 0.0, 0.5), (0.0, 0.245, 0.0))
    open_sky = render(scene_of(floor, beyond, lights=(lamp,)), CAMERA, up).rgb[60, 80]
    covered = render(scene_of(floor, between, lights=(lamp,)), CAMERA, up).rgb[60, 80]
    assert open_sky.min() > 100
    assert covered.max() == 0


def test_unlit_material_shows_its_diffuse_colour(scene_of, link) -> None:
    floor = link(
        "f", Plane(size_m=(9.0, 9.0)), material=_paint(diffuse=(1, 0.5, 0, 1), lighting=False)
    )
    assert render(scene_of(floor), CAMERA, DOWN).rgb[60, 80].tolist() == [255, 128, 0]


def test_texture_lies_the_right_way_round_and_repeats(scene_of, link, tmp_path) -> None:
    corners = np.zeros((64, 64, 3), np.uint8)
    corners[:32, :32], corners[:32, 32:] = (255, 0, 0), (0, 255, 0)
    corners[32:, :32], corners[32:, 32:] = (0, 0, 255), (255, 255, 255)
    file = tmp_path / "corners.png"
    Image.fromarray(corners).save(file)
    upright = Pose.from_xyz_rpy((0.0, 0.0, 5.0), (0.0, math.pi / 2, math.pi / 2))
    paint = _paint(texture=file)
    scene = scene_of(link("f", Plane(size_m=(4.0, 4.0)), material=paint), ambient=(1, 1, 1, 1))
    rgb = render(scene, CAMERA, upright).rgb
    assert rgb[40, 60].tolist() == [255, 0, 0]
    assert rgb[40, 100].tolist() == [0, 255, 0]
    assert rgb[80, 60].tolist() == [0, 0, 255]
    assert rgb[80, 100].tolist() == [255, 255, 255]
    twice = replace(paint, texture_scale=(3.0, 3.0))
    scene = scene_of(link("f", Plane(size_m=(4.0, 4.0)), material=twice), ambient=(1, 1, 1, 1))
    row = render(scene, CAMERA, upright).rgb[50]
    assert (np.abs(np.diff(row[:, 1].astype(int))) > 100).sum() >= 5


def test_far_textures_are_averaged_instead_of_flickering(scene_of, link, tmp_path) -> None:
    checks = np.indices((256, 256)).sum(axis=0) % 2 * 255
    file = tmp_path / "checks.png"
    Image.fromarray(checks.astype(np.uint8)).save(file)
    floor = link(
        "f", Plane(size_m=(20.0, 20.0)), material=_paint(texture=file, texture_scale=(9, 9))
    )
    rgb = render(scene_of(floor, ambient=(1, 1, 1, 1)), CAMERA, DOWN).rgb.astype(int)
    assert np.abs(rgb - 128).max() < 20


def test_unreadable_texture_is_reported_and_the_colour_shown(scene_of, link, tmp_path) -> None:
    file = tmp_path / "broken.png"
    file.write_bytes(b"nothing")
    scene = scene_of(
        link("f", Plane(size_m=(9, 9)), material=_paint(texture=file)), ambient=(1, 1, 1, 1)
    )
    assert render(scene, CAMERA, DOWN).rgb[60, 80].tolist() == [255, 255, 255]
    (found,) = scene.diagnostics.by_code("sensors.unreadable-texture")
    assert "the plain colour is shown" in found.message
    assert found.span is not None
    assert found.span.file == str(file)


def test_transparent_surface_mixes_with_what_is_behind(scene_of, link) -> None:
    red = _paint(ambient=(1, 0, 0, 1), diffuse=(1, 0, 0, 1))
    blue = _paint(ambient=(0, 0, 1, 1), diffuse=(0, 0, 1, 1))
    pane = link("pane", Plane(size_m=(9, 9)), Pose((0, 0, 2)), material=red, transparency=0.75)
    floor = link("floor", Plane(size_m=(9, 9)), material=blue)
    record = render(scene_of(pane, floor, ambient=(1, 1, 1, 1)), CAMERA, DOWN, want_depth=True)
    assert record.rgb[60, 80].tolist() == pytest.approx([64, 0, 191], abs=1)
    assert record.depth_m[60, 80] == pytest.approx(3.0, abs=1e-4)


def test_visibility_flags_hide_visuals_from_cameras(scene_of, link) -> None:
    scene = scene_of(link("ghost", Sphere(1.0), Pose((3, 0, 0)), visibility_flags=2))
    hidden = render(scene, replace(CAMERA, visibility_mask=1), Pose(), want_depth=True)
    shown = render(scene, replace(CAMERA, visibility_mask=3), Pose(), want_depth=True)
    assert np.isinf(hidden.depth_m).all()
    assert np.isfinite(shown.depth_m).any()


def test_sky_darkens_upwards_and_plain_background_is_even(scene_of) -> None:
    sky = render(scene_of(sky=True), CAMERA, Pose()).rgb.astype(int)
    assert (np.diff(sky[:60, 80, 0]) >= 0).all()
    assert sky[0, 80, 2] > sky[0, 80, 0] + 40
    plain = render(scene_of(), CAMERA, Pose()).rgb
    assert np.unique(plain).tolist() == [179]


def _busy(scene_of, link):
    things = [
        link(f"s{n}", Sphere(0.3), Pose((2 + n % 4, n % 5 - 2.0, n % 3 - 1.0))) for n in range(9)
    ]
    floor = link("floor", Plane(size_m=(30, 30)), Pose((0, 0, -1.5)))
    return scene_of(floor, *things, lights=(replace(SUN, direction=(-0.5, 0.2, -1)),), sky=True)


@pytest.mark.parametrize("antialias", [False, True])
def test_picture_does_not_depend_on_the_number_of_threads(scene_of, link, antialias) -> None:
    spec = replace(CAMERA, width_px=157, height_px=101, noise=Noise("gaussian", stddev=0.01))
    records = [
        render(
            _busy(scene_of, link),
            spec,
            Pose(),
            want_depth=True,
            antialias=antialias,
            noise=picture_noise(spec.noise, 1, "camera"),
            threads=threads,
        )
        for threads in (1, 2, 3, 1)
    ]
    for record in records[1:]:
        assert np.array_equal(record.rgb, records[0].rgb)
        assert np.array_equal(record.depth_m, records[0].depth_m)


def test_colour_and_depth_alone_equal_those_together(scene_of, link) -> None:
    scene = _busy(scene_of, link)
    both = render(scene, CAMERA, Pose(), want_depth=True)
    assert np.array_equal(render(scene, CAMERA, Pose()).rgb, both.rgb)
    alone = render(scene, CAMERA, Pose(), want_rgb=False, want_depth=True)
    assert alone.rgb is None
    assert np.array_equal(alone.depth_m, both.depth_m)
    nothing = render(scene, CAMERA, Pose(), want_rgb=False)
    assert (nothing.rgb, nothing.depth_m) == (None, None)


def test_antialiasing_smooths_edges_and_leaves_flat_parts(scene_of, link) -> None:
    paint = _paint(diffuse=(1, 1, 1, 1), lighting=False)
    tilted = Pose.from_xyz_rpy((3, 0, 0), (0.2, 0, 0))
    scene = scene_of(link("b", Box((1, 1, 1)), tilted, material=paint), background=(0, 0, 0, 1))
    hard = render(scene, CAMERA, Pose()).rgb
    soft = render(scene, CAMERA, Pose(), antialias=True).rgb
    assert np.unique(hard).tolist() == [0, 255]
    between = (soft > 0) & (soft < 255)
    assert 0.002 < between.mean() < 0.05
    assert set(np.unique(soft).tolist()) <= {0, 64, 128, 191, 255}
    assert soft.mean() == pytest.approx(hard.mean(), rel=0.01)


def test_only_tiles_with_steps_of_colour_are_smoothed() -> None:
    rgb = np.full((12, 16, 3), 100, np.uint8)
    rgb[:, :, 1] += np.arange(16, dtype=np.uint8) * 5
    rgb[5, 9] = 0
    tiles = np.zeros((3, 4), np.uint8)
    mark_edges(rgb, tiles, 0, 12, 24)
    assert tiles.tolist() == [[0, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 0]]


def test_noise_is_one_sample_per_pixel_of_the_sigma_asked_for(scene_of) -> None:
    spec = replace(CAMERA, noise=Noise("gaussian", stddev=0.02))
    noisy = render(scene_of(), spec, Pose(), noise=picture_noise(spec.noise, 1, "camera")).rgb
    error = noisy.astype(int) - 179
    assert (error == error[:, :, :1]).all()
    assert error.mean() == pytest.approx(0, abs=4 * 5.1 / math.sqrt(160 * 120) + 0.02)
    assert error.std() == pytest.approx(5.1, rel=0.05)


def test_distortion_bends_the_picture_and_not_the_depth(scene_of, link) -> None:
    scene = scene_of(link("b", Box((1, 2, 1)), Pose((3, 0, 0))))
    bent = replace(CAMERA, distortion=LensDistortion(k1=-0.3))
    plain, lens = (render(scene, spec, Pose(), want_depth=True) for spec in (CAMERA, bent))
    assert not np.array_equal(plain.rgb, lens.rgb)
    assert np.array_equal(plain.depth_m, lens.depth_m)


def test_wide_angle_lens_is_reported_and_drawn_as_a_pinhole(scene_of, link) -> None:
    scene = scene_of(link("ball", Sphere(0.5), Pose((4, 0, 0))))
    fisheye = replace(CAMERA, kind="wideangle", horizontal_fov_rad=4.0)
    assert np.isfinite(render(scene, fisheye, Pose(), want_depth=True).depth_m).sum() <= 4
    (found,) = scene.diagnostics.by_code("sensors.wide-angle-lens")
    assert found.message == (
        "camera 'camera' has a wide-angle lens of 229 degrees; it is drawn as a pinhole"
    )


def test_moved_things_are_seen_where_they_are_now(scene_of, link, poses) -> None:
    scene = scene_of(link("ball", Sphere(0.5), Pose((4, 0, 0))))
    render(scene, CAMERA, Pose())
    scene.update(poses(ball=Pose((4, 1.0, 0))))
    depth = render(scene, CAMERA, Pose(), want_rgb=False, want_depth=True).depth_m
    assert np.isinf(depth[60, 80])
    assert np.nonzero(np.isfinite(depth))[1].mean() == pytest.approx(
        _project((4, 1, 0))[0], abs=1.5
    )
