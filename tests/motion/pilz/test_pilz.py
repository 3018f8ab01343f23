from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.motion.gantry import Gantry, gantry_space
from tests.motion.plane import Map2D

from gazelle.description.moveit import CartesianLimits
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.pilz import (
    Auxiliary,
    AuxiliaryKind,
    Command,
    CommandKind,
    PilzPlanner,
    plan_sequence,
)
from gazelle.motion.planning import ErrorCode, PlanningError
from gazelle.motion.timing import Trajectory

_LIMITS = CartesianLimits(max_trans_vel=1.0, max_trans_acc=2.25, max_rot_vel=1.57)
_PLANNER = PilzPlanner(gantry_space(), Gantry(), cartesian=_LIMITS)
_HOME = np.zeros(6)
_PTP, _LIN, _CIRC = CommandKind.PTP, CommandKind.LIN, CommandKind.CIRC


def _at(*values: float) -> FloatArray:
    return np.array([*values, *[0.0] * (6 - len(values))])


def _pose(*values: float) -> FloatArray:
    return Gantry().fk(_at(*values))


def _fails(code: ErrorCode, words: str, command: Command, planner: PilzPlanner = _PLANNER) -> None:
    with pytest.raises(PlanningError) as caught:
        planner.plan(_HOME, command)
    assert words in caught.value.reason
    assert caught.value.code is code


def test_ptp_moves_all_joints_in_step() -> None:
    goal = _at(1.0, -0.5, 0.25, 0.6)
    found = _PLANNER.plan(_HOME, Command(_PTP, goal))
    # The longest way is 1 at 2/s and 8/s²: 0.25 s rise, 0.25 s hold, 0.25 s fall.
    assert found.duration_s == pytest.approx(0.75)
    assert np.diff(found.times_s)[:-1] == pytest.approx(0.1)
    moved = found.positions[1:, :4]
    assert moved / moved[:, :1] == pytest.approx(np.tile(goal[:4], (len(moved), 1)))
    assert found.velocities[0].tolist() == found.velocities[-1].tolist() == [0.0] * 6
    assert np.abs(found.velocities).max() <= 2.0 + 1e-9
    assert found.positions[-1] == pytest.approx(goal)


def test_ptp_takes_the_strictest_limits_and_brakes_as_told() -> None:
    space = gantry_space()
    strict = replace(space, velocity=np.array([2.0, 2.0, 2.0, 2.0, 2.0, 0.5]))
    planner = replace(_PLANNER, space=strict, deceleration=-np.full(6, 2.0))
    found = planner.plan(_HOME, Command(_PTP, _at(1.0), velocity_scaling=0.5))
    # 0.25/s, rise in 1/32 s, fall in 1/8 s.
    assert found.duration_s == pytest.approx(4.0 + 0.5 / 32 + 0.5 / 8)


def test_ptp_to_a_pose_and_to_where_the_robot_is() -> None:
    found = _PLANNER.plan(_HOME, Command(_PTP, _pose(0.3, 0.2, 0.1, 0.1, 0.2, 0.3)))
    assert found.positions[-1] == pytest.approx([0.3, 0.2, 0.1, 0.1, 0.2, 0.3])
    here = _PLANNER.plan(_HOME, Command(_PTP, _HOME))
    assert here.times_s.tolist() == [0.0]


def test_lin_goes_straight_with_a_trapezoid() -> None:
    goal = _pose(1.0, 1.0, 0.5, 0.0, 0.0, 0.6)
    found = _PLANNER.plan(_HOME, Command(_LIN, goal, velocity_scaling=0.5))
    # 1.5 m at 0.5 m/s, 2.25 m/s².
    assert found.duration_s == pytest.approx(1.5 / 0.5 + 0.5 / 2.25)
    part = found.positions[:, 0]
    assert found.positions[:, 1] == pytest.approx(part)
    assert found.positions[:, 2] == pytest.approx(0.5 * part)
    assert found.positions[:, 5] == pytest.approx(0.6 * part)
    speed = np.linalg.norm(found.velocities[:, :3], axis=1)
    assert speed.max() == pytest.approx(0.5, rel=1e-6)


