"""tf2's linear algebra, angles and KDL in C++ do what their mathematics says."""

from __future__ import annotations

import ctypes
import math
from random import Random
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from tests.cpp.geometry.geometry_probe import GeometryProbe

from gazelle.compat.clouds.laser_geometry import LaserProjection
from gazelle.geometry import Pose
from gazelle.interfaces import message_type

_SEEDS = pytest.mark.parametrize("seed", range(12))


@_SEEDS
def test_roll_pitch_and_yaw_survive(geometry: GeometryProbe, seed: int) -> None:
    random = Random(seed)
    rpy = (random.uniform(-3, 3), random.uniform(-1.5, 1.5), random.uniform(-3, 3))
    _, again = geometry.numbers("rotation_of_rpy", rpy, sizes=(4, 3))
    assert again == pytest.approx(rpy, abs=1e-9)


@pytest.mark.parametrize(
    ("rpy", "quaternion"),
    [
        ((math.pi / 2, 0, 0), (math.sqrt(0.5), 0, 0, math.sqrt(0.5))),
        ((0, 0, math.pi / 3), (0, 0, 0.5, math.sqrt(0.75))),
        ((math.pi / 2, 0, math.pi / 2), (0.5, 0.5, 0.5, 0.5)),
    ],
)
def test_yaw_turns_about_z_last(
    geometry: GeometryProbe, rpy: tuple[float, ...], quaternion: tuple[float, ...]
) -> None:
    found, _ = geometry.numbers("rotation_of_rpy", rpy, sizes=(4, 3))
    assert found == pytest.approx(quaternion, abs=1e-12)


@_SEEDS
def test_transforms_compose_and_invert_as_poses(geometry: GeometryProbe, seed: int) -> None:
    random = Random(seed)
    first, second = _pose(random), _pose(random)
    product, inverse = geometry.numbers("compose", _row(first), _row(second), sizes=(7, 7))
    for found, wanted in ((product, first @ second), (inverse, first.inverse())):
        assert found[:3] == pytest.approx(wanted.position_m, abs=1e-9)
        _same_turn(found[3:], wanted.quat_xyzw)


@pytest.mark.parametrize("at", range(4))
def test_half_turns_survive_the_matrix(geometry: GeometryProbe, at: int) -> None:
    quaternion = [1e-9] * 4
    quaternion[at] = 1.0
    _same_turn(geometry.numbers("through_matrix", quaternion, sizes=(4,)), quaternion)


def test_a_symmetric_matrix_becomes_diagonal(geometry: GeometryProbe) -> None:
    entries = (ctypes.c_double * 6)(2.0, 0.3, -0.4, 1.0, 0.7, 3.0)
    diagonal = (ctypes.c_double * 3)()
    assert geometry.library.eigen_check(entries, diagonal) < 1e-12
    full = np.array([[2.0, 0.3, -0.4], [0.3, 1.0, 0.7], [-0.4, 0.7, 3.0]])
    assert sorted(diagonal) == pytest.approx(np.linalg.eigvalsh(full))


@pytest.mark.parametrize(
    ("ends", "limits", "way"),
    [
        ((0.1, -0.1), (-math.pi / 2, math.pi / 2), (-0.2, True)),
        (
            (math.pi / 2 - 0.1, -math.pi / 2 + 0.1),
            (-math.pi / 2, math.pi / 2),
            (0.2 - math.pi, True),
        ),
        ((-math.pi / 2, math.pi / 2), (math.pi - 1, math.pi + 1), None),
    ],
)
def test_the_way_between_angles_stays_within_limits(
    geometry: GeometryProbe,
    ends: tuple[float, float],
    limits: tuple[float, float],
    way: tuple[float, bool] | None,
) -> None:
    is_inside = ctypes.c_int()
    numbers = (ctypes.c_double(one) for one in (*ends, *limits))
    found = geometry.library.shortest_with_limits(*numbers, ctypes.byref(is_inside))
    if way is None:
        assert not is_inside.value
    else:
        assert (found, bool(is_inside.value)) == (pytest.approx(way[0]), way[1])


# ---- KDL --------------------------------------------------------------------------------------


@_SEEDS
def test_the_jacobian_is_the_change_of_the_tip(geometry: GeometryProbe, seed: int) -> None:
    random = Random(seed)
    q, rates = _joints(random), _joints(random)
    jacobian = np.array(geometry.numbers("arm_jacobian", q, sizes=(36,))).reshape(6, 6)
    twist = geometry.numbers("arm_velocity", q, rates, sizes=(6,))
    assert jacobian @ rates == pytest.approx(twist, abs=1e-9)
    step = 1e-6
    before = geometry.numbers("arm_pose", q, sizes=(7,))
    moved = [one + step * rate for one, rate in zip(q, rates, strict=True)]
    after = geometry.numbers("arm_pose", moved, sizes=(7,))
    velocity = (np.array(after[:3]) - before[:3]) / step
    assert velocity == pytest.approx(twist[:3], abs=1e-4)


