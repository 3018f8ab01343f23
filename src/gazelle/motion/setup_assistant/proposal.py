"""A whole configuration that a robot suggests; a person changes what he knows better."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from gazelle.description.model import Model
from gazelle.description.srdf import EndEffector, Group, Srdf, VirtualJoint
from gazelle.diagnostics import Diagnostics
from gazelle.motion.model import JointKind, RobotModel
from gazelle.motion.setup_assistant.config import (
    Author,
    KinematicsChoice,
    RobotSource,
    RosVersion,
    SetupAssistantConfig,
)
from gazelle.motion.setup_assistant.hardware import (
    added_joints,
    command_interfaces,
    controllers_for,
    has_manager_plugin,
    joint_limits_for,
)
from gazelle.motion.setup_assistant.kinematic_tree import KinematicTree
from gazelle.motion.setup_assistant.named_poses import initial_positions, named_poses
from gazelle.motion.setup_assistant.self_collisions import Progress, self_collision_matrix

__all__ = [
    "CollisionSearch",
    "kinematics_for",
    "package_name_for",
    "passive_joints_for",
    "propose",
    "regrouped",
    "virtual_joints_for",
    "with_groups",
]

_ALL_DIRECTIONS = 6


@dataclass(frozen=True)
class CollisionSearch:
    """How pairs that need no collision check are looked for.

    Attributes:
        trials: random configurations; MoveIt calls it density.
        always_fraction: from this share of collisions on a pair counts as always colliding.
        seed: of the configurations.
        progress: is told how much is done, 0 to 1.
        include_never: look for pairs that never collide, which takes the longest.
    """

    trials: int = 10_000
    always_fraction: float = 0.95
    seed: int = 0
    progress: Progress | None = None
    include_never: bool = True


def propose(
    model: Model,
    source: RobotSource,
    *,
    diagnostics: Diagnostics,
    ros_version: RosVersion = 2,
    package_name: str = "",
    groups: tuple[Sequence[Group], Sequence[EndEffector]] | None = None,
    search: CollisionSearch | None = None,
    author: Author | None = None,
) -> SetupAssistantConfig:
    """Return a configuration for a robot.

    Args:
        model: the robot.
        source: where it was read from.
        diagnostics: receives what cannot be planned for or collided.
        ros_version: which ROS the package is for.
        package_name: of the package; ``ROBOT_moveit_config`` when empty.
        groups: planning groups and end effectors; what the kinematic tree suggests when None.
        search: of pairs that need no collision check; usual numbers when None.
        author: who maintains the package.
    """
    search = search or CollisionSearch()
    bare = RobotModel.build(model, diagnostics=diagnostics)
    matrix = self_collision_matrix(
        bare,
        trials=search.trials,
        always_fraction=search.always_fraction,
        include_never=search.include_never,
        seed=search.seed,
        progress=search.progress,
        diagnostics=diagnostics,
    )
    srdf = Srdf(
        model.name,
        virtual_joints=virtual_joints_for(bare),
        passive_joints=passive_joints_for(bare, model, ros_version),
        disabled_pairs=matrix.disabled(),
    )
    config = SetupAssistantConfig(
        package_name or package_name_for(model.name),
        ros_version,
        source,
        srdf,
        collision_trials=search.trials,
        always_fraction=search.always_fraction,
        author=author or Author(),
    )
    return with_groups(config, model, *(groups or KinematicTree(bare).groups()))


def with_groups(
    config: SetupAssistantConfig,
    model: Model,
    groups: Sequence[Group],
    end_effectors: Sequence[EndEffector],
) -> SetupAssistantConfig:
    """Return a configuration with other groups, and all that follows from them proposed anew.

    Args:
        config: what was chosen so far.
        model: the robot.
        groups: planning groups.
        end_effectors: those among them that are mounted on others.
    """
    told = Diagnostics()
    srdf = replace(config.srdf, groups=tuple(groups), end_effectors=tuple(end_effectors))
    srdf = replace(srdf, states=named_poses(RobotModel.build(model, srdf, diagnostics=told)))
    robot = RobotModel.build(model, srdf, diagnostics=told)
    interfaces = command_interfaces(model, config.ros_version)
    solvers = kinematics_for(robot)
    return replace(
        config,
        srdf=srdf,
        kinematics=solvers,
        planners=dict.fromkeys(solvers, "RRTConnect") if config.ros_version == 1 else {},
        joint_limits=joint_limits_for(model, interfaces),
        controllers=controllers_for(robot, interfaces, config.ros_version),
        command_interfaces=interfaces,
        added_joints=added_joints(model, interfaces, config.ros_version),
        adds_plugin=not has_manager_plugin(model),
        initial_positions=initial_positions(robot, interfaces),
    )


def regrouped(
    config: SetupAssistantConfig,
    model: Model,
    groups: Sequence[Group],
    end_effectors: Sequence[EndEffector],
) -> SetupAssistantConfig:
    """Return a configuration with other groups; what was chosen for those that stay is kept.

    Args:
        config: what was chosen so far.
        model: the robot.
        groups: planning groups.
        end_effectors: those among them that are mounted on others.
    """
    fresh = with_groups(config, model, groups, end_effectors)
    old = {group.name: replace(group, span=None) for group in config.srdf.groups}
    kept = {group.name for group in groups if old.get(group.name) == replace(group, span=None)}
    states = [
        *(state for state in config.srdf.states if state.group in kept),
        *(state for state in fresh.srdf.states if state.group not in kept),
    ]
    solvers = {
        group: config.kinematics.get(group, choice) if group in kept else choice
        for group, choice in fresh.kinematics.items()
    }
    told = Diagnostics()
    robot = RobotModel.build(model, fresh.srdf, diagnostics=told)
    joints = {joint for name in kept if name in robot.groups for joint in robot.groups[name].joints}
    controllers = [item for item in config.controllers if set(item.joints) <= joints]
    taken = {joint for item in controllers for joint in item.joints}
    controllers += [item for item in fresh.controllers if not taken & set(item.joints)]
    return replace(
        config,
        srdf=replace(fresh.srdf, states=tuple(states)),
        kinematics=solvers,
        planners={group: config.planners.get(group, "RRTConnect") for group in fresh.planners},
        controllers=tuple(controllers),
        initial_positions={**fresh.initial_positions, **config.initial_positions},
    )


def kinematics_for(robot: RobotModel) -> dict[str, KinematicsChoice]:
    """Return a solver for each chain that is no hand; short chains reach positions only."""
    hands = {effector.group for effector in robot.srdf.end_effectors}
    return {
        name: KinematicsChoice(position_only=len(group.variables) < _ALL_DIRECTIONS)
        for name, group in robot.groups.items()
        if name not in hands and group.is_chain
    }


def package_name_for(robot_name: str) -> str:
    """Return the name that MoveIt gives a robot's config package."""
    name = re.sub(r"[^a-z0-9]+", "_", robot_name.lower()).strip("_").lstrip("0123456789_")
    return f"{name or 'robot'}_moveit_config"


def virtual_joints_for(robot: RobotModel) -> tuple[VirtualJoint, ...]:
    """Return how the robot's root is held: to ``world``, on wheels free in the plane.

    A robot whose root link is ``world`` needs none.
    """
    root = robot.root_link
    if root == "world":
        return ()
    if KinematicTree(robot).has_wheels:
        return (VirtualJoint("virtual_joint", "planar", "odom", root),)
    return (VirtualJoint("virtual_joint", "fixed", "world", root),)


def passive_joints_for(robot: RobotModel, model: Model, ros_version: RosVersion) -> tuple[str, ...]:
    """Return joints that nothing drives: mimicking ones, and those without a motor."""
    driven = command_interfaces(model, ros_version)
    return tuple(
        joint.name
        for joint in robot.joints[1:]
        if joint.kind is not JointKind.FIXED and (joint.mimic or joint.name not in driven)
    )
