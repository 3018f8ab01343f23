"""Robots cross narrow fields; ``benchmarks/soak/narrow_fields.py`` has fifty of them."""

from __future__ import annotations

import pytest
from tests.navigation.narrow_fields import DRIVERS, cross
from tests.sets import few

_SEEDS = {"trajectory_planner": 5, "dwa": 4, "dwb": 5, "mppi": 3, "pursuit": 0}


@pytest.mark.parametrize("name", list(DRIVERS))
def test_robots_cross_narrow_fields_without_contact(name: str) -> None:
    for seed in few([_SEEDS[name]], list(range(50))):
        end, run = cross(seed, name)
        assert (end, run.contacts) == ("crossed", 0), (seed, run.robot.name, run.pose)
