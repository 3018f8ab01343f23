"""Goal constraints of moveit_py."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gazelle.compat.moveit.goal_constraints import joint_constraints, pose_constraints
from gazelle.compat.moveit.py.robot import JointModelGroup, RobotState

__all__ = ["construct_joint_constraint", "construct_link_constraint"]


def construct_joint_constraint(
    robot_state: RobotState, joint_model_group: JointModelGroup, tolerance: float = 0.01
) -> Any:
    """Return ``Constraints`` for a group's joints to be as in a state."""
    known = robot_state.joint_positions
    values = {name: known[name] for name in joint_model_group._group.variables}
    return joint_constraints(values, tolerance)


def construct_link_constraint(
    link_name: str,
    source_frame: str,
    cartesian_position: Sequence[float] | None = None,
    cartesian_position_tolerance: float | None = None,
    orientation: Sequence[float] | None = None,
    orientation_tolerance: float | None = None,
) -> Any:
    """Return ``Constraints`` for a link's position (m), orientation (x, y, z, w) or both."""
    return pose_constraints(
        link_name,
        source_frame,
        position_m=cartesian_position,
        quat_xyzw=orientation,
        position_tolerance_m=cartesian_position_tolerance or 1e-4,
        orientation_tolerance_rad=orientation_tolerance or 1e-3,
    )
