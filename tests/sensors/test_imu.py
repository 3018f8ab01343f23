"""IMU readings against mechanics."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gazelle.description.model import ImuSpec, Noise
from gazelle.geometry import Pose
from gazelle.sensors import LinkMotion, imu_noise, imu_reading

GRAVITY = (0.0, 0.0, -9.8)
NOTHING = np.zeros(3)
AT_REST = LinkMotion(Pose(), NOTHING, NOTHING, NOTHING)


def test_reads_g_upwards_at_rest() -> None:
    record = imu_reading(AT_REST, ImuSpec(), GRAVITY)
    assert record.linear_acceleration_m_s2.tolist() == [0.0, 0.0, 9.8]
    assert record.angular_velocity_rad_s.tolist() == [0.0, 0.0, 0.0]
    assert record.orientation_xyzw == (0.0, 0.0, 0.0, 1.0)


def test_reads_nothing_in_free_fall() -> None:
    falling = replace(AT_REST, linear_acceleration_m_s2=np.array(GRAVITY))
    assert imu_reading(falling, ImuSpec(), GRAVITY).linear_acceleration_m_s2.tolist() == [0, 0, 0]


def test_reads_in_its_own_frame() -> None:
    on_its_side = Pose.from_xyz_rpy((0, 0, 0), (math.pi / 2, 0, 0))
    turning = replace(AT_REST, angular_velocity_rad_s=np.array([0.0, 0.0, 2.0]))
    record = imu_reading(turning, ImuSpec(), GRAVITY, T_link_sensor=on_its_side)
    assert record.linear_acceleration_m_s2 == pytest.approx([0.0, 9.8, 0.0], abs=1e-12)
    assert record.angular_velocity_rad_s == pytest.approx([0.0, 2.0, 0.0], abs=1e-12)
    assert record.orientation_xyzw == pytest.approx(on_its_side.quat_xyzw)


def test_off_centre_sensor_feels_centripetal_and_tangential_acceleration() -> None:
    turning = replace(
        AT_REST,
        angular_velocity_rad_s=np.array([0.0, 0.0, 3.0]),
        angular_acceleration_rad_s2=np.array([0.0, 0.0, 5.0]),
    )
    record = imu_reading(turning, ImuSpec(), GRAVITY, T_link_sensor=Pose((0.5, 0.0, 0.0)))
    assert record.linear_acceleration_m_s2 == pytest.approx([-4.5, 2.5, 9.8])


@pytest.mark.parametrize(
    ("localization", "north"), [("ENU", (0, 1, 0)), ("NWU", (1, 0, 0)), ("NED", (1, 0, 0))]
)
def test_orientation_refers_to_the_frame_named(localization, north) -> None:
    facing_north = replace(AT_REST, T_world_link=Pose.from_xyz_rpy((0, 0, 0), (0, 0, math.pi / 2)))
    record = imu_reading(facing_north, ImuSpec(localization=localization), GRAVITY)
    ahead = Pose(quat_xyzw=record.orientation_xyzw).rotate((1.0, 0.0, 0.0))
    assert ahead == pytest.approx(north, abs=1e-12)


def test_orientation_refers_to_custom_rpy_or_to_the_start() -> None:
    turned = Pose.from_xyz_rpy((0, 0, 0), (0, 0, 0.4))
    motion = replace(AT_REST, T_world_link=turned)
    custom = ImuSpec(localization="CUSTOM", custom_rpy_rad=(0.0, 0.0, 0.4))
    level = (0.0, 0.0, 0.0, 1.0)
    assert imu_reading(motion, custom, GRAVITY).orientation_xyzw == pytest.approx(level)
    started = imu_reading(motion, ImuSpec(), GRAVITY, initial_xyzw=turned.quat_xyzw)
    assert started.orientation_xyzw == pytest.approx(level)


def test_each_axis_has_a_noise_of_its_own() -> None:
    quiet, loud = Noise("gaussian", stddev=0.01), Noise("gaussian", stddev=1.0)
    spec = ImuSpec((quiet, quiet, loud), (loud, quiet, quiet))
    noise = imu_noise(spec, 3, "robot::imu")
    records = [imu_reading(AT_REST, spec, GRAVITY, noise=noise, dt_s=0.01) for _ in range(2000)]
    rates = np.array([record.angular_velocity_rad_s for record in records])
    forces = np.array([record.linear_acceleration_m_s2 for record in records])
    assert rates.std(axis=0) == pytest.approx([0.01, 0.01, 1.0], rel=0.06)
    assert forces.std(axis=0) == pytest.approx([1.0, 0.01, 0.01], rel=0.06)
    assert abs(np.corrcoef(rates.T)[0, 1]) < 0.1
