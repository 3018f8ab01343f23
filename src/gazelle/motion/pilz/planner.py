"""PTP, LIN and CIRC as the Pilz industrial motion planner moves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from gazelle.description.moveit import CartesianLimits
from gazelle.motion.constraints.kinematic_constraints import rotation_vector
from gazelle.motion.joint_space import FloatArray, JointSpace, Validity
from gazelle.motion.kinematics import Patience
from gazelle.motion.pilz.command import Command, CommandKind
from gazelle.motion.pilz.lin_circ_paths import CartesianPath, circle, line
from gazelle.motion.pilz.trapezoidal_joint_motion import (
    Motion,
    Trapezoid,
    check_limits,
    grid,
    measured,
    thinned,
)
from gazelle.motion.planning.error_codes import ErrorCode, PlanningError
from gazelle.motion.planning.path_validation import FINE_STEP, first_fault
from gazelle.motion.timing.trajectory import Trajectory

__all__ = ["Kinematics", "PilzPlanner"]

_MIN_MOVEMENT = 1e-3
_GOAL_PATIENCE = Patience(attempts=50)


class Kinematics(Protocol):
    """Poses of links and configurations for poses; `gazelle.motion.kinematics.Solver` is one."""

    def fk(self, q: FloatArray, link: str = "") -> FloatArray:
        """Return the pose of a link, 4×4."""
        ...

    def jacobian(self, q: FloatArray, link: str = "") -> FloatArray:
        """Return the 6×n Jacobian of a link's origin: linear, then angular velocity."""
        ...

    def ik(
        self,
        T_base_tip: FloatArray,
        *,
        seed_q: FloatArray | None = None,
        patience: Patience,
        link: str = "",
    ) -> FloatArray | None:
        """Return a configuration (n,) near `seed_q` for a link at a pose (4, 4), or None."""
        ...


