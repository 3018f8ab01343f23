"""MoveGroupCommander: plan, move and execute with one group."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from gazelle.compat.moveit.commander.conversions import list_to_pose_stamped, pose_of_list
from gazelle.compat.moveit.commander.exception import MoveItCommanderException
from gazelle.compat.moveit.commander.roscpp_initializer import client_of, robot_of, ros1
from gazelle.compat.moveit.goal_constraints import Targets
from gazelle.compat.moveit.move_group_client import MoveGroupClient
from gazelle.compat.warn_once import warn_once
from gazelle.diagnostics import did_you_mean
from gazelle.errors import NotFoundError
from gazelle.geometry import Pose, quat_xyzw_from_rpy
from gazelle.interfaces import (
    action_type,
    convert,
    message_type,
    ros1_message_type,
    service_type,
)
from gazelle.motion.timing import parameterise
from gazelle.nodes.move_group.constraint_messages import pose_of
from gazelle.nodes.move_group.robot_state_messages import (
    positions_of,
    robot_state_message,
    robot_trajectory,
)
from gazelle.nodes.move_group.shape_messages import pose_message

__all__ = ["MoveGroupCommander", "PlanResult"]

_MOVE = action_type("moveit_msgs/MoveGroup")
_SUCCESS = 1
_SCALING = "Expected value in the range from 0 to 1 for scaling factor"
_NO_TIP = "There is no end effector to set the pose for"
_TIME_OPTIMAL = "time_optimal_trajectory_generation"
_NO_PICK = (
    "cannot {}: move_group offers no actions 'pickup' and 'place' here. The same in steps: go() "
    "above it, compute_cartesian_path() down, the gripper's group to its closed state, "
    "attach_object(), compute_cartesian_path() up; examples/arm_ws has a whole program"
)


class PlanResult(tuple[bool, Any, float, Any]):
    """Success, trajectory, planning time and error code, as Noetic's ``plan()`` returns them.

    Kinetic's and Melodic's returned the trajectory alone; programs of their time find its fields
    here too.
    """

    __slots__ = ()

    @property
    def joint_trajectory(self) -> Any:
        """The trajectory's joints."""
        return self[1].joint_trajectory

    @property
    def multi_dof_joint_trajectory(self) -> Any:
        """The trajectory's joints with several variables."""
        return self[1].multi_dof_joint_trajectory


