"""Parameters of a move_group that it does not know, or that do nothing, are told."""

from __future__ import annotations

from typing import Any

import pytest

from gazelle.description.model import Model
from gazelle.description.moveit.config import MoveItConfig
from gazelle.description.moveit.parameter_reader import Settings
from gazelle.description.moveit.pipelines import read_pipelines
from gazelle.description.srdf import Group, Srdf
from gazelle.diagnostics import Diagnostics
from gazelle.nodes.move_group.parameters import report_parameters
from gazelle.parameters.trees import nested

_OMPL = {"planning_plugin": "ompl_interface/OMPLPlanner"}


def _told(values: dict[str, Any], ros_version: int = 2) -> list[str]:
    tree = nested(values)
    pipelines, default = read_pipelines(Settings(tree, Diagnostics()), ["arm"])
    srdf = Srdf("r", groups=(Group("arm"),))
    config = MoveItConfig(
        Model("r"), srdf, pipelines=pipelines, default_pipeline=default, parameters=tree
    )
    found = Diagnostics()
    report_parameters(config, "/move_group", found, ros_version=ros_version)
    return [f"{item.code} {item.message}" for item in found]


def test_what_moveit_s_own_launch_files_give_needs_no_word() -> None:
    pilz = "pilz_industrial_motion_planner"
    sequences = f"{pilz}/MoveGroupSequence"
    assert not _told(
        {
            "planning_pipelines": ["ompl", pilz],
            pilz: {"capabilities": f"{sequences}Action {sequences}Service"},
            "ompl": {**_OMPL, "arm": {"planner_configs": ["R"]}},
            "ompl.start_state_max_bounds_error": 0.1,
            "moveit_controller_manager": "moveit_simple_controller_manager/"
            "MoveItSimpleControllerManager",
            "moveit_simple_controller_manager": {"controller_names": ["c"], "c": {"type": "x"}},
            "allow_trajectory_execution": True,
            "capabilities": "",
            "disable_capabilities": "",
            "monitor_dynamics": False,
            "publish_planning_scene": True,
            "use_sim_time": True,
        }
    )  # fmt: skip


@pytest.mark.parametrize(
    ("values", "text"),
    [
        (
            {"trajectory_exec.allowed_start_tolerance": 0.1},
            "parameter.unknown /move_group: parameter 'trajectory_exec.allowed_start_tolerance' is"
            " not one of move_group; it has no effect",
        ),
        (
            {"ompl.resmaple_dt": 0.1},
            "parameter.unknown /move_group/ompl: parameter 'resmaple_dt' is not one of a planning"
            " pipeline; it has no effect",
        ),
        (
            {"octomap_resolution": 0.1},
            "parameter.idle /move_group: parameter 'octomap_resolution' (0.1) has no effect here:"
            " there is no map of obstacles by sensors",
        ),
        (
            {"robot_description_kinematics.arm.kinematics_solver_attempts": 9},
            "parameter.idle /move_group: parameter"
            " 'robot_description_kinematics.arm.kinematics_solver_attempts' (9) has no effect"
            " here: there are a hundred within the time",
        ),
        (
            {"publish_planning_scene": False},
            "parameter.idle /move_group: parameter 'publish_planning_scene' (False) has no effect"
            " here: the scene is always published",
        ),
    ],
)
def test_what_is_not_known_or_does_nothing_is_told(values: dict[str, Any], text: str) -> None:
    assert _told({"planning_pipelines": ["ompl"], "ompl": _OMPL, **values}) == [text]


def test_a_single_pipeline_may_stand_at_the_top() -> None:
    values = {**_OMPL, "arm": {"planner_configs": ["RRT"]}, "planner_configs": {"RRT": {"a": 1}}}
    assert not _told(values, 1)
    (text,) = _told({**values, "resmaple_dt": 1}, 1)
    assert text.startswith("parameter.unknown /move_group: parameter 'resmaple_dt' is not one")
    (text,) = _told({**values, "start_state_max_dt": 0.5}, 1)
    assert text.startswith("parameter.idle /move_group: parameter 'start_state_max_dt' (0.5)")


def test_controllers_at_the_top_and_pipelines_of_others_have_names_of_their_own() -> None:
    values = {"planning_pipelines": ["chomp"], "chomp": {"ridge_factor": 0.1}}
    assert not _told({**values, "sensors": ["eye"], "eye": {"point_cloud_topic": "/p"}})[1:]
    assert not _told({"planning_plugin": "other/Planner", "their_own": 1}, 1)
