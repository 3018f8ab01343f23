"""Controllers that MoveIt sends trajectories to, and how it watches them."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from typing import Any

from gazelle.description.moveit.parameter_reader import Settings
from gazelle.description.moveit.parameter_tables import CONTROLLER, EXECUTION, keys_of
from gazelle.diagnostics import SourceSpan

__all__ = ["ControllerEntry", "ExecutionSettings", "read_controllers", "read_execution"]

_MANAGERS = ("moveit_simple_controller_manager", "moveit_fake_controller_manager")


@dataclass(frozen=True, slots=True)
class ControllerEntry:
    """One controller as MoveIt knows it.

    Attributes:
        name: of the controller; its action is ``<name>/<action_ns>``.
        type: ``FollowJointTrajectory`` or ``GripperCommand``; ``interpolate``, ``via points`` and
            ``last point`` of fake controllers.
        default: it is preferred over others of the same joints.
    """

    name: str
    joints: tuple[str, ...]
    action_ns: str = ""
    type: str = "FollowJointTrajectory"
    default: bool = False
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class ExecutionSettings:
    """``trajectory_execution``: what is tolerated while a trajectory is executed.

    Attributes:
        manage_controllers: controllers may be switched.
        allowed_duration_scaling: a trajectory may take so many times its length,
        allowed_duration_margin_s: and so much longer.
        allowed_start_tolerance: how far the robot may be from the start, rad or m; 0 for any.
        duration_monitoring: a trajectory that takes too long is stopped.
        velocity_scaling: factor of the speed at execution.
        wait_for_completion: execution ends only when the robot stands still.
        joint_start_tolerances: `allowed_start_tolerance` of single joints.
    """

    manage_controllers: bool = True
    allowed_duration_scaling: float = 1.1
    allowed_duration_margin_s: float = 0.5
    allowed_start_tolerance: float = 0.01
    duration_monitoring: bool = True
    velocity_scaling: float = 1.0
    wait_for_completion: bool = True
    joint_start_tolerances: Mapping[str, float] = field(default_factory=dict)


def read_controllers(tree: Settings, joints: Collection[str]) -> tuple[ControllerEntry, ...]:
    """Read the controllers of ROS 1 (``controller_list``) or ROS 2 (names and branches).

    Args:
        tree: parameters of ``move_group``.
        joints: of the robot.
    """
    listed = tree.values.get("controller_list")
    if isinstance(listed, list):
        return _from_list(tree, listed, joints)
    for manager in _MANAGERS:
        branch = tree.branch(manager) if manager in tree.values else tree
        inner = branch.values.get("controller_list")
        if isinstance(inner, list):
            return _from_list(branch, inner, joints)
        names = branch.texts("controller_names")
        if names:
            return tuple(_from_branch(branch, name, joints) for name in names)
    return ()


def read_execution(tree: Settings) -> ExecutionSettings:
    """Read ``moveit_manage_controllers`` and the branch ``trajectory_execution``."""
    default = ExecutionSettings()
    branch = tree.branch("trajectory_execution")
    branch.check_keys(keys_of(EXECUTION))

    def number(key: str, value: float) -> float:
        found = branch.number(key)
        return value if found is None else found

    def flag(settings: Settings, key: str, value: bool) -> bool:
        found = settings.flag(key)
        return value if found is None else found

    watched = flag(branch, "execution_duration_monitoring", default.duration_monitoring)
    tolerances = branch.branch("allowed_start_tolerance_joints")
    by_joint = {key: tolerances.number(key) for key in tolerances.values}
    return ExecutionSettings(
        flag(tree, "moveit_manage_controllers", default.manage_controllers),
        number("allowed_execution_duration_scaling", default.allowed_duration_scaling),
        number("allowed_goal_duration_margin", default.allowed_duration_margin_s),
        number("allowed_start_tolerance", default.allowed_start_tolerance),
        watched,
        number("execution_velocity_scaling", default.velocity_scaling),
        flag(branch, "wait_for_trajectory_completion", default.wait_for_completion),
        {key: value for key, value in by_joint.items() if value is not None},
    )


def _from_list(
    tree: Settings, rows: list[Any], joints: Collection[str]
) -> tuple[ControllerEntry, ...]:
    found: list[ControllerEntry] = []
    for index, row in enumerate(rows):
        path = (*tree.path, "controller_list", str(index))
        values = row if isinstance(row, Mapping) else {}
        settings = Settings(values, tree.diagnostics, path, tree.spans)
        name = settings.text("name").strip("/")
        if not name:
            message = f"entry {index + 1} of controller_list has no name; it is left out"
            tree.diagnostics.report("moveit.controller", message, settings.span())
            continue
        found.append(_entry(settings, name, joints))
    return tuple(found)


def _from_branch(branch: Settings, name: str, joints: Collection[str]) -> ControllerEntry:
    if name not in branch.values:
        message = f"controller_names has '{name}', which is not described below it"
        message += f" (no parameters for controller '{name}')"
        fix = f"add {name}: with action_ns, type and joints"
        span = branch.span("controller_names")
        branch.diagnostics.report("moveit.controller", message, span, fix=fix)
    return _entry(branch.branch(name), name, joints)


def _entry(settings: Settings, name: str, joints: Collection[str]) -> ControllerEntry:
    settings.check_keys(("name", *keys_of(CONTROLLER)))
    named = settings.texts("joints")
    for joint in named:
        settings.check_name(joint, "joint", joints)
    return ControllerEntry(
        name,
        tuple(joint for joint in named if joint in joints),
        settings.text("action_ns"),
        settings.text("type", "FollowJointTrajectory"),
        bool(settings.flag("default")),
        settings.span(),
    )
