"""Random problems of three arms; OMPL said which have a solution (benchmarks/soak)."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.motion.problems import REACHES_M, Case, case_of, robot_named
from tests.shared_files import shared_cases

from gazelle.motion.planning import FINE_STEP, PlanningError, Search, first_fault, plan
from gazelle.motion.timing import parameterise

_FILE = Path(__file__).parent / "planning_verdicts.json"
_EVERY = 10
"""A tenth of the problems is planned in every test run, all of them by the soak."""


def _solvable(name: str) -> list[Case]:
    if name == "luck":
        # Hulls of its meshes touch each other where the meshes do not.
        pytest.importorskip("coacd")
    robot = robot_named(name)
    rows: list[Any] = json.loads(_FILE.read_text(encoding="utf-8"))[name]
    assert len(rows) == 100
    return [
        case_of(robot, name, number, start, goal)
        for number, start, goal, has_solution in rows[::_EVERY]
        if has_solution
    ]


@pytest.mark.parametrize("name", [*sorted(set(REACHES_M) - {"luck"}), *shared_cases("luck")])
def test_what_ompl_solves_is_solved(name: str) -> None:
    cases = _solvable(name)
    unsolved = []
    for number, case in enumerate(cases):
        try:
            path = plan(
                case.space,
                case.checker,
                case.start,
                [case.goal],
                search=Search(seed=1, time_limit_s=60.0),
            )
        except PlanningError as error:
            unsolved.append(f"{case.number}: {error}")
            continue
        assert path.waypoints[-1] == pytest.approx(case.goal)
        if number % 5 == 0:
            _assert_trajectory_is_sound(case, path.waypoints)
    assert not unsolved, "\n".join(unsolved)


def _assert_trajectory_is_sound(case: Case, waypoints: Any) -> None:
    space = case.space
    known = np.where(np.isinf(space.acceleration), 1.0, space.acceleration)
    found = parameterise(waypoints, space, validity=case.checker)
    assert first_fault(space, case.checker, found.positions, FINE_STEP) == ""
    assert (np.abs(found.velocities) <= space.velocity * 1.001).all()
    assert (np.abs(found.accelerations) <= known * 1.001).all()
    assert found.positions[-1] == pytest.approx(waypoints[-1])