def test_lin_that_only_turns_takes_the_rotational_velocity() -> None:
    found = _PLANNER.plan(_HOME, Command(_LIN, _pose(0.0, 0.0, 0.0, 0.0, 0.0, 1.57)))
    assert np.abs(found.velocities[:, 5]).max() == pytest.approx(1.57, rel=1e-6)
    assert found.duration_s == pytest.approx(1.0 + 1.0 / 2.25)
    assert np.abs(found.positions[:, :3]).max() < 1e-12


def test_lin_to_joint_positions_is_a_line_of_the_tip() -> None:
    found = _PLANNER.plan(_HOME, Command(_LIN, _at(0.5, 0.0, 0.0, 0.3)))
    assert found.positions[-1] == pytest.approx(_at(0.5, 0.0, 0.0, 0.3))


def test_coarse_solutions_of_kinematics_do_not_shake_the_motion() -> None:
    coarse = replace(_PLANNER, kinematics=Gantry(sloppy_m=1e-5))
    command = Command(_LIN, _pose(0.4), velocity_scaling=0.1, acceleration_scaling=0.05)
    found, exact = coarse.plan(_HOME, command), _PLANNER.plan(_HOME, command)
    assert np.abs(found.accelerations - exact.accelerations).max() < 1e-6


@pytest.mark.parametrize("kind", list(AuxiliaryKind))
def test_circ_goes_round_its_center(kind: AuxiliaryKind) -> None:
    middle = 0.5 * math.sqrt(0.5)
    point = [0.0, 0.5, 0.0] if kind is AuxiliaryKind.CENTER else [middle, 0.5 - middle, 0.0]
    command = Command(_CIRC, _pose(0.5, 0.5), Auxiliary(kind, np.array(point)))
    found = _PLANNER.plan(_HOME, command)
    radii = np.linalg.norm(found.positions[:, :2] - [0.0, 0.5], axis=1)
    assert radii == pytest.approx(0.5)
    length = 0.25 * math.pi
    assert found.duration_s == pytest.approx(length + 1.0 / 2.25)
    assert found.positions[-1] == pytest.approx(_at(0.5, 0.5), abs=1e-9)


@pytest.mark.parametrize(
    ("interim", "angle"),
    [((0.5, 0.5), 1.5 * math.pi), ((-0.35355339, 0.85355339), 1.5 * math.pi)],
)
def test_circ_passes_its_interim_point_the_long_way_too(
    interim: tuple[float, float], angle: float
) -> None:
    # From (0, 0) round (0, 0.5) by three quarters to (-0.5, 0.5).
    auxiliary = Auxiliary(AuxiliaryKind.INTERIM, np.array([*interim, 0.0]))
    found = _PLANNER.plan(_HOME, Command(_CIRC, _pose(-0.5, 0.5), auxiliary))
    assert found.duration_s == pytest.approx(0.5 * angle + 1.0 / 2.25, rel=1e-6)
    fine = replace(_PLANNER, sampling_time_s=0.005).plan(
        _HOME, Command(_CIRC, _pose(-0.5, 0.5), auxiliary)
    )
    nearest = np.linalg.norm(fine.positions[:, :2] - interim, axis=1).min()
    assert nearest < 0.004


