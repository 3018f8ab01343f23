"""MoveGroupCommander: plan, move and execute with one group."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gazelle.compat.moveit.commander.conversions import pose_of_list
from gazelle.compat.moveit.commander.exception import MoveItCommanderException
from gazelle.compat.moveit.commander.group_targets import GroupTargets
from gazelle.compat.moveit.commander.roscpp_initializer import client_of, robot_of, ros1
from gazelle.compat.warn_once import warn_once
from gazelle.interfaces import action_type, convert, message_type, service_type
from gazelle.motion.timing import parameterise
from gazelle.nodes.move_group.constraint_messages import pose_of
from gazelle.nodes.move_group.robot_state_messages import positions_of, robot_state_message
from gazelle.nodes.move_group.shape_messages import pose_message
from gazelle.nodes.move_group.trajectories import robot_trajectory

__all__ = ["MoveGroupCommander", "PlanResult"]

_MOVE = action_type("moveit_msgs/MoveGroup")
_SUCCESS = 1
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


class MoveGroupCommander(GroupTargets):
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
        super().__init__(robot_of(robot_description, ns), client, name)
        self._start: Any = None
        self._support_surface = ""
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
        request.waypoints = [pose_message(_pose(item)) for item in waypoints]
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
        import numpy as np

        tool = np.eye(4)
        tool[:3, 3] = [0.0, 0.0, 0.0] if reference_point is None else list(reference_point)
        solver = self._robot.solver(self._group.name)
        return solver.jacobian(self._array(joint_values), self._tip, T_link_tool=tool)

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
        import numpy as np

        return np.array(rows, dtype=np.float64)


def _pose(item: Any) -> Any:
    if hasattr(item, "pose"):
        return pose_of(item.pose)
    return pose_of(item) if hasattr(item, "orientation") else pose_of_list(item)
