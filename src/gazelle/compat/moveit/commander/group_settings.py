"""How a group plans: tolerances, planner, speed, constraints; the setters of MoveGroupCommander."""

from __future__ import annotations

from typing import Any

from gazelle.compat.moveit.commander.exception import MoveItCommanderException
from gazelle.compat.moveit.goal_constraints import Targets
from gazelle.interfaces import convert, message_type, ros1_message_type

__all__ = ["GroupSettings"]

_SCALING = "Expected value in the range from 0 to 1 for scaling factor"


class GroupSettings:
    """Everything about requests that is set once and stays."""

    def __init__(self, velocity_scaling: float, acceleration_scaling: float) -> None:
        """Begin as MoveGroupInterface does: 5 s, one attempt, the robot's default speed."""
        self._targets = Targets()
        self._request: Any = message_type("moveit_msgs/msg/MotionPlanRequest")(
            num_planning_attempts=1,
            allowed_planning_time=5.0,
            max_velocity_scaling_factor=velocity_scaling,
            max_acceleration_scaling_factor=acceleration_scaling,
        )
        self._replan = False
        self._path_constraints: Any = None

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

    def _canonical_path_constraints(self) -> Any:
        return convert(self.get_path_constraints(), message_type("moveit_msgs/msg/Constraints"))
