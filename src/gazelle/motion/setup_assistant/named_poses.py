"""Named poses that a robot suggests: home of arms, open and close of hands."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from itertools import combinations

import numpy as np

from gazelle.description.srdf import GroupState
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.kinematics import link_poses
from gazelle.motion.model import JointGroup, RobotModel

__all__ = ["initial_positions", "named_poses", "pose_of"]

_HAND_NAMES = ("open", "close")


def named_poses(robot: RobotModel) -> tuple[GroupState, ...]:
    """Return a state ``home`` for each arm, ``open`` and ``close`` for each end effector."""
    hands = {effector.group for effector in robot.srdf.end_effectors}
    found: list[GroupState] = []
    for name, group in robot.groups.items():
        if name in hands:
            found += _hand_poses(robot, group)
        else:
            found.append(pose_of(robot, group, "home", {}))
    return tuple(found)


def pose_of(
    robot: RobotModel, group: JointGroup, name: str, values: Mapping[str, float]
) -> GroupState:
    """Return a named pose of a group; joints without a value are at their defaults.

    Args:
        robot: the robot.
        group: whose pose it is.
        name: of the pose.
        values: rad or m by joint.
    """
    at = robot.named(robot.positions(values))
    return GroupState(name, group.name, {joint: (at[joint],) for joint in group.variables})


def initial_positions(robot: RobotModel, driven: Collection[str]) -> dict[str, float]:
    """Return where driven joints begin, rad or m: at their group's first named pose."""
    at = robot.named(robot.default_positions())
    for group in robot.groups:
        for state in robot.srdf.states_of(group)[:1]:
            at |= {name: values[0] for name, values in state.values.items() if name in at}
    return {
        joint.name: at[joint.name]
        for joint in robot.joints[1:]
        if joint.name in driven and joint.variables == (joint.name,)
    }


def _hand_poses(robot: RobotModel, group: JointGroup) -> list[GroupState]:
    """Each joint goes to the end where the fingers are further apart."""
    ends: tuple[dict[str, float], dict[str, float]] = {}, {}
    for place, name in enumerate(group.variables):
        low, high = float(group.space.low[place]), float(group.space.high[place])
        spreads = [_spread(robot, group, {name: value}) for value in (low, high)]
        is_high = spreads[1] >= spreads[0]
        ends[0][name], ends[1][name] = (high, low) if is_high else (low, high)
    return [
        pose_of(robot, group, name, values) for name, values in zip(_HAND_NAMES, ends, strict=True)
    ]


def _spread(robot: RobotModel, group: JointGroup, values: Mapping[str, float]) -> float:
    """Return how far the group's links are from each other, m."""
    poses = link_poses(robot, robot.positions(values), list(group.links))
    centres = [_centre(robot, link, poses[link]) for link in group.links]
    return sum(float(np.linalg.norm(one - other)) for one, other in combinations(centres, 2))


def _centre(robot: RobotModel, link: str, T_frame_link: FloatArray) -> FloatArray:
    """Return a link's centre of mass (3,), m; its origin where it has none."""
    found = robot.description.link(link)
    inertial = None if found is None else found.inertial
    centre = (0.0, 0.0, 0.0) if inertial is None else inertial.T_link_com.position_m
    return np.asarray(T_frame_link[:3, :3] @ np.array(centre) + T_frame_link[:3, 3])
