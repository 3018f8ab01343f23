"""RobotModel, JointModelGroup, RobotState and RobotTrajectory of moveit_py."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.geometry import Pose
from gazelle.interfaces import convert, message_type
from gazelle.motion import model as motion_model
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.kinematics import Patience, Solver, link_poses
from gazelle.motion.model import JointGroup
from gazelle.motion.timing import Trajectory
from gazelle.nodes.move_group.constraint_messages import pose_of
from gazelle.nodes.move_group.robot_state_messages import (
    positions_of,
    robot_state_message,
    robot_trajectory,
)
from gazelle.nodes.move_group.shape_messages import pose_message

__all__ = ["JointModelGroup", "RobotModel", "RobotState", "RobotTrajectory"]

_NANO = 1_000_000_000


class JointModelGroup:
    """A planning group."""

    def __init__(self, group: JointGroup) -> None:
        self._group = group
        self.name = group.name
        self.joint_model_names = list(group.joints)
        self.active_joint_model_names = list(group.active_joints)
        self.link_model_names = list(group.links)
        self.eef_name = next(iter(group.end_effectors), "")

    def satisfies_position_bounds(self, values: Any, margin: float = 0.0) -> bool:
        """Return whether positions are within the limits."""
        return not self._group.space.outside(np.asarray(values, float), margin)


class RobotModel:
    """A robot's joints, links and groups."""

    def __init__(self, robot: motion_model.RobotModel) -> None:
        self._robot = robot
        self.name = robot.name
        self.model_frame = robot.frame
        self.root_joint_name = robot.joints[0].name
        self.joint_model_group_names = list(robot.groups)

    @property
    def joint_model_groups(self) -> list[JointModelGroup]:
        """All planning groups."""
        return [JointModelGroup(group) for group in self._robot.groups.values()]

    def has_joint_model_group(self, joint_model_group_name: str) -> bool:
        """Return whether there is a group of this name."""
        return joint_model_group_name in self._robot.groups

    def get_joint_model_group(self, joint_model_group_name: str) -> JointModelGroup:
        """Return a group.

        Raises:
            NotFoundError: there is none of this name.
        """
        return JointModelGroup(self._robot.group(joint_model_group_name))


class RobotState:
    """Where a robot's joints are."""

    def __init__(self, robot_model: RobotModel) -> None:
        self.robot_model = robot_model
        self._robot = robot_model._robot
        self._positions = self._robot.default_positions()

    @property
    def joint_positions(self) -> dict[str, float]:
        """All positions by joint, rad or m; setting changes those that are named."""
        return self._robot.named(self._positions)

    @joint_positions.setter
    def joint_positions(self, values: dict[str, float]) -> None:
        self._positions = self._robot.positions(values, self._positions)

    def update(self, force: bool = False, category: str = "all") -> None:
        """Do nothing: poses follow positions at once."""

    def get_joint_group_positions(self, joint_model_group_name: str) -> FloatArray:
        """Return the positions of a group, of shape (variables,), rad or m."""
        return self._robot.group(joint_model_group_name).take(self._positions)

    def set_joint_group_positions(self, joint_model_group_name: str, position_values: Any) -> None:
        """Set the positions of a group.

        Raises:
            ValueError: there are too few or too many.
        """
        group = self._robot.group(joint_model_group_name)
        q = group.space.array([float(value) for value in position_values])
        self._positions = self._robot.with_group(group, q, self._positions)

    def set_to_default_values(self, joint_model_group_name: str = "", name: str = "") -> bool:
        """Set a state of the SRDF, or where MoveIt puts a robot by itself without a name."""
        if not name:
            self._positions = self._robot.default_positions()
            return True
        states = self._robot.group(joint_model_group_name).states
        if name not in states:
            return False
        self._positions = self._robot.positions(states[name], self._positions)
        return True

    def set_to_random_positions(self, joint_model_group: JointModelGroup | None = None) -> None:
        """Draw positions from within the limits, of one group or of all."""
        rng = np.random.default_rng()
        groups = self._robot.groups.values()
        for group in groups if joint_model_group is None else [joint_model_group._group]:
            self._positions = self._robot.with_group(
                group, group.space.sample(rng), self._positions
            )

    def get_global_link_transform(self, link_name: str) -> FloatArray:
        """Return the pose of a link in the model's frame, 4×4."""
        return link_poses(self._robot, self._positions, [link_name])[link_name]

    def get_pose(self, link_name: str) -> Any:
        """Return the pose of a link in the model's frame as a ``Pose``."""
        return pose_message(Pose.from_matrix(self.get_global_link_transform(link_name)))

    def get_jacobian(
        self, joint_model_group_name: str, reference_point_position: Any = None
    ) -> FloatArray:
        """Return the 6×n Jacobian of a group's tip, or of a point in its frame."""
        tool = np.eye(4)
        if reference_point_position is not None:
            tool[:3, 3] = np.asarray(reference_point_position, float).reshape(3)
        solver = Solver(self._robot, joint_model_group_name, positions=self._positions)
        return solver.jacobian(self.get_joint_group_positions(joint_model_group_name),
                               T_link_tool=tool)  # fmt: skip

    def set_from_ik(
        self,
        joint_model_group_name: str,
        geometry_pose: Any,
        tip_name: str = "",
        timeout: float = 0.05,
    ) -> bool:
        """Bring a link to a pose of the model's frame; False when that cannot be."""
        solver = Solver(self._robot, joint_model_group_name, positions=self._positions)
        found = solver.ik(
            pose_of(geometry_pose).matrix(),
            seed_q=self.get_joint_group_positions(joint_model_group_name),
            patience=Patience(timeout_s=timeout or None),
            link=tip_name,
        )
        if found is not None:
            self.set_joint_group_positions(joint_model_group_name, found)
        return found is not None

    def message(self) -> Any:
        """Return the ``RobotState`` message."""
        return robot_state_message(
            self._robot, self._positions, frame=self._robot.frame, stamp_ns=0
        )

    def take(self, message: Any) -> None:
        """Take the positions of a ``RobotState`` message."""
        own = convert(message, message_type("moveit_msgs/msg/RobotState"))
        self._positions = positions_of(own, self._robot, self._positions)


class RobotTrajectory:
    """A planned motion."""

    def __init__(self, robot_model: RobotModel, trajectory: Trajectory, group: str) -> None:
        self.robot_model = robot_model
        self.joint_model_group_name = group
        self._trajectory = trajectory

    @property
    def duration(self) -> float:
        """How long it takes, s."""
        return self._trajectory.duration_s

    def __len__(self) -> int:
        return len(self._trajectory.times_s)

    def get_robot_trajectory_msg(self, joint_filter: list[str] | None = None) -> Any:
        """Return the ``RobotTrajectory`` message, of the named joints alone when some are named."""
        made = robot_trajectory(self._trajectory, frame=self.robot_model.model_frame)
        if joint_filter is not None:
            _keep_joints(made.joint_trajectory, joint_filter)
        return made


def _keep_joints(trajectory: Any, names: list[str]) -> None:
    """Leave only some joints in a ``JointTrajectory``, in its own order."""
    kept = [index for index, name in enumerate(trajectory.joint_names) if name in names]
    trajectory.joint_names = [trajectory.joint_names[index] for index in kept]
    for point in trajectory.points:
        for field in ("positions", "velocities", "accelerations", "effort"):
            values = getattr(point, field)
            if len(values):
                setattr(point, field, [values[index] for index in kept])
