"""Which planning pipeline a request means."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from tests.installed_packages import code_of_page, installed
from tests.nodes.move_group.conftest import READY, ArmBench, joint_goal

from gazelle.description.moveit import Pipeline
from gazelle.nodes.move_group.ompl_pipeline import OMPL
from gazelle.nodes.move_group.pilz_pipeline import PILZ
from gazelle.nodes.move_group.request_planner import planning_pipeline

_SOURCE = code_of_page("A planning pipeline")
_POINTS = {"gazelle.planning_pipelines": {"crow": "crow_parts:CROW"}}


@pytest.mark.parametrize(
    ("pipeline", "plans"),
    [
        (Pipeline("ompl"), OMPL),
        (Pipeline("pilz_industrial_motion_planner"), PILZ),
        (Pipeline("mine", ("pilz_industrial_motion_planner/CommandPlanner",)), PILZ),
        (Pipeline("mine", ("ompl_interface/OMPLPlanner",)), OMPL),
        (Pipeline("chomp", ("chomp_interface/CHOMPPlanner",)), OMPL),
    ],
)
def test_the_files_name_or_plug_in_says_who_plans(pipeline: Pipeline, plans: object) -> None:
    assert planning_pipeline(pipeline) == (plans, ())


def test_a_pipeline_of_an_installed_package_plans(
    make_arm: Callable[..., ArmBench], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with installed(tmp_path / "site", "crow_parts", _SOURCE, _POINTS):
        more = {"planning_plugin": "crow_flight/CrowPlanner"}
        arm = make_arm(2, planning_pipelines=["ompl", "crow"], crow=more)
        found = arm.call("query_planner_interface", "QueryPlannerInterfaces").planner_interfaces
        assert [(one.name, one.planner_ids) for one in found if one.pipeline_id == "crow"] == [
            ("Crow", ["Fly"])
        ]
        request = {
            "pipeline_id": "crow",
            "group_name": "arm",
            "goal_constraints": joint_goal([0.3, *READY[1:]]),
        }
        result = arm.move(plan_only=True, **request)
        assert result.error_code.val == 1, result.error_code
        points = result.planned_trajectory.joint_trajectory.points
        assert points[-1].positions[0] == pytest.approx(0.3, abs=1e-6)
        assert "no obstacle was looked at" in capsys.readouterr().err
        rows = [{"req": request, "blend_radius": 0.1}, {"req": request, "blend_radius": 0.0}]
        answer = arm.call("plan_sequence_path", "GetMotionSequence", request={"items": rows})
        assert answer.response.error_code.message == (
            "only motions of pilz_industrial_motion_planner can be blended"
        )


def test_a_pipeline_that_cannot_be_loaded_is_told_where_ompl_plans(tmp_path: Path) -> None:
    points = {"gazelle.planning_pipelines": {"crow": "crow_parts:RAVEN"}}
    with installed(tmp_path, "crow_parts", _SOURCE, points):
        plans, (problem,) = planning_pipeline(Pipeline("crow", ("crow_flight/CrowPlanner",)))
    assert plans is OMPL
    assert "entry point 'crow = crow_parts:RAVEN' of crow_parts 1.2" in problem