@pytest.mark.parametrize(
    ("auxiliary", "words"),
    [
        (None, 'needs a path constraint named "interim" or "center"'),
        (Auxiliary(AuxiliaryKind.INTERIM, np.array([0.5, 0.0, 0.0])), "lie on a line"),
        (Auxiliary(AuxiliaryKind.CENTER, np.array([0.5, 0.0, 0.0])), "center point of CIRC lie on"),
        (Auxiliary(AuxiliaryKind.CENTER, np.array([0.4, 0.5, 0.0])), "is no circle"),
        (Auxiliary(AuxiliaryKind.CENTER, np.zeros(3)), "is its start or its goal"),
    ],
)
def test_circles_that_are_none_are_invalid_motion_plans(
    auxiliary: Auxiliary | None, words: str
) -> None:
    _fails(ErrorCode.INVALID_MOTION_PLAN, words, Command(_CIRC, _pose(1.0), auxiliary))


def test_requests_that_pilz_refuses() -> None:
    invalid = ErrorCode.INVALID_MOTION_PLAN
    _fails(
        invalid,
        "Velocity scaling not in range [0.0001, 1], actual value is: 0",
        Command(_PTP, _HOME, velocity_scaling=0.0),
    )
    _fails(invalid, "Acceleration scaling", Command(_LIN, _HOME, acceleration_scaling=1.5))
    lost = Auxiliary(AuxiliaryKind.CENTER, np.full(3, np.nan))
    _fails(invalid, "the center point has numbers that", Command(_CIRC, _pose(1.0), lost))
    bad_goal = ErrorCode.INVALID_GOAL_CONSTRAINTS
    _fails(bad_goal, "goal: joint 'x' is at 3, outside [-2, 2]", Command(_PTP, _at(3.0)))
    _fails(bad_goal, "goal of PTP has numbers that are not", Command(_PTP, np.full(6, np.nan)))
    _fails(bad_goal, "3 positions for 6 joints", Command(_LIN, np.zeros(3)))
    for kind in (_PTP, _LIN):
        text = f"inverse kinematics of the goal pose at (2.500, 0.000, 0.000) m of {kind}"
        _fails(ErrorCode.NO_IK_SOLUTION, text, Command(kind, _pose(2.5)))
    with pytest.raises(PlanningError, match="start state joints outside") as caught:
        _PLANNER.plan(_at(2.1), Command(_PTP, _HOME))
    assert caught.value.code is ErrorCode.INVALID_ROBOT_STATE


def test_missing_limits_name_the_file_they_belong_to() -> None:
    unlimited = replace(_PLANNER, space=replace(gantry_space(), acceleration=np.full(6, np.inf)))
    _fails(ErrorCode.PLANNING_FAILED, "joint_limits.yaml", Command(_PTP, _at(1.0)), unlimited)
    bare = replace(_PLANNER, cartesian=None)
    text = "LIN needs cartesian_limits (pilz_cartesian_limits.yaml)"
    _fails(ErrorCode.PLANNING_FAILED, text, Command(_LIN, _pose(1.0)), bare)
    still = replace(_PLANNER, cartesian=replace(_LIMITS, max_rot_vel=0.0))
    text = "max_rot_vel is 0; cartesian_limits need numbers above zero"
    _fails(ErrorCode.PLANNING_FAILED, text, Command(_LIN, _pose(1.0)), still)


def test_lin_that_is_too_fast_for_a_joint_fails() -> None:
    slow = replace(_PLANNER, space=gantry_space(velocity=0.5))
    _fails(
        ErrorCode.PLANNING_FAILED,
        "joint 'x' would need a velocity of 1/s",
        Command(_LIN, _pose(1.0)),
        slow,
    )
    assert slow.plan(_HOME, Command(_LIN, _pose(1.0), velocity_scaling=0.4)).duration_s > 2.5
    lazy = replace(_PLANNER, space=gantry_space(acceleration=1.0))
    _fails(
        ErrorCode.PLANNING_FAILED,
        "set the acceleration scaling factor lower",
        Command(_LIN, _pose(1.0)),
        lazy,
    )


