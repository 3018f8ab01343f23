"""Where cameras of films stand."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.recorded import cart_world, rolling

from gazelle.description.model import Box, Link, Model, Visual
from gazelle.errors import GazelleError, NotFoundError
from gazelle.geometry import Pose
from gazelle.recording import Recording, Stretch
from gazelle.sensors.intrinsics import camera_intrinsics
from gazelle.video import AutomaticCamera, Camera, FixedCamera, FollowCamera, SensorCamera
from gazelle.video.subjects import subject_of

_SIZE = (320, 200)


def _pixel(camera: Camera, recording: Recording, time_ns: int) -> tuple[float, float]:
    """Where the cart's body is in the picture, as shares of width and height."""
    placed = camera.place(recording, _SIZE)
    stretch = recording.stretch_at(time_ns)
    row = next(i for i, one in enumerate(stretch.link_names) if one.endswith("::body"))
    point = stretch.moment(time_ns).T[row, :3]
    x, y, z = placed.pose_at(time_ns).inverse().transform(point[None])[0]
    assert x > 0.0
    lens = camera_intrinsics(placed.spec)
    return (lens.cx - lens.fx * y / x) / _SIZE[0], (lens.cy - lens.fy * z / x) / _SIZE[1]


def _with_wall() -> Recording:
    """The cart rolls behind a wall, seen from the usual side."""
    whole = rolling(1.0, speed_m_s=0.1)
    wall = Link("link", visuals=(Visual("wall", Box((6.0, 0.1, 3.0))),))
    model = Model("wall", Pose((0.0, -0.5, 1.5)), static=True, links=(wall,))
    world = replace(cart_world(), models=(*cart_world().models, model))
    old = whole.stretches[0]
    return Recording((Stretch(world, old.link_names, old.times_ns, old.poses),))


def test_a_fixed_camera_has_all_that_the_robot_does_in_the_picture() -> None:
    recording = rolling(3.0)
    for time_ns in (0, 1_500_000_000, 3_000_000_000):
        across, down = _pixel(FixedCamera(), recording, time_ns)
        assert 0.05 < across < 0.95 and 0.05 < down < 0.95
    first, last = (_pixel(FixedCamera(), recording, t)[0] for t in (0, 3_000_000_000))
    assert abs(last - first) > 0.3


def test_a_camera_that_follows_keeps_the_robot_at_one_place_of_the_picture() -> None:
    recording = rolling(3.0)
    places = [_pixel(FollowCamera(), recording, t * 1_000_000_000) for t in range(4)]
    assert np.ptp(np.array(places), axis=0).max() < 0.01
    assert places[0][0] == pytest.approx(0.5, abs=0.1)


def test_a_camera_behind_looks_the_way_the_robot_goes() -> None:
    placed = FollowCamera("cart", turns=True).place(rolling(1.0), _SIZE)
    ahead = placed.pose_at(0).rotate((1.0, 0.0, 0.0))
    assert ahead[0] > 0.7 and abs(ahead[1]) < 1e-6 and ahead[2] < -0.2


def test_a_camera_that_orbits_comes_round() -> None:
    placed = FollowCamera("cart", orbit_s=2.0).place(rolling(2.0, speed_m_s=0.0), _SIZE)
    start, half, whole = (np.array(placed.pose_at(t).position_m) for t in (0, 10**9, 2 * 10**9))
    assert whole == pytest.approx(start, abs=1e-6)
    assert np.linalg.norm((half - start)[:2]) > 1.0


def test_the_automatic_camera_follows_who_goes_far_for_its_size() -> None:
    far, near = rolling(5.0), rolling(5.0, speed_m_s=0.02)
    moves = [
        math.dist(*(placed.pose_at(t).position_m for t in (0, 5_000_000_000)))
        for placed in (AutomaticCamera().place(one, _SIZE) for one in (far, near))
    ]
    assert moves == pytest.approx([5.0, 0.0], abs=0.01)


def test_a_wall_before_the_robot_is_looked_round() -> None:
    free, walled = rolling(1.0, speed_m_s=0.1), _with_wall()
    assert FixedCamera().place(free, _SIZE).pose_at(0).position_m[1] < 0.0
    assert FixedCamera().place(walled, _SIZE).pose_at(0).position_m[1] > -0.4
    # Who names a side gets it.
    assert FixedCamera(view="side").place(walled, _SIZE).pose_at(0).position_m[1] < -0.4


def test_a_camera_on_board_has_the_sensors_lens_and_place() -> None:
    recording = rolling(2.0)
    for name in ("cart::body::eye", "eye"):
        placed = SensorCamera(name).place(recording, _SIZE)
        assert placed.spec.horizontal_fov_rad == 1.2
        assert placed.pose_at(2_000_000_000).position_m == pytest.approx(
            (2.25, 0.0, 0.25), abs=1e-5
        )
    link = SensorCamera("ball").place(recording, _SIZE)
    assert link.pose_at(0).position_m == pytest.approx((0.0, 0.0, 0.3), abs=1e-6)


def test_names_that_are_not_there_are_told_with_those_that_are() -> None:
    recording = rolling(1.0)
    with pytest.raises(NotFoundError, match="cameras there: cart::body::eye"):
        SensorCamera("nose").place(recording, _SIZE)
    with pytest.raises(NotFoundError, match="did you mean 'cart'"):
        FollowCamera("carts").place(recording, _SIZE)
    with pytest.raises(GazelleError, match="several cameras and links are called 'link': "):
        SensorCamera("link").place(_with_wall(), _SIZE)


def test_a_robot_that_comes_later_is_looked_at_from_then_on() -> None:
    late = rolling(1.0)
    old = late.stretches[0]
    bare = replace(old.world, models=old.world.models[:1])
    empty = Stretch(bare, ("ground::link",), old.times_ns, old.poses[:, :1])
    times = old.times_ns + 1_020_000_000
    recording = Recording((empty, Stretch(old.world, old.link_names, times, old.poses)))
    subject = subject_of(recording)
    assert subject.models == ("cart",)
    assert min(subject.times_ns) >= 1_020_000_000
    for camera in (FixedCamera(), FollowCamera(), SensorCamera("eye")):
        assert camera.place(recording, _SIZE).pose_at(0) is not None
