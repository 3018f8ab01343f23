"""The example robot: what it is told, what it does and what it says it did agree."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gazelle
from gazelle.interfaces import message_type
from gazelle.workspace import Workspace

EXAMPLE = Path(__file__).parents[2] / "examples" / "scout_ws"
PACKAGE = EXAMPLE / "src" / "scout_robot"


@pytest.fixture
def scout() -> Iterator[gazelle.Simulation]:
    """The scout on open ground, without lidar noise."""
    with gazelle.Simulation.load(
        PACKAGE / "urdf" / "scout.urdf.xacro",
        world="empty",
        mappings={"lidar_noise": "0.0"},
        workspace=Workspace.discover(extra=[EXAMPLE]),
    ) as sim:
        sim.run(seconds=0.5)
        yield sim


def _command(sim: gazelle.Simulation, linear_m_s: float, angular_rad_s: float) -> None:
    twist: Any = message_type("geometry_msgs/msg/Twist")()
    twist.linear.x, twist.angular.z = linear_m_s, angular_rad_s
    sim.publish("/cmd_vel", twist)


def _turned_rad(sim: gazelle.Simulation, seconds: float) -> float:
    """Run and return by how much the robot turned, whole turns included."""
    turned, last = 0.0, sim.model("scout").pose.rpy_rad[2]
    for _ in range(round(seconds / 0.1)):
        sim.run(seconds=0.1)
        now = sim.model("scout").pose.rpy_rad[2]
        turned += math.remainder(now - last, 2 * math.pi)
        last = now
    return turned


def test_nothing_about_it_needs_a_finding(scout: gazelle.Simulation) -> None:
    assert [str(item) for item in scout.diagnostics] == []


def test_idle_it_stays_where_it_is(scout: gazelle.Simulation) -> None:
    before = scout.model("scout").pose
    scout.run(seconds=10.0)
    after = scout.model("scout").pose
    assert np.linalg.norm(np.subtract(after.position_m, before.position_m)) < 1e-3
    assert abs(after.rpy_rad[2] - before.rpy_rad[2]) < math.radians(0.1)


def test_odometry_after_5_m_is_within_2_per_cent_of_truth_and_command(
    scout: gazelle.Simulation,
) -> None:
    odometry: list[Any] = []
    scout.subscribe("/odom", odometry.append)
    start_m = scout.model("scout").pose.position_m[0]
    _command(scout, 0.25, 0.0)
    scout.run(seconds=20.0)
    driven_m = scout.model("scout").pose.position_m[0] - start_m
    assert driven_m == pytest.approx(5.0, rel=0.02)
    assert odometry[-1].pose.pose.position.x == pytest.approx(driven_m, rel=0.02)


def test_odometry_after_a_full_turn_is_within_2_per_cent_of_truth_and_command(
    scout: gazelle.Simulation,
) -> None:
    odometry: list[Any] = []
    scout.subscribe("/odom", odometry.append)
    _command(scout, 0.0, 0.5)
    seconds = round(2 * math.pi / 0.5, 1)
    turned = _turned_rad(scout, seconds)
    assert turned == pytest.approx(0.5 * seconds, rel=0.02)
    orientation = odometry[-1].pose.pose.orientation
    yaw = 2 * math.atan2(orientation.z, orientation.w)
    assert abs(math.remainder(yaw - turned, 2 * math.pi)) < 0.02 * turned


def test_imu_reads_gravity_upwards_at_rest(scout: gazelle.Simulation) -> None:
    reading = scout.sensor("imu").read()
    assert reading.linear_acceleration_m_s2 == pytest.approx((0.0, 0.0, 9.8), abs=1e-3)
    assert reading.angular_velocity_rad_s == pytest.approx((0.0, 0.0, 0.0), abs=1e-3)


def test_lidar_measures_the_walls_of_its_workshop_to_a_millimetre() -> None:
    with gazelle.Simulation.load(
        PACKAGE / "urdf" / "scout.urdf.xacro",
        world=PACKAGE / "worlds" / "workshop.world",
        mappings={"lidar_noise": "0.0"},
        workspace=Workspace.discover(extra=[EXAMPLE]),
    ) as sim:
        sim.run(seconds=0.2)
        ranges_m = sim.sensor("lidar").read().ranges_m[0]
    # Ray i looks at −π + i·(359/359) degrees: 180 ahead, 270 left, 90 right, 0 back.
    for ray, wall_m in ((180, 4.0), (270, 3.0), (90, 3.0), (0, 4.0)):
        assert ranges_m[ray] == pytest.approx(wall_m, abs=1e-3)
