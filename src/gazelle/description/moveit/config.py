"""Everything move_group is told by parameters, typed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from gazelle.description.loader import load_models
from gazelle.description.model import JointType, Model
from gazelle.description.moveit.controllers import (
    ControllerEntry,
    ExecutionSettings,
    read_controllers,
    read_execution,
)
from gazelle.description.moveit.joint_limits import JointLimit, read_joint_limits
from gazelle.description.moveit.kinematics import KinematicsSettings, read_kinematics
from gazelle.description.moveit.parameter_reader import Settings, Spans
from gazelle.description.moveit.pipelines import (
    CartesianLimits,
    Pipeline,
    read_cartesian_limits,
    read_pipelines,
)
from gazelle.description.srdf import Srdf, link_names, load_srdf
from gazelle.diagnostics import Diagnostics
from gazelle.parameters.trees import nested
from gazelle.workspace import Workspace

__all__ = ["MoveItConfig", "config_from_parameters", "typed_config"]

_DEFAULT_SCALING = 0.1
_VARIABLES = {
    JointType.PLANAR: ("x", "y", "theta"),
    JointType.FLOATING: ("trans_x", "trans_y", "trans_z", "rot_x", "rot_y", "rot_z", "rot_w"),
}


@dataclass(frozen=True)
class MoveItConfig:
    """A robot with everything MoveIt knows of it.

    Attributes:
        robot: links and joints.
        srdf: groups, states, pairs that do not collide; an empty one when there is none.
        kinematics: settings of inverse kinematics by group.
        joint_limits: limits that take the place of the URDF's, by joint or variable.
        velocity_scaling: share of the velocity limits that is used unless a request says more.
        acceleration_scaling: the same of acceleration.
        cartesian_limits: limits of the tip for Pilz' planner, None when not given.
        pipelines: planning pipelines by name.
        default_pipeline: name of the one that is used when a request names none.
        controllers: what trajectories are sent to.
        execution: what is tolerated while they are executed.
        parameters: the whole tree as move_group gets it.
        package: folder of the package, None when the parameters came over the graph.
    """

    robot: Model
    srdf: Srdf = field(default_factory=Srdf)
    kinematics: Mapping[str, KinematicsSettings] = field(default_factory=dict)
    joint_limits: Mapping[str, JointLimit] = field(default_factory=dict)
    velocity_scaling: float = _DEFAULT_SCALING
    acceleration_scaling: float = _DEFAULT_SCALING
    cartesian_limits: CartesianLimits | None = None
    pipelines: Mapping[str, Pipeline] = field(default_factory=dict)
    default_pipeline: str = ""
    controllers: tuple[ControllerEntry, ...] = ()
    execution: ExecutionSettings = field(default_factory=ExecutionSettings)
    parameters: Mapping[str, Any] = field(default_factory=dict)
    package: Path | None = None


def config_from_parameters(
    parameters: Mapping[str, Any],
    *,
    workspace: Workspace | None,
    diagnostics: Diagnostics,
    description: str = "robot_description",
    spans: Spans | None = None,
) -> MoveItConfig | None:
    """Read the parameters of a ``move_group`` of ROS 1 or ROS 2.

    Args:
        parameters: by name, nested or with dots or slashes.
        workspace: finds meshes.
        diagnostics: receives every finding.
        description: name of the parameter with the URDF; ``_semantic``, ``_kinematics`` and
            ``_planning`` are appended for the others.
        spans: where each key was written, by its path.

    Returns:
        The configuration; None (reported) when there is no robot in it.
    """
    tree = Settings(nested(parameters), diagnostics, spans=spans or {})
    robot = _robot(tree, description, workspace)
    if robot is None:
        return None
    srdf = _semantics(tree, f"{description}_semantic", robot, workspace)
    return typed_config(tree, description, robot, srdf)


def typed_config(tree: Settings, description: str, robot: Model, srdf: Srdf) -> MoveItConfig:
    """Read all that is not robot or SRDF from the parameters of ``move_group``."""
    groups = [group.name for group in srdf.groups]
    joints = [joint.name for joint in robot.joints]
    links = link_names(robot)
    virtual = [joint.name for joint in srdf.virtual_joints]
    planning = tree.branch(f"{description}_planning")
    pipelines, default = read_pipelines(tree, groups)
    return MoveItConfig(
        robot,
        srdf,
        read_kinematics(tree.branch(f"{description}_kinematics"), groups, links),
        read_joint_limits(planning.branch("joint_limits"), _variables(robot, srdf)),
        _scaling(planning, "default_velocity_scaling_factor"),
        _scaling(planning, "default_acceleration_scaling_factor"),
        read_cartesian_limits(planning),
        pipelines,
        default,
        read_controllers(tree, [*joints, *virtual]),
        read_execution(tree),
        tree.values,
    )


def _robot(tree: Settings, key: str, workspace: Workspace | None) -> Model | None:
    text = tree.text(key)
    if not text:
        message = f"there is no parameter '{key}' with a URDF"
        tree.diagnostics.report("moveit.no-description", message)
        return None
    models = load_models(text, workspace=workspace, diagnostics=tree.diagnostics, inserts=False)
    return models[0] if models else None


def _semantics(tree: Settings, key: str, robot: Model, workspace: Workspace | None) -> Srdf:
    text = tree.text(key)
    if not text:
        message = f"there is no parameter '{key}' with an SRDF: the robot has no planning groups"
        tree.diagnostics.report("moveit.no-srdf", message)
        return Srdf(robot.name)
    found = load_srdf(text, robot=robot, workspace=workspace, diagnostics=tree.diagnostics)
    return Srdf(robot.name) if found is None else found


def _variables(robot: Model, srdf: Srdf) -> tuple[str, ...]:
    kinds = {joint.name: joint.type for joint in robot.joints}
    kinds |= {joint.name: JointType(joint.type) for joint in srdf.virtual_joints}
    inner = (f"{name}/{part}" for name, kind in kinds.items() for part in _VARIABLES.get(kind, ()))
    return (*kinds, *inner)


def _scaling(planning: Settings, key: str) -> float:
    value = planning.number(key)
    if value is None:
        return _DEFAULT_SCALING
    if 0 < value <= 1:
        return value
    message = f"{planning.name(key)} is {value:g}, it has to be above 0 and at most 1;"
    message += f" {_DEFAULT_SCALING:g} is used"
    planning.diagnostics.report("moveit.bad-limit", message, planning.span(key))
    return _DEFAULT_SCALING
