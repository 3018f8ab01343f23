"""Sequences of commands whose motions run into each other within a radius."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.motion.constraints.kinematic_constraints import (
    Parameterization,
    matrix_of,
    rotation_vector,
)
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.pilz.command import Command
from gazelle.motion.pilz.planner import PilzPlanner
from gazelle.motion.pilz.trapezoidal_joint_motion import (
    Motion,
    check_limits,
    grid,
    joined,
    measured,
    thinned,
)
from gazelle.motion.planning.error_codes import ErrorCode, PlanningError
from gazelle.motion.timing.trajectory import Trajectory

__all__ = ["plan_sequence"]


def plan_sequence(
    planner: PilzPlanner, start: FloatArray, commands: Sequence[Command]
) -> Trajectory:
    """Return one trajectory through all commands from a configuration (n,), rad or m.

    Where a command has a blend radius, the tip leaves its motion when it is that near to the
    command's goal and passes over into the next motion (Pilz' transition window).

    Raises:
        PlanningError: with the error code that Pilz answers, and the number of the command.
    """
    _check_radii(commands)
    motions: list[Motion] = []
    for number, command in enumerate(commands):
        here = motions[-1].positions[-1] if motions else start
        try:
            motions.append(planner.motion(here, command))
        except PlanningError as error:
            reason = f"command [{number}]: {error.reason}"
            raise PlanningError(error.code, reason) from error
    _check_overlap(planner, commands, motions)
    whole = motions[0] if motions else measured(np.zeros(1), start[None])
    for number, motion in enumerate(motions[1:]):
        radius = commands[number].blend_radius_m
        whole = (
            joined([whole, motion])
            if radius == 0.0
            else _blended(planner, whole, motion, radius, number)
        )
    planner.check(whole)
    return thinned(planner.space, whole, planner.sampling_time_s)


def _blended(
    planner: PilzPlanner, first: Motion, second: Motion, radius_m: float, number: int
) -> Motion:
    """Return two motions with the way between them rounded."""
    center = _tip(planner, second.positions[0])[:3, 3]
    enters = _crossing(planner, first, center, radius_m, from_end=True)
    leaves = _crossing(planner, second, center, radius_m, from_end=False)
    if enters is None or leaves is None:
        reason = (
            f"the blend radius {radius_m:g} m of command [{number}] is too large: the motion "
            f"{'to' if enters is None else 'from'} its goal stays within it"
        )
        raise PlanningError(ErrorCode.INVALID_MOTION_PLAN, reason)
    remaining = first.duration_s - enters
    duration = max(remaining, leaves)
    # Both end together where the first takes longer, both begin together where the second does.
    begins = max(0.0, remaining - leaves)
    times = grid(duration)
    rows = [first.position_at(enters)]
    for time_s in times[1:]:
        before = _tip(planner, first.position_at(enters + float(time_s)))
        after = _tip(planner, second.position_at(float(time_s) - begins))
        pose = _between(before, after, float(time_s) / duration)
        q = planner.near(pose, rows[-1])
        if q is None:
            reason = f"command [{number}]: no inverse kinematics solution while blending"
            raise PlanningError(ErrorCode.NO_IK_SOLUTION, reason)
        rows.append(q)
    motion = _through(first, enters, (times, np.array(rows)), second, leaves)
    window = (motion.times_s >= enters - 0.05) & (motion.times_s <= enters + duration + 0.05)
    columns = (motion.times_s, motion.positions, motion.velocities, motion.accelerations)
    check_limits(planner.space, Motion(*(item[window] for item in columns)), planner.slowing)
    return motion


def _through(
    first: Motion,
    enters: float,
    blend: tuple[FloatArray, FloatArray],
    second: Motion,
    leaves: float,
) -> Motion:
    """Return the motion through both, without what the blend replaces."""
    times, rows = blend
    early = first.times_s < enters - 1e-6
    late = second.times_s > leaves + 1e-6
    return measured(
        np.concatenate(
            [
                first.times_s[early],
                enters + times,
                second.times_s[late] - leaves + enters + times[-1],
            ]
        ),
        np.concatenate([first.positions[early], rows, second.positions[late]]),
    )


def _crossing(
    planner: PilzPlanner, motion: Motion, center: FloatArray, radius_m: float, *, from_end: bool
) -> float | None:
    """Return when the tip enters the sphere for good, or leaves it first; None if it never does."""
    rows = range(len(motion.times_s))
    for row in reversed(rows) if from_end else rows:
        distance = float(np.linalg.norm(_tip(planner, motion.positions[row])[:3, 3] - center))
        if distance > radius_m:
            inside = row + 1 if from_end else row - 1
            return float(motion.times_s[inside])
    return None


def _between(before: FloatArray, after: FloatArray, part: float) -> FloatArray:
    """Return a pose between two, by a part that starts and ends smoothly (a quintic)."""
    share = part**3 * (10.0 + part * (6.0 * part - 15.0))
    pose = np.eye(4)
    turn = rotation_vector(before[:3, :3].T @ after[:3, :3])
    pose[:3, :3] = before[:3, :3] @ matrix_of(share * turn, Parameterization.ROTATION_VECTOR)
    pose[:3, 3] = before[:3, 3] + share * (after[:3, 3] - before[:3, 3])
    return pose


def _check_radii(commands: Sequence[Command]) -> None:
    for number, command in enumerate(commands):
        if command.blend_radius_m < 0.0:
            reason = f"all blending radii must be non negative; that of command [{number}] is "
            reason += f"{command.blend_radius_m:g}"
            raise PlanningError(ErrorCode.INVALID_MOTION_PLAN, reason)
    if commands and commands[-1].blend_radius_m != 0.0:
        reason = "the last blending radius must be zero: there is nothing to blend with"
        raise PlanningError(ErrorCode.INVALID_MOTION_PLAN, reason)


def _check_overlap(
    planner: PilzPlanner, commands: Sequence[Command], motions: Sequence[Motion]
) -> None:
    ends = [_tip(planner, motion.positions[-1])[:3, 3] for motion in motions]
    for number in range(len(motions) - 2):
        radii = commands[number].blend_radius_m + commands[number + 1].blend_radius_m
        distance = float(np.linalg.norm(ends[number] - ends[number + 1]))
        if radii > 0.0 and distance <= radii:
            reason = (
                f"overlapping blend radii between command [{number}] and [{number + 1}]: their "
                f"goals are {distance:.4f} m apart, the radii add up to {radii:.4f} m"
            )
            raise PlanningError(ErrorCode.INVALID_MOTION_PLAN, reason)


def _tip(planner: PilzPlanner, q: FloatArray) -> FloatArray:
    return planner.kinematics.fk(q, planner.link)
