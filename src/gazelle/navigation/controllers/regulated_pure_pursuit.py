"""Regulated Pure Pursuit (Macenski and others 2023), as in Nav2."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.controllers.controller import Command, NoCommand, RobotState, Velocity
from gazelle.navigation.controllers.followed_plan import FollowedPlan, angle_between
from gazelle.navigation.costmap.cost_grid import INSCRIBED, UNKNOWN, CostGrid
from gazelle.navigation.costmap.footprint import Footprint, footprint_cost
from gazelle.parameters.dataclass_tables import flag, number

__all__ = ["PursuitController", "PursuitOptions"]


@dataclass(frozen=True, slots=True)
class PursuitOptions:
    """``nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController``."""

    desired_linear_vel: float = number(0.5, "speed on straight and open ground", "m/s", 0)
    lookahead_dist: float = number(0.6, "distance of the point that is steered for", "m", 0.01)
    min_lookahead_dist: float = number(0.3, "lower limit of it with velocity scaling", "m", 0.01)
    max_lookahead_dist: float = number(0.9, "upper limit of it with velocity scaling", "m", 0.01)
    lookahead_time: float = number(1.5, "distance by speed, with velocity scaling", "s", 0)
    use_velocity_scaled_lookahead_dist: bool = flag(False, "the distance grows with speed")
    rotate_to_heading_angular_vel: float = number(1.8, "speed of turns on the spot", "rad/s", 0)
    rotate_to_heading_min_angle: float = number(0.785, "angle to the path from which on the robot "
                                                "turns on the spot", "rad", 0)  # fmt: skip
    use_rotate_to_heading: bool = flag(True, "turn on the spot towards the path and in the goal")
    max_angular_accel: float = number(3.2, "of turns on the spot", "rad/s²", 0.01)
    min_approach_linear_velocity: float = number(0.05, "slowest speed near the goal", "m/s", 0)
    approach_velocity_scaling_dist: float = number(
        0.6, "length of the path that is left from which on the robot slows down", "m", 0
    )
    use_collision_detection: bool = flag(True, "stop before obstacles on the way")
    max_allowed_time_to_collision_up_to_carrot: float = number(
        1.0, "how long ahead obstacles are looked for", "s", 0
    )
    use_regulated_linear_velocity_scaling: bool = flag(True, "slow in curves")
    regulated_linear_scaling_min_radius: float = number(0.9, "radius below which that begins",
                                                        "m", 0.01)  # fmt: skip
    regulated_linear_scaling_min_speed: float = number(
        0.25, "lower limit of slowing down", "m/s", 0
    )
    use_cost_regulated_linear_velocity_scaling: bool = flag(True, "slow down near obstacles")
    cost_scaling_dist: float = number(0.6, "distance from obstacles below which that begins", "m",
                                      0.01)  # fmt: skip
    cost_scaling_gain: float = number(1.0, "how much, at most 1", "", 0.01)
    inflation_cost_scaling_factor: float = number(3.0, "that of the inflation layer", "1/m", 0.01)
    use_fixed_curvature_lookahead: bool = flag(False, "curves are measured at their own distance")
    curvature_lookahead_dist: float = number(0.6, "that distance", "m", 0.01)
    allow_reversing: bool = flag(False, "drive backwards where the path lies behind")
    max_robot_pose_search_dist: float = number(10.0, "how far along the path the robot is looked "
                                               "for", "m", 0)  # fmt: skip

    IDLE: ClassVar[Mapping[str, str]] = {
        "transform_tolerance": "the costmap's transform_tolerance counts",
        "use_cancel_deceleration": "a cancelled goal stops the robot at once",
        "cancel_deceleration": "a cancelled goal stops the robot at once",
        "interpolate_curvature_after_goal": "the path ends in the goal",
        "stateful": "the goal checker's stateful counts",
        "use_interpolation": "the point that is steered for is always interpolated",
    }


Pose = tuple[float, float, float]


class PursuitController:
    """Steers for a point on the path, slower in curves and near obstacles."""

    def __init__(
        self,
        options: PursuitOptions,
        period_s: float,
        tolerance: tuple[float, float] = (0.25, 0.25),
    ) -> None:
        """Begin without a path.

        Args:
            options: parameters.
            period_s: between two velocity commands.
            tolerance: of the goal, m and rad; a goal checker's.
        """
        self._options = options
        self._period_s = period_s
        self._tolerance = tolerance
        self._speed = options.desired_linear_vel
        self._plan: FollowedPlan | None = None

    def set_plan(self, plan: NDArray[np.float64], *, has_moved: bool = False) -> None:
        """Take a path (n, 3); see `Controller`."""
        self._plan = FollowedPlan(plan, before=self._plan if has_moved else None)

    def reset(self) -> None:
        """Forget the path."""
        self._plan = None

    def limit_speed(self, m_s: float | None) -> None:
        """Drive no faster than this."""
        fastest = self._options.desired_linear_vel
        self._speed = fastest if m_s is None else min(m_s, fastest)

    def goal_reached(self, state: RobotState) -> bool:
        """Tell whether the robot stands in the goal."""
        if self._plan is None:
            return False
        turn = abs(angle_between(state.pose[2], self._plan.goal[2]))
        return self._distance(state) <= self._tolerance[0] and turn <= self._tolerance[1]

    def compute(
        self, state: RobotState, grid: CostGrid, footprint: Footprint
    ) -> Command | NoCommand:
        """Return the next velocity; see `Controller`."""
        if self._plan is None:
            return NoCommand("there is no path to follow")
        o = self._options
        self._plan.advance(state.pose, o.max_robot_pose_search_dist)
        reach = self._lookahead(state)
        carrot = self._carrot(state, reach)
        bearing = math.atan2(carrot[1], carrot[0])
        if self._distance(state) <= self._tolerance[0] and o.use_rotate_to_heading:
            turn = angle_between(state.pose[2], self._plan.goal[2])
            velocity = self._turn(state, turn)
        elif self._must_turn(bearing):
            velocity = self._turn(state, bearing)
        else:
            velocity = self._drive(state, grid, footprint, carrot)
        trajectory = self._trajectory(state, velocity, math.hypot(*carrot))
        if o.use_collision_detection:
            for pose in trajectory:
                if footprint_cost(grid, footprint, pose) in (-1, -2):
                    return NoCommand(
                        "RegulatedPurePursuitController detected collision ahead! "
                        f"({pose[0]:.2f}, {pose[1]:.2f})"
                    )
        return Command(velocity, np.array(trajectory))

    def _lookahead(self, state: RobotState) -> float:
        o = self._options
        if not o.use_velocity_scaled_lookahead_dist:
            return o.lookahead_dist
        wanted = abs(state.velocity[0]) * o.lookahead_time
        return min(max(wanted, o.min_lookahead_dist), o.max_lookahead_dist)

    def _carrot(self, state: RobotState, reach: float) -> tuple[float, float]:
        """Return the point of the path at a distance, in the robot's frame."""
        assert self._plan is not None
        ahead = self._plan.poses[self._plan.begin :, :2] - state.pose[:2]
        far = np.nonzero(np.hypot(*ahead.T) >= reach)[0]
        index = int(far[0]) if len(far) else len(ahead) - 1
        point = ahead[index]
        if len(far) and index > 0:
            point = _on_circle(ahead[index - 1], ahead[index], reach)
        c, s = math.cos(state.pose[2]), math.sin(state.pose[2])
        return float(c * point[0] + s * point[1]), float(c * point[1] - s * point[0])

    def _must_turn(self, bearing: float) -> bool:
        o = self._options
        if not o.use_rotate_to_heading or o.allow_reversing:
            return False
        return abs(bearing) > o.rotate_to_heading_min_angle

    def _turn(self, state: RobotState, turn: float) -> Velocity:
        o = self._options
        limit = o.max_angular_accel
        wanted = math.copysign(o.rotate_to_heading_angular_vel, turn)
        now, step = state.velocity[2], limit * self._period_s
        speed = min(max(wanted, now - step), now + step)
        most = math.sqrt(2 * limit * abs(turn))
        return 0.0, 0.0, min(max(speed, -most), most)

    def _drive(
        self,
        state: RobotState,
        grid: CostGrid,
        footprint: Footprint,
        carrot: tuple[float, float],
    ) -> Velocity:
        o = self._options
        sign = -1.0 if o.allow_reversing and carrot[0] < 0 else 1.0
        steered = carrot
        if o.use_fixed_curvature_lookahead:
            steered = self._carrot(state, o.curvature_lookahead_dist)
        curvature = _curvature(steered)
        speed = self._regulated(state, grid, footprint, _curvature(steered))
        return sign * speed, 0.0, sign * speed * curvature

    def _regulated(
        self, state: RobotState, grid: CostGrid, footprint: Footprint, curvature: float
    ) -> float:
        """Return the speed for a curve, a place and what is left of the path."""
        assert self._plan is not None
        o, fastest = self._options, self._speed
        curve = near = fastest
        radius = 1.0 / max(abs(curvature), 1e-9)
        smallest = o.regulated_linear_scaling_min_radius
        if o.use_regulated_linear_velocity_scaling and radius < smallest:
            curve = fastest * (1.0 - (smallest - radius) / smallest)
        if o.use_cost_regulated_linear_velocity_scaling:
            near = fastest * self._nearness(state, grid, footprint)
        speed = max(min(curve, near), o.regulated_linear_scaling_min_speed)
        left = self._plan.remaining_m()
        if left < o.approach_velocity_scaling_dist:
            slow = speed * left / o.approach_velocity_scaling_dist
            speed = min(speed, max(slow, o.min_approach_linear_velocity))
        return min(max(speed, 0.0), fastest)

    def _nearness(self, state: RobotState, grid: CostGrid, footprint: Footprint) -> float:
        """Return 1 away from obstacles and less near them."""
        o, cost = self._options, grid.cost_at(state.pose[0], state.pose[1])
        if cost in (0, UNKNOWN):
            return 1.0
        share = min(cost, INSCRIBED - 1) / (INSCRIBED - 1)
        distance = footprint.inscribed_m - math.log(share) / o.inflation_cost_scaling_factor
        if distance >= o.cost_scaling_dist:
            return 1.0
        return min(o.cost_scaling_gain * distance / o.cost_scaling_dist, 1.0)

    def _trajectory(self, state: RobotState, velocity: Velocity, reach: float) -> list[Pose]:
        """Return the arc up to the carrot, or as long ahead as obstacles are looked for."""
        x, y, yaw = state.pose
        v, w = velocity[0], velocity[2]
        moving = abs(v) > 0.01
        pace = 0.05 / abs(v) if moving else 0.1 / max(abs(w), 0.05)
        poses = [(x, y, yaw)]
        for _ in range(int(self._options.max_allowed_time_to_collision_up_to_carrot / pace)):
            x, y = x + v * math.cos(yaw) * pace, y + v * math.sin(yaw) * pace
            yaw += w * pace
            poses.append((x, y, yaw))
            if moving and math.hypot(x - state.pose[0], y - state.pose[1]) > reach:
                break
        return poses

    def _distance(self, state: RobotState) -> float:
        assert self._plan is not None
        goal = self._plan.goal
        return math.hypot(goal[0] - state.pose[0], goal[1] - state.pose[1])


def _curvature(carrot: tuple[float, float]) -> float:
    """Return 2 y / d², the circle through robot and point that touches the robot's heading."""
    square = carrot[0] ** 2 + carrot[1] ** 2
    return 2.0 * carrot[1] / square if square > 0.001 else 0.0


def _on_circle(
    a: NDArray[np.float64], b: NDArray[np.float64], radius: float
) -> NDArray[np.float64]:
    """Return where the line from a (inside) to b (outside) leaves a circle around 0."""
    step = b - a
    square, along = float(step @ step), float(a @ step)
    if square == 0:
        return b
    root = math.sqrt(max(along * along - square * (float(a @ a) - radius * radius), 0.0))
    return np.asarray(a + step * min(max((-along + root) / square, 0.0), 1.0))
