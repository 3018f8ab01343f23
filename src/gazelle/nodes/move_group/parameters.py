"""The parameters of a move_group, and telling those that it does not know or that do nothing."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from gazelle.description.moveit import MoveItConfig, Pipeline
from gazelle.description.moveit.parameter_tables import (
    CARTESIAN_LIMITS,
    CONTROLLER,
    EXECUTION,
    JOINT_LIMIT,
    KINEMATICS,
    PIPELINE,
)
from gazelle.diagnostics import Diagnostics
from gazelle.nodes.move_group.ompl_pipeline import OMPL
from gazelle.nodes.move_group.pilz_pipeline import PILZ
from gazelle.nodes.parameters import node_reader
from gazelle.parameters import Parameter, ParameterTable, refused

__all__ = ["MOVE_GROUP", "report_parameters"]

_PLANNING = "robot_description_planning"
_MANAGERS = ("moveit_simple_controller_manager", "moveit_fake_controller_manager")
_PUBLISHED = (
    "publish_geometry_updates",
    "publish_planning_scene",
    "publish_state_updates",
    "publish_transforms_updates",
)
# ROS 1 has them below a name.
_SCENE = (*_PUBLISHED, *(f"planning_scene_monitor.{key}" for key in _PUBLISHED))


def _below(branch: str, rows: Iterable[Parameter]) -> tuple[Parameter, ...]:
    return tuple(replace(row, key=f"{branch}.{row.key}") for row in rows)


MOVE_GROUP = ParameterTable(
    "move_group",
    "Plans and executes motions of arms, as MoveIt does. Names in pointed brackets are the"
    " robot's; ROS 1 has the parameters of pipelines below `planning_pipelines`, or those of a"
    " single one without its name, and controllers in a `controller_list` of rows.",
    ("moveit_ros_move_group/move_group",),
    (
        Parameter("robot_description", "text", None, "the URDF; else a topic of this name"),
        Parameter(
            "robot_description_semantic", "text", None, "the SRDF; else a topic of this name"
        ),
        Parameter("joint_state_topic", "text", "joint_states", "where joints' states come from"),
        Parameter("allow_trajectory_execution", "flag", True, "motions may be executed"),
        *_below("robot_description_kinematics.<group>", KINEMATICS),
        Parameter("robot_description_kinematics", "group", None, "all of it, by group"),
        Parameter(
            f"{_PLANNING}.default_velocity_scaling_factor",
            "number",
            0.1,
            "share of the velocity limits that Python's interfaces ask for",
        ),
        Parameter(
            f"{_PLANNING}.default_acceleration_scaling_factor",
            "number",
            0.1,
            "the same of the acceleration limits",
        ),
        *_below(f"{_PLANNING}.joint_limits.<joint>", JOINT_LIMIT),
        *_below(f"{_PLANNING}.cartesian_limits", CARTESIAN_LIMITS),
        Parameter(_PLANNING, "group", None, "all of these limits"),
        Parameter("planning_pipelines", "group", None, "names of pipelines, or they themselves"),
        Parameter(
            "default_planning_pipeline", "text", None, "the pipeline when a request names none"
        ),
        *_below("<pipeline>", PIPELINE),
        Parameter(
            "<pipeline>.<group>.default_planner_config", "text", None, "the group's own planner"
        ),
        Parameter("<pipeline>.<group>.planner_configs", "words", (), "planners it may have"),
        *_below("trajectory_execution", EXECUTION),
        Parameter("trajectory_execution", "group", None, "all of it"),
        Parameter("controller_list", "any", None, "controllers as ROS 1 lists them"),
        Parameter("controller_names", "words", (), "names of controllers that are described"),
        *_below("moveit_simple_controller_manager.<controller>", CONTROLLER),
        *(
            Parameter(
                manager, "group", None, "all of it: `controller_names` or `controller_list`, too"
            )
            for manager in _MANAGERS
        ),
        Parameter("initial", "any", None, "`group` and `pose` where fake controllers begin"),
        *refused(
            "controllers are those of `controller_list`, `moveit_simple_controller_manager` or"
            " `moveit_fake_controller_manager`",
            "moveit_controller_manager",
            unless="moveit_simple_controller_manager/MoveItSimpleControllerManager",
        ),
        *refused(
            "controllers are left as they are, active or not",
            "moveit_manage_controllers",
            unless=True,
        ),
        *refused("the scene is always published", *_SCENE, unless=True),
        *refused("the scene follows everybody who publishes parts of it", "planning_scene_monitor"),
        *refused("the scene has positions only", "monitor_dynamics", unless=False),
        *refused("who has the description publishes it", "publish_robot_description", unless=False),
        *refused(
            "it is a parameter, and no topic of move_group's",
            "publish_robot_description_semantic",
            unless=False,
        ),
        *refused(
            "there is no map of obstacles by sensors",
            "max_range",
            "octomap_frame",
            "octomap_resolution",
            "sensors",
        ),
        *refused("nothing looks around while the robot moves", "sense_for_plan"),
        *refused("a goal says how often it may be planned again", "plan_execution"),
        *refused(
            "nothing is kept in a database", "warehouse_host", "warehouse_plugin", "warehouse_port"
        ),
        *refused("MoveItPy reads it", "plan_request_params", "planning_scene_monitor_options"),
        *refused("what there is of them is always offered", "capabilities", unless=""),
        *(row for row in PIPELINE if row.is_refused and row.key != "capabilities"),
    ),
)

_OURS = (PILZ, OMPL)
_PIPELINE = ParameterTable("a planning pipeline", "How motions are planned.", (), PIPELINE)


def report_parameters(
    config: MoveItConfig, name: str, diagnostics: Diagnostics, *, ros_version: int
) -> None:
    """Report what is not known, and what has no effect.

    Args:
        config: all that was read.
        name: of the node.
        diagnostics: receives it.
        ros_version: of ROS.
    """
    tree = config.parameters
    own = node_reader(MOVE_GROUP, tree, name, diagnostics, ros_version=ros_version)
    own.report_unknown(*_names(config))
    for pipeline in config.pipelines.values():
        if pipeline.values is config.parameters or not _is_known(pipeline):
            continue
        label = f"{name}/{pipeline.name}"
        values = pipeline.values
        # Planning groups, and planners.
        branches = [key for key, value in values.items() if isinstance(value, Mapping)]
        reader = node_reader(_PIPELINE, values, label, diagnostics, ros_version=ros_version)
        reader.report_unknown(*branches)


def _names(config: MoveItConfig) -> Iterator[str]:
    """Yield the first words of parameters that bear names of this robot's."""
    tree = config.parameters
    yield from config.pipelines
    # ROS 1 and Foxy have a single pipeline at the top, or below one of these.
    yield from ("move_group", "ompl")
    alone = next((one for one in config.pipelines.values() if one.values is tree), None)
    if alone is not None:
        honoured = (row.key for row in PIPELINE if not row.is_refused)
        yield from honoured if _is_known(alone) else tree
        yield from (group.name for group in config.srdf.groups)
    if "controller_names" in tree:
        yield from (entry.name for entry in config.controllers)
    sensors = tree.get("sensors")
    yield from (one for one in sensors if isinstance(one, str)) if isinstance(sensors, list) else ()


def _is_known(pipeline: Pipeline) -> bool:
    """Tell whether it is one of ours; other people's have parameters of their own."""
    if not pipeline.plugins:
        return any(one.is_meant(pipeline) for one in _OURS)
    return any(one.name in plugin for one in _OURS for plugin in pipeline.plugins)
