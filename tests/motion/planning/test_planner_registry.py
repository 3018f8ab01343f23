"""Planners by name, and those of other people's packages."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.installed_packages import code_of_page, installed
from tests.motion.plane import Map2D, space_of

from gazelle.description.moveit import Pipeline
from gazelle.diagnostics import Diagnostics
from gazelle.motion.planning import PlanningError, Search, configured, plan
from gazelle.motion.planning.planner_registry import choose

_EMPTY = Map2D(())
_SOURCE = """
    from gazelle.motion.planning.planner_registry import Planner

    def straight(problem):
        detour = problem.start + problem.settings.native.get("detour", 0.0)
        return [problem.start, detour, problem.goals[0]]

    BEELINE = Planner("Beeline", straight, parameters=("detour", "range"))
"""
_POINTS = {"gazelle.planners": {"beeline": "bee_parts:BEELINE"}}


def test_a_planner_of_an_installed_package_plans_with_its_own_parameters(tmp_path: Path) -> None:
    values = {"type": "geometric::Beeline", "detour": -0.5, "range": 0.5, "goal_bias": 0.1}
    pipeline = Pipeline("ompl", planner_configs={"Bee": {**values, "simplify_solutions": 0}})
    with installed(tmp_path, "bee_parts", _SOURCE, _POINTS):
        told = Diagnostics()
        config = configured(pipeline, "arm", "Bee", space_of(2), told)
        assert config.planner == "Beeline"
        assert dict(config.settings.native) == {"detour": -0.5}
        assert config.settings.range == 0.5
        (finding,) = told
        assert "'goal_bias' of planner configuration 'Bee' has no effect: Beeline" in str(finding)
        path = plan(
            space_of(2),
            _EMPTY,
            np.zeros(2),
            [np.ones(2)],
            search=Search(planner=config.planner, settings=config.settings),
        )
        assert path.planner == "Beeline"
        assert path.waypoints.tolist() == [[0.0, 0.0], [-0.5, -0.5], [1.0, 1.0]]


def test_the_planner_of_the_page_goes_straight_or_not_at_all(tmp_path: Path) -> None:
    with installed(tmp_path, "bee_parts", code_of_page("A planner"), _POINTS):
        path = plan(
            space_of(2), _EMPTY, np.zeros(2), [np.ones(2)], search=Search(planner="Beeline")
        )
        assert path.waypoints.tolist() == [[0.0, 0.0], [1.0, 1.0]]
        wall = Map2D(((0.5, 0.5, 0.1),))
        with pytest.raises(PlanningError, match="Beeline gave up before 5 s were over"):
            plan(space_of(2), wall, np.zeros(2), [np.ones(2)], search=Search(planner="Beeline"))


def test_a_planner_that_cannot_be_loaded_is_told_where_another_one_plans(tmp_path: Path) -> None:
    points = {"gazelle.planners": {"beeline": "bee_parts:WASP"}}
    with installed(tmp_path, "bee_parts", _SOURCE, points):
        note = choose("Beeline").note
    assert note.startswith("there is no planner 'Beeline'; RRTConnect")
    about = "entry point 'beeline = bee_parts:WASP' of bee_parts 1.2 (gazelle.planners)"
    assert f"as in MoveIt. {about} cannot be loaded: AttributeError: " in note