def test_a_line_through_an_obstacle_is_no_plan() -> None:
    post = replace(_PLANNER, validity=Map2D(((0.5, 0.02, 0.05),)))
    for kind in (_PTP, _LIN):
        _fails(
            ErrorCode.INVALID_MOTION_PLAN, "collides with circle 0", Command(kind, _at(1.0)), post
        )


def _corner(radius_m: float, kinds: tuple[CommandKind, CommandKind] = (_LIN, _LIN)) -> Trajectory:
    commands = [
        Command(kinds[0], _pose(0.5), blend_radius_m=radius_m),
        Command(kinds[1], _pose(0.5, 0.5, 0.0, 0.0, 0.0, 0.4)),
    ]
    commands = [replace(item, velocity_scaling=0.3, acceleration_scaling=0.2) for item in commands]
    fine = replace(_PLANNER, sampling_time_s=0.01)
    return plan_sequence(fine, _HOME, commands)


def test_a_sequence_without_radii_stops_in_between() -> None:
    found = _corner(0.0)
    stop = int(np.argmin(np.linalg.norm(found.positions[:, :2] - [0.5, 0.0], axis=1)))
    assert found.positions[stop, :2] == pytest.approx([0.5, 0.0], abs=1e-4)
    assert np.abs(found.velocities[stop]).max() < 0.03
    assert found.duration_s == pytest.approx(2 * (0.5 / 0.3 + 0.3 / 0.45), rel=1e-6)


@pytest.mark.parametrize("kinds", [(_LIN, _LIN), (_PTP, _LIN), (_LIN, _PTP), (_PTP, _PTP)])
def test_blending_leaves_and_joins_at_the_radius(kinds: tuple[CommandKind, CommandKind]) -> None:
    found, stopping = _corner(0.1, kinds), _corner(0.0, kinds)
    assert found.duration_s < stopping.duration_s - 0.05
    away = np.linalg.norm(found.positions[:, :2] - [0.5, 0.0], axis=1)
    on_lines = (found.positions[:, 1] < 1e-3) | (found.positions[:, 0] > 0.5 - 1e-3)
    assert on_lines[away > 0.105].all()
    assert away.min() > 0.005
    between = (away < 0.09) & ~on_lines
    assert np.linalg.norm(found.velocities[between, :2], axis=1).min() > 0.05
    assert found.positions[-1] == pytest.approx(_at(0.5, 0.5, 0.0, 0.0, 0.0, 0.4), abs=1e-9)
    steps = np.linalg.norm(np.diff(found.positions, axis=0), axis=1)
    assert steps.max() < 0.02 * 1.5


def test_sequences_that_pilz_refuses() -> None:
    def fails(words: str, *commands: Command) -> None:
        with pytest.raises(PlanningError) as caught:
            plan_sequence(_PLANNER, _HOME, commands)
        assert words in caught.value.reason

    end = Command(_LIN, _pose(0.5, 0.5))
    first = Command(_LIN, _pose(0.5), blend_radius_m=0.1)
    fails(
        "must be non negative; that of command [0] is -1", replace(first, blend_radius_m=-1.0), end
    )
    fails("the last blending radius must be zero", first)
    fails(
        "the blend radius 0.6 m of command [0] is too large: the motion to its goal stays within",
        replace(first, blend_radius_m=0.6),
        end,
    )
    fails(
        "the motion from its goal stays within it",
        replace(first, blend_radius_m=0.2),
        Command(_LIN, _pose(0.5, 0.1)),
    )
    fails(
        "overlapping blend radii between command [0] and [1]: their goals are 0.5000 m apart, the "
        "radii add up to 0.5000 m",
        replace(first, blend_radius_m=0.25),
        replace(end, blend_radius_m=0.25),
        Command(_LIN, _pose(0.0, 0.5)),
    )
    fails("command [1]: failed to compute inverse", first, Command(_LIN, _pose(0.5, 3.0)))


def test_no_commands_are_no_motion() -> None:
    assert plan_sequence(_PLANNER, _HOME, []).duration_s == 0.0
