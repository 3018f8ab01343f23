"""Planning pipelines: which planner, with which parameters, between which adapters."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from typing import Any

from gazelle.description.moveit.parameter_reader import Settings
from gazelle.description.moveit.parameter_tables import CARTESIAN_LIMITS, PIPELINE, keys_of
from gazelle.diagnostics import did_you_mean

__all__ = [
    "CartesianLimits",
    "GroupPlanners",
    "Pipeline",
    "read_cartesian_limits",
    "read_pipelines",
]


@dataclass(frozen=True, slots=True)
class GroupPlanners:
    """What a pipeline has for one group.

    Attributes:
        planners: names of planner configurations that may be used.
        default_planner: used when a request names none; empty for the pipeline's own.
        longest_valid_segment_fraction: share of the space's extent between two checked states.
        values: everything as it was written.
    """

    planners: tuple[str, ...] = ()
    default_planner: str = ""
    longest_valid_segment_fraction: float | None = None
    values: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Pipeline:
    """One planning pipeline, such as ``ompl``.

    Attributes:
        plugins: names of planner plug-ins.
        default_planner: its planner when neither request nor group names one.
        planner_configs: parameters by configuration; ``type`` names OMPL's class.
        groups: settings by group.
        start_state_max_bounds_error: how far outside its limits a start may be, rad or m.
        capabilities: names of capabilities it adds to move_group.
        values: everything as it was written.
    """

    name: str
    plugins: tuple[str, ...] = ()
    default_planner: str = ""
    planner_configs: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    groups: Mapping[str, GroupPlanners] = field(default_factory=dict)
    request_adapters: tuple[str, ...] = ()
    response_adapters: tuple[str, ...] = ()
    start_state_max_bounds_error: float = 0.05
    capabilities: tuple[str, ...] = ()
    values: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class CartesianLimits:
    """Limits of the tip for Pilz' planner: m/s, m/s² and rad/s; the deceleration is negative."""

    max_trans_vel: float = 1.0
    max_trans_acc: float = 2.25
    max_trans_dec: float = -5.0
    max_rot_vel: float = 1.57


def read_pipelines(tree: Settings, groups: Collection[str]) -> tuple[dict[str, Pipeline], str]:
    """Read all pipelines that ``planning_pipelines`` names, and which one is the default.

    ROS 1 and Foxy have the parameters of a single pipeline at the top, or below ``move_group``.

    Args:
        tree: parameters of ``move_group``.
        groups: names of the groups of the SRDF.
    """
    named = tree.values.get("planning_pipelines")
    if isinstance(named, Mapping) and "pipeline_names" in named:
        names = tree.branch("planning_pipelines").texts("pipeline_names")
    elif isinstance(named, Mapping):
        # ROS 1 nests them: planning_pipelines/ompl/planning_plugin.
        return _read_all(tree.branch("planning_pipelines"), tuple(named), groups, tree)
    else:
        names = tree.texts("planning_pipelines")
    if names:
        return _read_all(tree, names, groups, tree)
    for key in ("move_group", "ompl"):
        inner = tree.branch(key)
        if {"planner_configs", "planning_plugin", "planning_plugins"} & set(inner.values):
            return {"ompl": _read_pipeline(inner, "ompl", groups)}, "ompl"
    return {"ompl": _read_pipeline(tree, "ompl", groups)}, "ompl"


def read_cartesian_limits(planning: Settings) -> CartesianLimits | None:
    """Read ``cartesian_limits`` of ``robot_description_planning``; None when there are none."""
    if "cartesian_limits" not in planning.values:
        return None
    branch = planning.branch("cartesian_limits")
    keys = keys_of(CARTESIAN_LIMITS)
    branch.check_keys(keys)
    values = {key: branch.number(key) for key in keys}
    return CartesianLimits(**{key: value for key, value in values.items() if value is not None})


def _read_all(
    branch: Settings, names: tuple[str, ...], groups: Collection[str], tree: Settings
) -> tuple[dict[str, Pipeline], str]:
    found: dict[str, Pipeline] = {}
    for name in names:
        if not isinstance(branch.values.get(name), Mapping):
            message = f"planning_pipelines names '{name}', of which there are no parameters"
            span = branch.span("planning_pipelines")
            fix = did_you_mean(name, [key for key, _ in branch.branches()])
            branch.diagnostics.report("moveit.no-pipeline", message, span, fix=fix)
        found[name] = _read_pipeline(branch.branch(name), name, groups)
    default = tree.text("default_planning_pipeline")
    if default and default not in found:
        message = f"default_planning_pipeline is '{default}'; there are: {', '.join(found)}"
        span = tree.span("default_planning_pipeline")
        fix = did_you_mean(default, found)
        tree.diagnostics.report("moveit.no-pipeline", message, span, fix=fix)
        default = ""
    return found, default or next(iter(found), "")


def _read_pipeline(branch: Settings, name: str, groups: Collection[str]) -> Pipeline:
    error = branch.number("start_state_max_bounds_error")
    configs = branch.branch("planner_configs")
    known = {key: inner.values for key, inner in configs.branches()}
    default = branch.text("default_planner_config")
    return Pipeline(
        name,
        branch.texts("planning_plugins") or branch.texts("planning_plugin"),
        default,
        known,
        _read_groups(branch, groups, known),
        branch.texts("request_adapters"),
        branch.texts("response_adapters"),
        0.05 if error is None else error,
        branch.texts("capabilities"),
        branch.values,
    )


def _read_groups(
    branch: Settings, groups: Collection[str], configs: Mapping[str, Any]
) -> dict[str, GroupPlanners]:
    found: dict[str, GroupPlanners] = {}
    own = keys_of(PIPELINE)
    for name, settings in branch.branches():
        is_group = (
            "planner_configs" in settings.values or "default_planner_config" in settings.values
        )
        if name in own or not is_group:
            continue
        if not branch.check_name(name, "group", groups):
            continue
        planners = settings.texts("planner_configs")
        default = settings.text("default_planner_config")
        for planner in (*planners, default):
            _check_planner(settings, planner, configs)
        fraction = settings.number("longest_valid_segment_fraction")
        found[name] = GroupPlanners(planners, default, fraction, settings.values)
    return found


def _check_planner(settings: Settings, planner: str, configs: Mapping[str, Any]) -> None:
    if not planner or not configs or planner in configs:
        return
    message = (
        f"{settings.name('planner_configs')} names '{planner}', which planner_configs does not"
    )
    message += (
        f" describe (Could not find the planner configuration '{planner}' on the param server)"
    )
    span = settings.span("planner_configs")
    fix = did_you_mean(planner, configs)
    settings.diagnostics.report("moveit.no-planner", message, span, fix=fix)
