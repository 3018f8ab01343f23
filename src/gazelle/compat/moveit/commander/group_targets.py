"""Where a group shall go: the targets of MoveGroupCommander."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from gazelle.compat.moveit.commander.conversions import list_to_pose_stamped, pose_of_list
from gazelle.compat.moveit.commander.exception import MoveItCommanderException
from gazelle.compat.moveit.commander.group_settings import GroupSettings
from gazelle.compat.moveit.move_group_client import MoveGroupClient
from gazelle.compat.moveit.robot_interface import RobotView
from gazelle.diagnostics import did_you_mean
from gazelle.errors import NotFoundError
from gazelle.geometry import Pose, quat_xyzw_from_rpy
from gazelle.interfaces import service_type
from gazelle.nodes.move_group.constraint_messages import pose_of
from gazelle.nodes.move_group.shape_messages import pose_message

__all__ = ["GroupTargets"]

_NO_TIP = "There is no end effector to set the pose for"


class GroupTargets(GroupSettings):
    """The joints and the end effector of a group, and targets for them."""

    def __init__(self, robot: RobotView, client: MoveGroupClient, name: str) -> None:
        """Look at a group.

        Raises:
            RuntimeError: there is none of this name.
        """
        super().__init__(*_scaling(client))
        self._robot = robot
        self._client = client
        try:
            self._group = robot.group(name)
        except NotFoundError as error:
            raise RuntimeError(f"Group '{name}' was not found.\n{error}") from error
        self._tip = self._group.tip_links[0] if len(self._group.tip_links) == 1 else ""
        self._frame = robot.model.frame
        self._remembered: dict[str, list[float]] = {}
        self._rng = np.random.default_rng()

    def get_active_joints(self) -> list[str]:
        """Return the joints that the group drives."""
        return list(self._group.active_joints)

    def get_joints(self) -> list[str]:
        """Return all joints of the group, fixed ones too."""
        return list(self._group.joints)

    def get_variable_count(self) -> int:
        """Return how many numbers say where the group is."""
        return len(self._group.variables)

    def has_end_effector_link(self) -> bool:
        """Return whether there is a link that poses are for."""
        return bool(self._tip)

    def get_end_effector_link(self) -> str:
        """Return the link that poses are for, empty when there is none."""
        return self._tip

    def set_end_effector_link(self, link_name: str) -> None:
        """Choose the link that poses are for.

        Raises:
            MoveItCommanderException: the robot has no such link.
        """
        if link_name not in self._robot.model.links:
            hint = did_you_mean(link_name, self._robot.model.links)
            raise MoveItCommanderException(f"Unable to set end effector link '{link_name}'; {hint}")
        self._tip = link_name

    def get_pose_reference_frame(self) -> str:
        """Return the frame of poses that name none."""
        return self._frame

    def set_pose_reference_frame(self, reference_frame: str) -> None:
        """Set the frame of poses that name none."""
        self._frame = reference_frame

    def get_planning_frame(self) -> str:
        """Return the frame that everything is planned in."""
        return self._robot.model.frame

    def get_current_joint_values(self) -> list[float]:
        """Return where the group is, rad or m."""
        found: list[float] = self._group.take(self._robot.positions()).tolist()
        return found

    def get_current_pose(self, end_effector_link: str = "") -> Any:
        """Return the pose of the end effector in the planning frame.

        Raises:
            MoveItCommanderException: there is none.
        """
        link = self._link(end_effector_link, "There is no end effector to get the pose of")
        pose = self._robot.link_pose(link)
        values = [*pose.position_m, *pose.quat_xyzw]
        return list_to_pose_stamped(values, self._robot.model.frame)

    def get_current_rpy(self, end_effector_link: str = "") -> list[float]:
        """Return roll, pitch and yaw of the end effector, rad.

        Raises:
            MoveItCommanderException: there is none.
        """
        link = self._link(end_effector_link, "There is no end effector to get the rpy of")
        return list(self._robot.link_pose(link).rpy_rad)

    def get_random_joint_values(self) -> list[float]:
        """Return a configuration drawn from within the limits."""
        found: list[float] = self._group.space.sample(self._rng).tolist()
        return found

    def get_random_pose(self, end_effector_link: str = "") -> Any:
        """Return a pose that the end effector can have.

        Raises:
            MoveItCommanderException: there is no end effector.
        """
        link = self._link(end_effector_link, "There is no end effector to get the pose of")
        model = self._robot.model
        q = self._group.space.sample(self._rng)
        where = model.with_group(self._group, q, self._robot.positions())
        pose = self._robot.link_pose(link, where)
        return list_to_pose_stamped([*pose.position_m, *pose.quat_xyzw], model.frame)

    def get_joint_value_target(self) -> list[float]:
        """Return the joint target; joints that none was set for are where they are now."""
        now = dict(zip(self._group.variables, self.get_current_joint_values(), strict=True))
        return list({**now, **(self._targets.joints or {})}.values())

    def set_joint_value_target(self, arg1: Any, arg2: Any = None, arg3: Any = None) -> None:
        """Set positions of joints: a list, a dictionary, a ``JointState``, or name and value.

        A pose, with the link it is for, is solved by inverse kinematics first.

        Raises:
            MoveItCommanderException: the arguments make no joint target.
        """
        if hasattr(arg1, "position") and hasattr(arg1, "name"):
            values = dict(zip(arg1.name, arg1.position, strict=False))
        elif isinstance(arg1, str):
            values = {arg1: arg2[0] if isinstance(arg2, list | tuple) else arg2}
        elif hasattr(arg1, "pose") or hasattr(arg1, "orientation"):
            values = self._solved(arg1, arg2 if isinstance(arg2, str) else "", bool(arg3))
        elif isinstance(arg1, Mapping):
            values = dict(arg1)
        else:
            values = self._listed(arg1)
        unknown = [name for name in values if name not in self._robot.model.variables]
        if unknown:
            hint = did_you_mean(unknown[0], self._group.variables)
            text = f"Error setting joint target: the robot has no joint '{unknown[0]}'; {hint}"
            raise MoveItCommanderException(text)
        own = {name: value for name, value in values.items() if name in self._group.variables}
        self._check_limits(own)
        now = dict(zip(self._group.variables, self.get_current_joint_values(), strict=True))
        self._targets.set_joints({**now, **(self._targets.joints or {}), **own})

    def set_pose_target(self, pose: Any, end_effector_link: str = "") -> None:
        """Set a pose of the end effector: a message, or 6 or 7 numbers.

        Raises:
            MoveItCommanderException: there is no end effector, or the numbers are no pose.
        """
        self.set_pose_targets([pose], end_effector_link)

    def set_pose_targets(self, poses: Sequence[Any], end_effector_link: str = "") -> None:
        """Set poses of the end effector, any of which will do.

        Raises:
            MoveItCommanderException: there is no end effector, or the numbers are no pose.
        """
        link = self._link(end_effector_link, _NO_TIP)
        found = [self._pose(pose) for pose in poses]
        frame = found[0][0] if found else self._frame
        self._targets.set_poses(link, frame, [pose for _, pose in found])

    def set_position_target(self, xyz: Sequence[float], end_effector_link: str = "") -> None:
        """Set where the end effector shall be, however it is turned.

        Raises:
            MoveItCommanderException: there is no end effector.
        """
        link = self._link(end_effector_link, _NO_TIP)
        self._targets.set_part(link, self._frame, position_m=[float(value) for value in xyz])

    def set_orientation_target(self, q: Sequence[float], end_effector_link: str = "") -> None:
        """Set how the end effector shall be turned (x, y, z, w), wherever it is.

        Raises:
            MoveItCommanderException: there is no end effector, or there are not 4 numbers.
        """
        if len(q) != 4:
            raise MoveItCommanderException("Expected [qx, qy, qz, qw]")
        link = self._link(end_effector_link, _NO_TIP)
        self._targets.set_part(link, self._frame, quat_xyzw=[float(value) for value in q])

    def set_rpy_target(self, rpy: Sequence[float], end_effector_link: str = "") -> None:
        """Set how the end effector shall be turned (roll, pitch, yaw), wherever it is.

        Raises:
            MoveItCommanderException: there is no end effector, or there are not 3 numbers.
        """
        if len(rpy) != 3:
            raise MoveItCommanderException("Expected [roll, pitch, yaw]")
        roll, pitch, yaw = (float(value) for value in rpy)
        self.set_orientation_target(quat_xyzw_from_rpy((roll, pitch, yaw)), end_effector_link)

    def shift_pose_target(self, axis: int, value: float, end_effector_link: str = "") -> None:
        """Shift the pose target, or the present pose, along x, y, z or about roll, pitch, yaw.

        Raises:
            MoveItCommanderException: there is no end effector, or the axis is not 0 to 5.
        """
        link = self._link(end_effector_link, _NO_TIP)
        if not 0 <= axis < 6:
            raise MoveItCommanderException("An axis value between 0 and 5 expected")
        start = (self._robot.model.frame, self._robot.link_pose(link))
        self._targets.shifted(link, axis, float(value), start)

    def clear_pose_target(self, end_effector_link: str = "") -> None:
        """Forget the pose targets of a link."""
        self._targets.clear(end_effector_link or self._tip)

    def clear_pose_targets(self) -> None:
        """Forget all pose targets."""
        self._targets.clear()

    def set_random_target(self) -> None:
        """Set a joint target drawn from within the limits."""
        self.set_joint_value_target(self.get_random_joint_values())

    def get_named_targets(self) -> list[str]:
        """Return the names that `set_named_target` knows."""
        return [*self._group.states, *self._remembered]

    def set_named_target(self, name: str) -> None:
        """Set a state of the SRDF, or one that was remembered.

        Raises:
            MoveItCommanderException: there is none of this name.
        """
        self.set_joint_value_target(self.get_named_target_values(name))

    def get_named_target_values(self, target: str) -> dict[str, float]:
        """Return the positions of a named target, by joint.

        Raises:
            MoveItCommanderException: there is none of this name.
        """
        if target in self._remembered:
            return dict(zip(self._group.variables, self._remembered[target], strict=False))
        if target not in self._group.states:
            hint = did_you_mean(target, self.get_named_targets())
            text = f"Unable to set target {target}. Is the target within bounds? There is no "
            raise MoveItCommanderException(f"{text}state of this name; {hint}")
        return dict(self._group.states[target])

    def remember_joint_values(self, name: str, values: Sequence[float] | None = None) -> None:
        """Give a name to positions, or to where the group is."""
        found = self.get_current_joint_values() if values is None else values
        self._remembered[name] = [float(value) for value in found]

    def get_remembered_joint_values(self) -> dict[str, list[float]]:
        """Return what was remembered."""
        return dict(self._remembered)

    def forget_joint_values(self, name: str) -> None:
        """Forget what was remembered under a name."""
        self._remembered.pop(name, None)

    def _link(self, name: str, otherwise: str) -> str:
        link = name or self._tip
        if not link:
            raise MoveItCommanderException(otherwise)
        return link

    def _pose(self, pose: Any) -> tuple[str, Pose]:
        if hasattr(pose, "pose"):
            return pose.header.frame_id or self._frame, pose_of(pose.pose)
        if hasattr(pose, "orientation"):
            return self._frame, pose_of(pose)
        return self._frame, pose_of_list(pose)

    def _listed(self, values: Any) -> dict[str, float]:
        names = self._group.variables
        try:
            numbers = [float(value) for value in values]
        except TypeError as error:
            text = f"Unsupported argument of type {type(values)}"
            raise MoveItCommanderException(text) from error
        if len(numbers) != len(names):
            text = f"Error setting joint target: {len(numbers)} values for {len(names)} joints "
            raise MoveItCommanderException(f"{text}({', '.join(names)})")
        return dict(zip(names, numbers, strict=True))

    def _check_limits(self, values: Mapping[str, float]) -> None:
        space = self._group.space
        now = dict(zip(space.names, self.get_current_joint_values(), strict=True))
        beyond = space.outside(space.array({**now, **values}), 1e-6)
        mine = [text for text in beyond if any(f"'{name}'" in text for name in values)]
        if mine:
            text = "Error setting joint target. Is the target within bounds? "
            raise MoveItCommanderException(text + "; ".join(mine))

    def _solved(self, pose: Any, link: str, approximate: bool) -> dict[str, float]:
        frame, target = self._pose(pose)
        if approximate:
            text = "approximate inverse kinematics is not there; give a pose that can be reached"
            raise MoveItCommanderException(text)
        answer = self._ask_ik(frame, target, link)
        if answer.error_code.val != 1:
            text = "Error setting joint target. "
            raise MoveItCommanderException(text + answer.error_code.message)
        state = answer.solution.joint_state
        return dict(zip(state.name, map(float, state.position), strict=True))

    def _ask_ik(self, frame: str, target: Pose, link: str) -> Any:
        request: Any = service_type("moveit_msgs/GetPositionIK").Request()
        ask = request.ik_request
        ask.group_name, ask.ik_link_name = self._group.name, link or self._tip
        ask.pose_stamped.header.frame_id = frame
        ask.pose_stamped.pose = pose_message(target)
        return self._client.call("compute_ik", "GetPositionIK", request)


def _scaling(client: MoveGroupClient) -> tuple[float, float]:
    """Return the defaults of joint_limits.yaml, as MoveGroupInterface reads them."""
    store = client.node.parameters
    found = []
    for kind in ("velocity", "acceleration"):
        name = store.search(f"robot_description_planning/default_{kind}_scaling_factor")
        # The search is for the first part of the name alone, as in ROS.
        value = store.get(name, 0.1) if name else 0.1
        found.append(float(value) if 0 < float(value) <= 1 else 0.1)
    return found[0], found[1]
