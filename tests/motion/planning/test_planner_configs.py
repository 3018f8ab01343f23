from __future__ import annotations

import importlib.util
from typing import Any

import numpy as np
import pytest
import yaml
from tests.motion.plane import Map2D, space_of

from gazelle.description.moveit import DEFAULT_CONFIGS, GroupPlanners, Pipeline
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.motion.planning import PLANNERS, PlannerConfig, Search, configured, plan

_SPAN = SourceSpan("ompl_planning.yaml", 3)


def _pipeline(configs: dict[str, Any], **group: Any) -> Pipeline:
    named = GroupPlanners(tuple(configs), str(group.get("default_planner_config", "")))
    groups = {"arm": GroupPlanners(named.planners, named.default_planner, None, group)}
    return Pipeline("ompl", planner_configs=configs, groups=groups)


def _read(
    planner_id: str, configs: dict[str, Any], **group: Any
) -> tuple[PlannerConfig, Diagnostics]:
    found = Diagnostics()
    pipeline = _pipeline(configs, **group)
    return configured(pipeline, "arm", planner_id, space_of(2), found, span=_SPAN), found


def test_a_configuration_sets_the_parameters_of_its_planner() -> None:
    values = {"type": "geometric::RRT", "range": 0.25, "goal_bias": "0.2"}
    config, found = _read("MyRRT", {"MyRRT": values})
    assert (config.name, config.planner) == ("MyRRT", "RRT")
    assert (config.settings.range, config.settings.goal_bias) == (0.25, 0.2)
    assert not found
    config, _ = _read("PRM", {"PRM": {"type": "geometric::PRM", "max_nearest_neighbors": 4}})
    assert config.settings.max_nearest_neighbors == 4


def test_the_default_of_the_group_plans_where_the_request_names_nothing() -> None:
    configs = {"RRTkConfigDefault": {"type": "geometric::RRT"}}
    for planner_id in ("", "RRTkConfigDefault", "arm[RRTkConfigDefault]"):
        config, found = _read(planner_id, configs, default_planner_config="RRTkConfigDefault")
        assert config.planner == "RRT"
        assert not found
    assert _read("", {})[0].planner == "RRTConnect"
    assert _read("PRMstar", {})[0].planner == "PRMstar"


def test_an_unknown_planner_leaves_the_default_to_plan() -> None:
    configs = {"RRTkConfigDefault": {"type": "geometric::RRT"}}
    config, found = _read("RRTkConfigDefalt", configs, default_planner_config="RRTkConfigDefault")
    assert config.planner == "RRT"
    (item,) = found
    assert item.code == "motion.no-such-planner"
    assert item.message == (
        "group 'arm' has no planner 'RRTkConfigDefalt'; RRTkConfigDefault plans instead, as in "
        "MoveIt"
    )
    assert item.fix.startswith("did you mean 'RRTkConfigDefault'")
    assert item.span == _SPAN


def test_the_finer_of_both_resolutions_counts() -> None:
    extent = space_of(2).extent
    config, found = _read("RRT", {}, longest_valid_segment_fraction=0.005)
    assert config.settings.step == pytest.approx(0.005 * extent)
    assert not found
    for distance, step in ((0.01, 0.01), (0.5, 0.005 * extent)):
        group = {
            "longest_valid_segment_fraction": 0.005,
            "maximum_waypoint_distance": distance,
        }
        assert _read("RRT", {}, **group)[0].settings.step == pytest.approx(step)


def test_settings_of_paths_are_kept_by_every_planner() -> None:
    config, found = _read(
        "PRM", {}, simplify_solutions="false", minimum_waypoint_count=10, interpolate=True
    )
    assert not config.settings.simplify
    assert not found
    path = plan(
        space_of(2),
        Map2D(()),
        np.zeros(2),
        [np.ones(2)],
        search=Search(planner="PRM", settings=config.settings),
    )
    assert len(path.waypoints) >= 10


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("range", "far", "'range' of planner configuration 'RRT' is 'far'; it has to be a number"),
        ("range", -1.0, "is -1.0; it has to be a number that is 0 at least; the default is used"),
        ("goal_bias", 1.5, "a number that is 0 at least and 1 at most"),
        ("longest_valid_segment_fraction", None, "is None; it has to be a number"),
        ("minimum_waypoint_count", 1, "a number that is 2 at least"),
        ("simplify_solutions", "maybe", "it has to be true or false"),
    ],
)
def test_values_that_cannot_be_are_told(key: str, value: Any, words: str) -> None:
    config, found = _read("RRT", {"RRT": {"type": "geometric::RRT", key: value}})
    (item,) = found
    assert item.code == "motion.bad-parameter"
    assert words in item.message
    assert config.settings == _read("RRT", {})[0].settings


def test_what_has_no_effect_and_what_no_planner_knows_are_told_apart() -> None:
    values = {"type": "geometric::RRTConnect", "goal_bias": 0.1, "rnge": 0.2, "degree": 16}
    _, found = _read("mine", {"mine": values})
    told = {item.code: item for item in found}
    assert len(found) == 3
    assert told["motion.parameter-without-effect"].message == (
        "'degree' of planner configuration 'mine' has no effect: RRTConnect has no such parameter "
        "here"
    )
    assert "'rnge' of planner configuration 'mine'" in told["motion.no-such-parameter"].message
    assert told["motion.no-such-parameter"].fix.startswith("did you mean 'range'")


def test_other_objectives_than_length_are_told() -> None:
    usual = "PathLengthOptimizationObjective"
    assert not _read("RRTstar", {}, optimization_objective=usual)[1]
    _, found = _read("RRTstar", {}, optimization_objective="MaximizeMinClearanceObjective")
    (item,) = found
    assert "is MaximizeMinClearanceObjective; paths are made short instead" in item.message


def test_moveits_own_defaults_have_no_unknown_names_and_no_bad_values() -> None:
    file = DEFAULT_CONFIGS / "ompl_defaults.yaml"
    written = yaml.safe_load(file.read_text(encoding="utf-8"))
    configs = written["planner_configs"]
    assert len(configs) > 10
    for name, values in configs.items():
        config, found = _read(name, configs)
        assert config.planner in PLANNERS, values
        assert {item.code for item in found} <= {"motion.parameter-without-effect"}


@pytest.mark.skipif(importlib.util.find_spec("ompl") is None, reason="OMPL is not installed")
def test_planners_of_ompl_get_their_parameters_and_projection() -> None:
    values = {
        "type": "geometric::BKPIECE",
        "range": "0.5",
        "border_fraction": 0.8,
        "min_valid_path_fraction": 0.4,
    }
    config, found = _read("mine", {"mine": values}, projection_evaluator="joints(joint_2)")
    assert not found
    assert config.settings.native == {
        "range": 0.5,
        "border_fraction": 0.8,
        "min_valid_path_fraction": 0.4,
    }
    assert config.settings.projection == (1,)
    circle = Map2D(((0.0, 0.0, 1.0),))
    ends = np.array([-2.0, 0.0]), np.array([2.0, 0.0])
    path = plan(
        space_of(2),
        circle,
        ends[0],
        [ends[1]],
        search=Search(planner=config.planner, settings=config.settings),
    )
    assert path.planner == "BKPIECE"
    assert path.notes == ()
    for text in ("joints(elbow)", "link(tip)"):
        _, found = _read("mine", {"mine": values}, projection_evaluator=text)
        (item,) = found
        assert item.code == "motion.bad-parameter"
