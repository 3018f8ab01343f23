"""SLAM while something goes wrong on the way; the truth is the simulated robot's."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from tests.mapping import buildings as b

from gazelle.mapping.relative_pose_error import absolute_error_m
from gazelle.mapping.slam import SlamParameters


@cache
def _hall() -> b.Log:
    return b.log_of(b.hall(20, 15, 0), b.HOKUYO, b.Wheels(), 0, 0.2)


@cache
def _house() -> b.Log:
    return b.log_of(b.house(0), b.LDS)


@cache
def _ring() -> b.Log:
    return b.log_of(b.ring(24, 14, 3), b.SICK, b.Wheels(), 1, 0.2)


def _glazed() -> b.Log:
    hall = b.hall(20, 15, 0)
    # Two of its four walls.
    glazed = replace(hall, walls=hall.walls[2:], glass=hall.walls[:2])
    return b.log_of(glazed, b.HOKUYO, b.Wheels(), 0, 0.2)


# What goes wrong, and how far off the trajectory may be, m.
CASES: dict[str, tuple[Callable[[], b.Log], float]] = {
    "one beam in ten says anything, in a hall": (lambda: b.with_noise(_hall(), 1), 0.03),
    "one beam in ten says anything, in corridors": (lambda: b.with_noise(_ring(), 1), 0.06),
    "people are about": (lambda: b.with_people(_house(), 1, 0.1), 0.05),
    "scans are lost for 3 s": (lambda: b.without(_ring(), 200, 15), 0.06),
    "the robot is carried through a house": (lambda: b.carried(_house(), 150, 40), 0.05),
    "the robot is carried through a hall": (lambda: b.carried(_hall(), 150, 35), 0.03),
    "wheels slip for 5 m": (lambda: b.slipping(_house(), 120, 5.0, 2.0), 0.05),
    "wheels stick for 5 m": (lambda: b.slipping(_ring(), 150, 5.0, 0.3), 0.06),
    "odometry's clock is 50 ms ahead": (lambda: b.early(_house(), 0.25), 0.05),
    "walls are of glass": (_glazed, 0.05),
}


@pytest.mark.parametrize("name", CASES)
def test_the_trajectory_is_the_robots_though(name: str) -> None:
    make, most_m = CASES[name]
    log = make()
    assert absolute_error_m(b.mapped(log).trajectory(), log.truth) < most_m


def test_a_robot_that_starts_in_the_open_maps_the_building_that_it_comes_to() -> None:
    building = b.in_the_open(b.hall(20, 15, 0), 60.0)
    log = b.log_of(building, replace(b.HOKUYO, range_m=8.0), b.Wheels(), 0, 0.2)
    blind = [scan for scan, _ in log.records if not np.isfinite(scan.ranges_m).any()]
    # A minute at a metre a second.
    assert len(blind) > 200
    trajectory = b.mapped(log).trajectory()
    inside = slice(len(log.records) // 2, None)
    assert absolute_error_m(trajectory[inside], log.truth[inside]) < 0.05


def test_a_closure_never_costs_more_than_none() -> None:
    """In corridors that look alike a robot that was carried is nowhere for certain."""
    log = b.carried(_ring(), 260, 20)
    plain = b.mapped(log, replace(SlamParameters(), loop_closing=False))
    alone_m = absolute_error_m(plain.trajectory(), log.truth)
    assert absolute_error_m(b.mapped(log).trajectory(), log.truth) <= alone_m + 0.05