@dataclass(frozen=True, eq=False)
class PilzPlanner:
    """Plans commands of one group.

    Attributes:
        space: limits of the joints; PTP and LIN need all of velocity and acceleration.
        kinematics: of the group.
        link: what LIN and CIRC move, the group's tip when empty.
        cartesian: limits of LIN and CIRC; None where the package has none. They brake with
            max_trans_acc too: max_trans_dec has no effect, as in Pilz.
        deceleration: (n,), of the joints, above zero; `space.acceleration` where None, as in Pilz.
        validity: every trajectory that leaves is checked with it.
        sampling_time_s: time between samples, 0.1 in Pilz.
    """

    space: JointSpace
    kinematics: Kinematics
    link: str = ""
    cartesian: CartesianLimits | None = None
    deceleration: FloatArray | None = None
    validity: Validity | None = None
    sampling_time_s: float = 0.1

    def plan(self, start: FloatArray, command: Command) -> Trajectory:
        """Return the trajectory of a command from a configuration (n,), rad or m.

        Raises:
            PlanningError: with the error code that Pilz answers.
        """
        motion = self.motion(start, command)
        self.check(motion)
        return thinned(self.space, motion, self.sampling_time_s)

    def motion(self, start: FloatArray, command: Command) -> Motion:
        """Return the motion of a command from `start` (n,), its collisions not yet checked."""
        command.check()
        if outside := self.space.outside(start, tolerance=1e-6):
            reason = "start state joints outside their position limits: " + "; ".join(outside)
            raise PlanningError(ErrorCode.INVALID_ROBOT_STATE, reason)
        if command.kind is CommandKind.PTP:
            return self._ptp(start, command)
        return self._cartesian(start, command)

    def check(self, motion: Motion) -> None:
        """Refuse a motion that collides.

        Raises:
            PlanningError: INVALID_MOTION_PLAN, with what collides.
        """
        if self.validity is None:
            return
        fault = first_fault(self.space, self.validity, motion.positions, FINE_STEP)
        if fault:
            raise PlanningError(ErrorCode.INVALID_MOTION_PLAN, fault)

    @property
    def slowing(self) -> FloatArray:
        """The decelerations of the joints (n,), above zero."""
        given = self.space.acceleration if self.deceleration is None else self.deceleration
        return np.abs(given)

    def _ptp(self, start: FloatArray, command: Command) -> Motion:
        """Move all joints in step with the one that has furthest to go.

        Pilz moves every joint with the strictest limits of all.
        """
        limits = [
            float(v.min()) for v in (self.space.velocity, self.space.acceleration, self.slowing)
        ]
        if not np.isfinite(limits).all():
            reason = "PTP needs a velocity and an acceleration limit of every joint"
            raise PlanningError(ErrorCode.PLANNING_FAILED, f"{reason} (joint_limits.yaml)")
        way = self._goal(start, command) - start
        furthest = float(np.abs(way).max())
        if furthest < _MIN_MOVEMENT:
            return measured(np.zeros(1), start[None])
        faster, harder = command.velocity_scaling, command.acceleration_scaling
        speed = Trapezoid(furthest, limits[0] * faster, limits[1] * harder, limits[2] * harder)
        times = grid(speed.duration_s)
        gone, velocity, change = (column[:, None] for column in speed.at(times))
        share = way / furthest
        return Motion(times, start + gone * share, velocity * share, change * share)

    def _cartesian(self, start: FloatArray, command: Command) -> Motion:
        limits = self.cartesian
        if limits is None:
            reason = f"{command.kind} needs cartesian_limits (pilz_cartesian_limits.yaml)"
            raise PlanningError(ErrorCode.PLANNING_FAILED, reason)
        _check(limits)
        begin, end = self.kinematics.fk(start, self.link), self._goal_pose(start, command)
        radius = limits.max_trans_vel / limits.max_rot_vel
        if command.kind is CommandKind.LIN:
            path = line(begin, end, radius)
        else:
            assert command.auxiliary is not None
            path = circle(begin, end, command.auxiliary, radius)
        if path.length_m < 1e-9:
            return measured(np.zeros(1), start[None])
        velocity = limits.max_trans_vel * command.velocity_scaling
        change = limits.max_trans_acc * command.acceleration_scaling
        speed = Trapezoid(path.length_m, velocity, change, change)
        times = grid(speed.duration_s)
        parts = speed.at(times)[0] / path.length_m
        motion = measured(times, self._follow(start, path, parts, command.kind))
        check_limits(self.space, motion, self.slowing)
        return motion

    def _follow(
        self, start: FloatArray, path: CartesianPath, parts: FloatArray, kind: CommandKind
    ) -> FloatArray:
        rows = [start]
        for part in parts[1:]:
            q = self.near(path.pose(float(part)), rows[-1])
            if q is None:
                reason = (
                    f"{kind}: no inverse kinematics solution {100.0 * part:.0f} % along the way"
                )
                raise PlanningError(ErrorCode.NO_IK_SOLUTION, reason)
            rows.append(q)
        return np.array(rows)

    def near(self, pose: FloatArray, seed: FloatArray) -> FloatArray | None:
        """Return the configuration (n,) for a pose (4, 4) that is near another configuration."""
        q = self.kinematics.ik(pose, seed_q=seed, patience=Patience(attempts=1), link=self.link)
        if q is None:
            return None
        # Solvers stop at their tolerance, which differences of positions would make noise of.
        here = self.kinematics.fk(q, self.link)
        turn = rotation_vector(pose[:3, :3] @ here[:3, :3].T)
        error = np.concatenate([pose[:3, 3] - here[:3, 3], turn])
        columns = self.kinematics.jacobian(q, self.link)
        refined = q + np.linalg.lstsq(columns, error, rcond=1e-4)[0]
        return self.space.clamped(refined)

    def _goal(self, start: FloatArray, command: Command) -> FloatArray:
        """Return the goal of a PTP as positions of the joints."""
        if command.goal.shape == (4, 4):
            q = self.kinematics.ik(
                command.goal, seed_q=start, patience=_GOAL_PATIENCE, link=self.link
            )
            if q is None:
                raise PlanningError(ErrorCode.NO_IK_SOLUTION, _unreachable(command))
            return q
        return self._checked(command.goal)

    def _goal_pose(self, start: FloatArray, command: Command) -> FloatArray:
        if command.goal.shape != (4, 4):
            return self.kinematics.fk(self._checked(command.goal), self.link)
        q = self.kinematics.ik(command.goal, seed_q=start, patience=_GOAL_PATIENCE, link=self.link)
        if q is None:
            raise PlanningError(ErrorCode.NO_IK_SOLUTION, _unreachable(command))
        return command.goal

    def _checked(self, goal: FloatArray) -> FloatArray:
        try:
            q = self.space.array(goal)
        except ValueError as error:
            raise PlanningError(ErrorCode.INVALID_GOAL_CONSTRAINTS, f"goal: {error}") from error
        if outside := self.space.outside(q, tolerance=1e-6):
            reason = "goal: " + "; ".join(outside)
            raise PlanningError(ErrorCode.INVALID_GOAL_CONSTRAINTS, reason)
        return q


def _check(limits: CartesianLimits) -> None:
    for name in ("max_trans_vel", "max_trans_acc", "max_rot_vel"):
        value = getattr(limits, name)
        if not (np.isfinite(value) and value > 0.0):
            reason = f"{name} is {value:g}; cartesian_limits need numbers above zero"
            raise PlanningError(ErrorCode.PLANNING_FAILED, reason)


def _unreachable(command: Command) -> str:
    place = ", ".join(f"{value:.3f}" for value in command.goal[:3, 3])
    return f"failed to compute inverse kinematics of the goal pose at ({place}) m of {command.kind}"