class MoveGroupCommander:
    """Plans and moves with one planning group.

    Args:
        name: of the group.
        robot_description: name of the parameter with the URDF.
        ns: namespace of move_group.
        wait_for_servers: how long to wait for move_group, s.

    Raises:
        RuntimeError: there is no move_group, robot or group.
    """

    def __init__(
        self,
        name: str,
        robot_description: str = "robot_description",
        ns: str = "",
        wait_for_servers: float = 5.0,
    ) -> None:
        client = client_of(ns)
        robot = robot_of(robot_description, ns)
        velocity_scaling, acceleration_scaling = _default_scaling(client)
        self._client = client
        self._robot = robot
        try:
            self._group = robot.group(name)
        except NotFoundError as error:
            raise RuntimeError(f"Group '{name}' was not found.\n{error}") from error
        self._tip = self._group.tip_links[0] if len(self._group.tip_links) == 1 else ""
        self._frame = robot.model.frame
        self._targets = Targets()
        self._remembered: dict[str, list[float]] = {}
        self._rng = np.random.default_rng()
        # As MoveGroupInterface begins: 5 s, one attempt, the robot's default speed.
        self._request: Any = message_type("moveit_msgs/msg/MotionPlanRequest")(
            num_planning_attempts=1,
            allowed_planning_time=5.0,
            max_velocity_scaling_factor=velocity_scaling,
            max_acceleration_scaling_factor=acceleration_scaling,
        )
        self._replan = False
        self._path_constraints: Any = None
        self._start: Any = None
        if not client.wait(max(0.0, wait_for_servers)):
            raise RuntimeError(
                f"Unable to connect to move_group action server 'move_group' within allotted time "
                f"({wait_for_servers:g}s)"
            )

    def get_name(self) -> str:
        """Return the group's name."""
        return self._group.name

    def stop(self) -> None:
        """Stop what is being executed."""
        self._client.stop()

    def get_interface_description(self) -> Any:
        """Return the first planner interface that move_group has."""
        answer = self._client.call("query_planner_interface", "QueryPlannerInterfaces")
        return ros1(answer.planner_interfaces[0])

    # The joints and the end effector of the group, and targets for them.

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
        link = self._link_or_tip(end_effector_link, "There is no end effector to get the pose of")
        pose = self._robot.link_pose(link)
        values = [*pose.position_m, *pose.quat_xyzw]
        return list_to_pose_stamped(values, self._robot.model.frame)

    def get_current_rpy(self, end_effector_link: str = "") -> list[float]:
        """Return roll, pitch and yaw of the end effector, rad.

        Raises:
            MoveItCommanderException: there is none.
        """
        link = self._link_or_tip(end_effector_link, "There is no end effector to get the rpy of")
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
        link = self._link_or_tip(end_effector_link, "There is no end effector to get the pose of")
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
            values = self._joints_of_pose(arg1, arg2 if isinstance(arg2, str) else "", bool(arg3))
        elif isinstance(arg1, Mapping):
            values = dict(arg1)
        else:
            values = self._joints_of_list(arg1)
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
        link = self._link_or_tip(end_effector_link, _NO_TIP)
        found = [self._stamped_pose(pose) for pose in poses]
        frame = found[0][0] if found else self._frame
        self._targets.set_poses(link, frame, [pose for _, pose in found])

    def set_position_target(self, xyz: Sequence[float], end_effector_link: str = "") -> None:
        """Set where the end effector shall be, however it is turned.

        Raises:
            MoveItCommanderException: there is no end effector.
        """
        link = self._link_or_tip(end_effector_link, _NO_TIP)
        self._targets.set_part(link, self._frame, position_m=[float(value) for value in xyz])

    def set_orientation_target(self, q: Sequence[float], end_effector_link: str = "") -> None:
        """Set how the end effector shall be turned (x, y, z, w), wherever it is.

        Raises:
            MoveItCommanderException: there is no end effector, or there are not 4 numbers.
        """
        if len(q) != 4:
            raise MoveItCommanderException("Expected [qx, qy, qz, qw]")
        link = self._link_or_tip(end_effector_link, _NO_TIP)
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
        link = self._link_or_tip(end_effector_link, _NO_TIP)
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

    # How it plans: what is set once and stays.

    def get_goal_tolerance(self) -> tuple[float, float, float]:
        """Return the tolerances of joints, position and orientation."""
        goal = self._targets
        return (goal.joint_tolerance, goal.position_tolerance_m, goal.orientation_tolerance_rad)

    def get_goal_joint_tolerance(self) -> float:
        """Return the tolerance of joint goals, rad or m."""
        return self._targets.joint_tolerance

    def get_goal_position_tolerance(self) -> float:
        """Return the radius of the sphere a position goal allows, m."""
        return self._targets.position_tolerance_m

    def get_goal_orientation_tolerance(self) -> float:
        """Return the tolerance of orientation goals about each axis, rad."""
        return self._targets.orientation_tolerance_rad

    def set_goal_tolerance(self, value: float) -> None:
        """Set all three tolerances."""
        self.set_goal_joint_tolerance(value)
        self.set_goal_position_tolerance(value)
        self.set_goal_orientation_tolerance(value)

    def set_goal_joint_tolerance(self, value: float) -> None:
        """Set the tolerance of joint goals, rad or m."""
        self._targets.joint_tolerance = float(value)

    def set_goal_position_tolerance(self, value: float) -> None:
        """Set the radius of the sphere a position goal allows, m."""
        self._targets.position_tolerance_m = float(value)

    def set_goal_orientation_tolerance(self, value: float) -> None:
        """Set the tolerance of orientation goals about each axis, rad."""
        self._targets.orientation_tolerance_rad = float(value)

    def allow_replanning(self, value: bool) -> None:
        """Plan again when the scene changes while the robot moves."""
        self._replan = bool(value)

    def allow_looking(self, value: bool) -> None:
        """Refuse to look around, which nothing here can.

        Raises:
            MoveItCommanderException: it is asked for.
        """
        if value:
            raise MoveItCommanderException("looking around while moving is not implemented")

    def set_planning_time(self, seconds: float) -> None:
        """Set how long planning may take, s."""
        self._request.allowed_planning_time = float(seconds)

    def get_planning_time(self) -> float:
        """Return how long planning may take, s."""
        return float(self._request.allowed_planning_time)

    def set_planning_pipeline_id(self, planning_pipeline: str) -> None:
        """Choose a pipeline."""
        self._request.pipeline_id = planning_pipeline

    def get_planning_pipeline_id(self) -> str:
        """Return the pipeline chosen, empty for the default one."""
        return str(self._request.pipeline_id)

    def set_planner_id(self, planner_id: str) -> None:
        """Choose a planner."""
        self._request.planner_id = planner_id

    def get_planner_id(self) -> str:
        """Return the planner chosen, empty for the default one."""
        return str(self._request.planner_id)

    def set_num_planning_attempts(self, num_planning_attempts: int) -> None:
        """Plan so many times and take the shortest path."""
        self._request.num_planning_attempts = int(num_planning_attempts)

    def set_workspace(self, ws: list[float]) -> None:
        """Bound where a robot that drives may go: nothing, 4 or 6 numbers.

        Raises:
            MoveItCommanderException: there are other than 0, 4 or 6 numbers.
        """
        if len(ws) not in (0, 4, 6):
            text = "Expected 0, 4 or 6 values in list specifying workspace"
            raise MoveItCommanderException(text)
        bounds = self._request.workspace_parameters
        low, high = bounds.min_corner, bounds.max_corner
        numbers = [float(value) for value in ws]
        if len(numbers) == 4:
            low.x, low.y, high.x, high.y = numbers
        elif len(numbers) == 6:
            low.x, low.y, low.z, high.x, high.y, high.z = numbers

    def set_max_velocity_scaling_factor(self, value: float) -> None:
        """Set the share of the velocity limits that is used.

        Raises:
            MoveItCommanderException: it is not above 0 and at most 1.
        """
        if not 0 < value <= 1:
            raise MoveItCommanderException(_SCALING)
        self._request.max_velocity_scaling_factor = float(value)

    def set_max_acceleration_scaling_factor(self, value: float) -> None:
        """Set the share of the acceleration limits that is used.

        Raises:
            MoveItCommanderException: it is not above 0 and at most 1.
        """
        if not 0 < value <= 1:
            raise MoveItCommanderException(_SCALING)
        self._request.max_acceleration_scaling_factor = float(value)

    def limit_max_cartesian_link_speed(self, speed: float, link_name: str = "") -> None:
        """Let a link, the end effector's when none is named, move no faster than so many m/s.

        Raises:
            MoveItCommanderException: the speed is not above 0.
        """
        if speed <= 0:
            raise MoveItCommanderException("Expected speed value to be greater than 0")
        self._request.max_cartesian_speed = float(speed)
        self._request.cartesian_speed_limited_link = link_name

    def clear_max_cartesian_link_speed(self) -> None:
        """Take the limit of a link's speed away."""
        self._request.max_cartesian_speed = 0.0
        self._request.cartesian_speed_limited_link = ""

    def get_path_constraints(self) -> Any:
        """Return what must hold all along a path, empty ``Constraints`` when nothing must."""
        kind = ros1_message_type("moveit_msgs/Constraints")
        return kind() if self._path_constraints is None else self._path_constraints

    def set_path_constraints(self, value: Any) -> None:
        """Set what must hold all along a path; None takes it away.

        Raises:
            MoveItCommanderException: it is something else than ``Constraints``.
        """
        if value is not None and not hasattr(value, "joint_constraints"):
            text = "Unable to set path constraints, unknown constraint type "
            raise MoveItCommanderException(f"{text}{type(value)}")
        self._path_constraints = value

    def clear_path_constraints(self) -> None:
        """Take path constraints away."""
        self._path_constraints = None

    # Planning and moving.

    def set_start_state_to_current_state(self) -> None:
        """Plan from where the robot is."""
        self._start = None

    def set_start_state(self, msg: Any) -> None:
        """Plan from a ``RobotState``."""
        self._start = convert(msg, message_type("moveit_msgs/msg/RobotState"))

    def get_current_state(self) -> Any:
        """Return the ``RobotState`` of now."""
        robot = self._robot
        now_ns = self._client.node.clock.now_ns()
        frame = robot.model.frame
        return ros1(
            robot_state_message(robot.model, robot.positions(), frame=frame, stamp_ns=now_ns)
        )

    def get_current_state_bounded(self) -> Any:
        """Return the ``RobotState`` of now, moved into the limits."""
        return self.enforce_bounds(self.get_current_state())

    def enforce_bounds(self, robot_state_msg: Any) -> Any:
        """Return a ``RobotState`` moved into the limits."""
        model = self._robot.model
        positions = self._positions_of(robot_state_msg)
        for group in model.groups.values():
            inside = group.space.clamped(group.take(positions))
            positions = model.with_group(group, inside, positions)
        return ros1(robot_state_message(model, positions, frame=model.frame, stamp_ns=0))

    def go(self, joints: Any = None, wait: bool = True) -> bool:
        """Plan to the target and move there; True when the robot is there.

        Args:
            joints: a target, as for `plan`; with True or False it is `wait`.
            wait: until the end; else True only says that the goal was sent.
        """
        if isinstance(joints, bool):
            wait, joints = joints, None
        self._take_target(joints)
        goal = self._goal(plan_only=False)
        result = self._client.move(goal, wait=wait)
        return result is None or self._is_good(result, "move")

    def plan(self, joints: Any = None) -> PlanResult:
        """Plan to the target.

        Args:
            joints: a target to set before: positions, a pose, or a remembered name.
        """
        self._take_target(joints)
        result = self._client.move(self._goal(plan_only=True))
        good = self._is_good(result, "plan")
        trajectory, code = ros1(result.planned_trajectory), ros1(result.error_code)
        return PlanResult((good, trajectory, float(result.planning_time), code))

    def construct_motion_plan_request(self) -> Any:
        """Return the ``MotionPlanRequest`` that `plan` would send."""
        return ros1(self._goal(plan_only=True).request)

    def compute_cartesian_path(
        self,
        waypoints: Sequence[Any],
        eef_step: float,
        jump_threshold: float | bool = 0.0,
        avoid_collisions: bool | Any = True,
        path_constraints: Any = None,
    ) -> tuple[Any, float]:
        """Return a trajectory on which the end effector moves straight from pose to pose.

        Later versions have no `jump_threshold`: a truth value in its place is `avoid_collisions`,
        and what follows is the path constraints.

        Args:
            waypoints: poses.
            eef_step: longest way between two configurations, m.
            jump_threshold: largest step of the joints as a multiple of the mean one, 0 for any.
            avoid_collisions: whether to stop before something.
            path_constraints: what must hold all along.

        Returns:
            The trajectory and the part of the way that it follows, 0 to 1.

        Raises:
            MoveItCommanderException: move_group refuses the request.
        """
        if isinstance(jump_threshold, bool):
            constraints = None if isinstance(avoid_collisions, bool) else avoid_collisions
            path_constraints = path_constraints or constraints
            jump_threshold, avoid_collisions = 0.0, jump_threshold
        request: Any = service_type("moveit_msgs/GetCartesianPath").Request(
            group_name=self._group.name,
            link_name=self._tip,
            max_step=float(eef_step),
            jump_threshold=float(jump_threshold),
            avoid_collisions=bool(avoid_collisions),
            max_velocity_scaling_factor=self._request.max_velocity_scaling_factor,
            max_acceleration_scaling_factor=self._request.max_acceleration_scaling_factor,
        )
        request.header.frame_id = self._frame
        request.waypoints = [pose_message(_pose_of_any(item)) for item in waypoints]
        if path_constraints is not None:
            kind = message_type("moveit_msgs/msg/Constraints")
            request.path_constraints = convert(path_constraints, kind)
        if self._start is not None:
            request.start_state = self._start
        answer = self._client.call("compute_cartesian_path", "GetCartesianPath", request)
        if answer.error_code.val != _SUCCESS:
            raise MoveItCommanderException(answer.error_code.message)
        return ros1(answer.solution), float(answer.fraction)

    def execute(self, trajectory: Any, wait: bool = True) -> bool:
        """Execute a trajectory, or what `plan` returned; True when the robot is at its end."""
        found = trajectory[1] if isinstance(trajectory, tuple) else trajectory
        kind = message_type("moveit_msgs/msg/RobotTrajectory")
        result = self._client.execute(convert(found, kind), wait=wait)
        return result is None or self._is_good(result, "execute")

    def pick(self, object_name: str, grasp: Any = (), plan_only: bool = False) -> int:
        """Refuse: MoveIt's pick and place pipeline is not here.

        Raises:
            MoveItCommanderException: always, with what does the same.
        """
        raise MoveItCommanderException(_NO_PICK.format(f"pick '{object_name}'"))

    def place(self, object_name: str, location: Any = None, plan_only: bool = False) -> int:
        """Refuse, see `pick`.

        Raises:
            MoveItCommanderException: always, with what does the same.
        """
        raise MoveItCommanderException(_NO_PICK.format(f"place '{object_name}'"))

    def set_support_surface_name(self, value: str) -> None:
        """Refuse, see `pick`.

        Raises:
            MoveItCommanderException: always, with what does the same.
        """
        raise MoveItCommanderException(_NO_PICK.format(f"use '{value}' as a support surface"))

    def attach_object(
        self, object_name: str, link_name: str = "", touch_links: Sequence[str] = ()
    ) -> bool:
        """Attach an object of the scene to a link, the end effector when none is named."""
        link = link_name or self._tip or self._group.links[-1]
        touch = list(touch_links) or self._hand_links(link)
        return self._attached(object_name, link, 0, touch)

    def detach_object(self, name: str = "") -> bool:
        """Let an object, or all objects of a link, go; everything of the group without a name."""
        is_link = name in self._robot.model.links
        return self._attached("" if is_link else name, name if is_link else "", 1, [])

    def retime_trajectory(
        self,
        ref_state_in: Any,
        traj_in: Any,
        velocity_scaling_factor: float = 1.0,
        acceleration_scaling_factor: float = 1.0,
        algorithm: str = _TIME_OPTIMAL,
    ) -> Any:
        """Return a trajectory with new times.

        Args:
            ref_state_in: without effect: the group's joints are all in the trajectory.
            traj_in: a ``RobotTrajectory``.
            velocity_scaling_factor: of the velocity limits, 0 to 1.
            acceleration_scaling_factor: of the acceleration limits, 0 to 1.
            algorithm: told once where it is another than the time-optimal one.
        """
        if algorithm != _TIME_OPTIMAL:
            warn_once(f"retime_trajectory: '{algorithm}' is not here; it is {_TIME_OPTIMAL}")
        names = list(traj_in.joint_trajectory.joint_names)
        order = [names.index(name) for name in self._group.variables]
        rows = [[p.positions[i] for i in order] for p in traj_in.joint_trajectory.points]
        made = parameterise(
            self._array(rows),
            self._group.space,
            velocity_scaling=velocity_scaling_factor,
            acceleration_scaling=acceleration_scaling_factor,
        )
        return ros1(robot_trajectory(made, frame=traj_in.joint_trajectory.header.frame_id))

    def get_jacobian_matrix(
        self, joint_values: Sequence[float], reference_point: Sequence[float] | None = None
    ) -> Any:
        """Return the 6×n Jacobian of the end effector, or of a point in its frame."""
        tool = np.eye(4)
        tool[:3, 3] = [0.0, 0.0, 0.0] if reference_point is None else list(reference_point)
        solver = self._robot.solver(self._group.name)
        return solver.jacobian(self._array(joint_values), self._tip, T_link_tool=tool)

    def _link_or_tip(self, name: str, otherwise: str) -> str:
        link = name or self._tip
        if not link:
            raise MoveItCommanderException(otherwise)
        return link

    def _stamped_pose(self, pose: Any) -> tuple[str, Pose]:
        if hasattr(pose, "pose"):
            return pose.header.frame_id or self._frame, pose_of(pose.pose)
        if hasattr(pose, "orientation"):
            return self._frame, pose_of(pose)
        return self._frame, pose_of_list(pose)

    def _joints_of_list(self, values: Any) -> dict[str, float]:
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

    def _joints_of_pose(self, pose: Any, link: str, approximate: bool) -> dict[str, float]:
        frame, target = self._stamped_pose(pose)
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

    def _canonical_path_constraints(self) -> Any:
        return convert(self.get_path_constraints(), message_type("moveit_msgs/msg/Constraints"))

    def _take_target(self, joints: Any) -> None:
        if joints is None:
            return
        if isinstance(joints, str):
            self.set_named_target(joints)
        elif hasattr(joints, "orientation") or hasattr(joints, "pose"):
            self.set_pose_target(joints)
        else:
            self.set_joint_value_target(joints)

    def _goal(self, *, plan_only: bool) -> Any:
        goal: Any = _MOVE.Goal(request=self._request)
        goal.request.group_name = self._group.name
        goal.request.goal_constraints = self._targets.constraints()
        goal.request.path_constraints = self._canonical_path_constraints()
        kind = message_type("moveit_msgs/msg/RobotState")
        goal.request.start_state = kind(is_diff=True) if self._start is None else self._start
        goal.planning_options.plan_only = plan_only
        goal.planning_options.replan = self._replan
        goal.planning_options.replan_attempts = 2 if self._replan else 0
        goal.planning_options.planning_scene_diff.is_diff = True
        goal.planning_options.planning_scene_diff.robot_state.is_diff = True
        return goal

    def _is_good(self, result: Any, what: str) -> bool:
        code = getattr(result, "error_code", None)
        if code is not None and code.val == _SUCCESS:
            return True
        told = "the goal was lost" if code is None else code.message or f"error {code.val}"
        self._client.node.log("error", f"{what}: Fail: ABORTED: {told}")
        return False

    def _attached(self, name: str, link: str, operation: int, touch: list[str]) -> bool:
        item: Any = message_type("moveit_msgs/msg/AttachedCollisionObject")(link_name=link)
        item.object.id, item.object.operation = name, operation
        item.touch_links = touch
        scene: Any = message_type("moveit_msgs/msg/PlanningScene")(is_diff=True)
        scene.robot_state.is_diff = True
        scene.robot_state.attached_collision_objects = [item]
        request = service_type("moveit_msgs/ApplyPlanningScene").Request(scene=scene)
        return bool(
            self._client.call("apply_planning_scene", "ApplyPlanningScene", request).success
        )

    def _hand_links(self, link: str) -> list[str]:
        """Links of the end effector that is mounted on a link may touch what it holds."""
        model = self._robot.model
        hands = [one.group for one in model.srdf.end_effectors if one.parent_link == link]
        return [name for hand in hands if hand in model.groups for name in model.groups[hand].links]

    def _positions_of(self, message: Any) -> Any:
        state = convert(message, message_type("moveit_msgs/msg/RobotState"))
        return positions_of(state, self._robot.model, self._robot.positions())

    def _array(self, rows: Any) -> Any:
        return np.array(rows, dtype=np.float64)


def _pose_of_any(item: Any) -> Any:
    if hasattr(item, "pose"):
        return pose_of(item.pose)
    return pose_of(item) if hasattr(item, "orientation") else pose_of_list(item)


def _default_scaling(client: MoveGroupClient) -> tuple[float, float]:
    """Return the defaults of joint_limits.yaml, as MoveGroupInterface reads them."""
    store = client.node.parameters
    found = []
    for kind in ("velocity", "acceleration"):
        name = store.search(f"robot_description_planning/default_{kind}_scaling_factor")
        # The search is for the first part of the name alone, as in ROS.
        value = store.get(name, 0.1) if name else 0.1
        found.append(float(value) if 0 < float(value) <= 1 else 0.1)
    return found[0], found[1]