@pytest.mark.parametrize("method", [0, 1, 2])
def test_an_inverse_reaches_the_pose(geometry: GeometryProbe, method: int) -> None:
    random = Random(7)
    for _ in range(5):
        wanted = _joints(random)
        start = [one + random.uniform(-0.15, 0.15) for one in wanted]
        goal = geometry.numbers("arm_pose", wanted, sizes=(7,))
        found = (ctypes.c_double * 6)()
        given_numbers = ((ctypes.c_double * 6)(*one) for one in (start, wanted))
        assert geometry.library.arm_inverse(method, *given_numbers, found) >= 0
        reached = geometry.numbers("arm_pose", list(found), sizes=(7,))
        assert reached[:3] == pytest.approx(goal[:3], abs=1e-6)
        _same_turn(reached[3:], goal[3:], 1e-6)


@_SEEDS
def test_torques_are_mass_coriolis_and_gravity(geometry: GeometryProbe, seed: int) -> None:
    random = Random(seed)
    q, rates, accelerations = (_joints(random) for _ in range(3))
    torques, mass, coriolis, gravity = geometry.numbers(
        "arm_dynamics", q, rates, accelerations, sizes=(6, 36, 6, 6)
    )
    M = np.array(mass).reshape(6, 6)
    assert pytest.approx(M.T, abs=1e-9) == M
    assert np.linalg.eigvalsh(M).min() > 0
    together = M @ accelerations + coriolis + gravity
    assert torques == pytest.approx(together, abs=1e-9)


def test_gravity_is_the_slope_of_the_height_of_the_masses(geometry: GeometryProbe) -> None:
    """Energy: what the joints do against gravity is what the kinetic energy does not take."""
    random = Random(3)
    q, rates = _joints(random), _joints(random)
    step = 1e-6
    none = [0.0] * 6

    def inertia(at: list[float]) -> Any:
        return np.array(
            geometry.numbers("arm_dynamics", at, none, none, sizes=(6, 36, 6, 6))[1]
        ).reshape(6, 6)

    _, _, coriolis, _ = geometry.numbers("arm_dynamics", q, rates, none, sizes=(6, 36, 6, 6))
    after = [one + step * rate for one, rate in zip(q, rates, strict=True)]
    before = [one - step * rate for one, rate in zip(q, rates, strict=True)]
    M_dot = (inertia(after) - inertia(before)) / (2 * step)
    assert np.dot(rates, coriolis) == pytest.approx(0.5 * np.array(rates) @ M_dot @ rates, abs=1e-5)


def test_a_chain_between_two_branches_is_both_of_them(geometry: GeometryProbe) -> None:
    values = (ctypes.c_double * 8)(0.1, -0.4, 0.3, 0.9, -0.2, 0.5, 0.7, -0.6)
    assert geometry.library.tree_chain_error(values) < 1e-9


# ---- Laser scans ------------------------------------------------------------------------------


def test_a_scan_becomes_the_points_that_python_makes(geometry: GeometryProbe) -> None:
    random = Random(5)
    ranges = [random.uniform(-1.0, 12.0) for _ in range(90)] + [math.nan, math.inf]
    scan = message_type("sensor_msgs/msg/LaserScan")(
        angle_min=-1.5,
        angle_increment=0.03,
        time_increment=0.001,
        range_min=0.1,
        range_max=10.0,
        ranges=ranges,
        intensities=[random.random() for _ in ranges],
    )
    wanted = LaserProjection().projectLaser(scan, -1.0, 1 | 2 | 8)
    head = (ctypes.c_float * 5)(
        scan.angle_min, scan.angle_increment, scan.time_increment, scan.range_min, scan.range_max
    )
    arrays = ((ctypes.c_float * len(ranges))(*one) for one in (scan.ranges, scan.intensities))
    data, said = (ctypes.c_uint8 * 10_000)(), SimpleNamespace(fields="")
    sink = ctypes.CFUNCTYPE(None, ctypes.c_char_p)(
        lambda text: setattr(said, "fields", text.decode())
    )
    size = geometry.library.scan_cloud(
        head, *arrays, len(ranges), ctypes.c_double(-1.0), 1 | 2 | 8, data, sink
    )
    fields = [f"{one.name}:{one.offset}:{one.datatype}" for one in wanted.fields]
    assert said.fields.split() == fields
    kind = np.dtype([(one.name, "<i4" if one.datatype == 5 else "<f4") for one in wanted.fields])
    found = np.frombuffer(bytes(data[:size]), kind)
    expected = np.frombuffer(bytes(wanted.data), kind)
    assert len(found) == len(expected)
    for name in kind.names or ():
        assert found[name] == pytest.approx(expected[name], abs=1e-5), name


def _joints(random: Random) -> list[float]:
    return [random.uniform(-1.2, 1.2) for _ in range(6)]


def _pose(random: Random) -> Pose:
    values = [random.gauss(0.0, 1.0) for _ in range(4)]
    norm = math.sqrt(sum(value * value for value in values))
    x, y, z, w = (value / norm for value in values)
    return Pose((random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9)), (x, y, z, w))


def _row(pose: Pose) -> tuple[float, ...]:
    return (*pose.position_m, *pose.quat_xyzw)


def _same_turn(found: Any, wanted: Any, tolerance: float = 1e-9) -> None:
    sign = math.copysign(1.0, sum(p * q for p, q in zip(found, wanted, strict=True)))
    assert [sign * one for one in found] == pytest.approx(list(wanted), abs=tolerance)
