from __future__ import annotations

import math

import numpy as np
import pytest
from tests.motion.plane import Circle, PlanarArm, space_of

from gazelle.motion.constraints import (
    Constrained,
    JointConstraint,
    OrientationConstraint,
    PathConstraint,
    PositionConstraint,
    Region,
    projection,
)
from gazelle.motion.planning import ErrorCode, PlannerSettings, PlanningError, Search, plan

_ARM = PlanarArm((), links=4, length_m=0.3)
_SPACE = space_of(4)


def _upright(tolerance: float) -> OrientationConstraint:
    return OrientationConstraint("tip", np.eye(3), (0.1, 0.1, tolerance), _ARM.fk)


def _on_line(half_width: float) -> PositionConstraint:
    """The tip stays near the line x = 0.6 m."""
    pose = np.eye(4)
    pose[0, 3] = 0.6
    return PositionConstraint("tip", (Region("box", (2 * half_width, 4.0, 1.0), pose),), _ARM.fk)


def test_projection_arrives_within_the_constraints() -> None:
    constraints: list[PathConstraint] = [_upright(0.02), _on_line(0.005)]
    project = projection(_SPACE, constraints)
    assert project is not None
    rng, arrived = np.random.default_rng(1), 0
    for _ in range(30):
        q = project(_SPACE.sample(rng))
        if q is None:
            continue
        arrived += 1
        assert abs(math.remainder(float(np.sum(q)), math.tau)) <= 0.02
        assert abs(_ARM.corners(q)[-1, 0] - 0.6) <= 0.005
        assert not _SPACE.outside(q)
    assert arrived > 20


def test_what_holds_already_is_not_moved() -> None:
    project = projection(_SPACE, [_upright(0.1)])
    assert project is not None
    q = np.array([0.5, -0.5, 0.3, -0.25])
    assert project(q) is q
    assert projection(_SPACE, [JointConstraint("joint_1", 0, 0.0, 1.0, 1.0)]) is None


@pytest.mark.parametrize(
    ("planner", "circles"),
    [("RRTConnect", ((0.75, 0.0, 0.15),)), ("RRT", ()), ("RRTstar", ())],
)
def test_paths_keep_an_orientation(planner: str, circles: tuple[Circle, ...]) -> None:
    arm = PlanarArm(circles, links=4, length_m=0.3)
    upright = OrientationConstraint("tip", np.eye(3), (0.1, 0.1, 0.05), arm.fk)
    start, goal = np.array([0.9, 0.0, -0.4, -0.5]), np.array([-0.9, 0.0, 0.4, 0.5])
    path = plan(
        _SPACE,
        arm,
        start,
        [goal],
        search=Search(
            planner=planner, settings=PlannerSettings(max_iterations=20), time_limit_s=300.0
        ),
        constraints=[upright],
    )
    states = path.densified(0.005)
    assert np.abs(states.sum(axis=1)).max() <= 0.05 + 1e-6
    assert min(arm.clearance(q)[0] for q in states[::3]) > 0.0
    assert path.waypoints[-1] == pytest.approx(goal)


def test_the_tip_follows_a_line_four_centimetres_wide() -> None:
    q = [np.array([a, -2 * a, 0.0, 0.0]) for a in (0.0, 0.0)]
    project = projection(_SPACE, [_on_line(0.02)])
    assert project is not None
    for index, first in enumerate((1.0, -1.0)):
        found = project(np.array([first, -first, 0.3 * first, 0.2]))
        assert found is not None
        q[index] = found
    path = plan(
        _SPACE, _ARM, q[0], [q[1]], constraints=[_on_line(0.02)], search=Search(time_limit_s=300.0)
    )
    tips = np.array([_ARM.corners(state)[-1] for state in path.densified(0.005)])
    assert np.abs(tips[:, 0] - 0.6).max() <= 0.02 + 1e-6


def test_joint_constraints_narrow_the_limits() -> None:
    keep = JointConstraint("joint_2", 1, 0.2, 0.1, 0.1)
    wall = PlanarArm(((0.0, -0.6, 0.2), (1.0, 0.3, 0.1)), links=4, length_m=0.3)
    start, goal = np.array([1.5, 0.2, 0.0, 0.0]), np.array([-0.8, 0.25, 0.0, 0.0])
    path = plan(_SPACE, wall, start, [goal], constraints=[keep], search=Search(time_limit_s=300.0))
    assert np.abs(path.waypoints[:, 1] - 0.2).max() <= 0.1 + 1e-9


def test_ends_that_break_a_constraint_are_told_apart() -> None:
    keep = JointConstraint("joint_2", 1, 0.0, 0.1, 0.1)
    with pytest.raises(PlanningError, match=r"start: joint 'joint_2' is at 0\.5") as caught:
        plan(_SPACE, _ARM, np.full(4, 0.5), [np.zeros(4)], constraints=[keep])
    assert caught.value.code is ErrorCode.START_STATE_VIOLATES_PATH_CONSTRAINTS
    with pytest.raises(PlanningError, match="goal: the orientation of link 'tip' is") as caught:
        plan(_SPACE, _ARM, np.zeros(4), [np.full(4, 0.3)], constraints=[_upright(0.1)])
    assert caught.value.code is ErrorCode.GOAL_VIOLATES_PATH_CONSTRAINTS


def test_reasons_name_the_constraint_and_the_collision() -> None:
    arm = PlanarArm(((0.6, 0.0, 0.2),), links=4, length_m=0.3)
    guarded = Constrained(arm, (JointConstraint("joint_1", 0, 1.0, 0.1, 0.1),))
    assert guarded.why(np.zeros(4)) == (
        "joint 'joint_1' is at 0, its constraint allows [0.9, 1.1]; "
        "the robot collides with circle 0"
    )
    assert not guarded.is_valid(np.zeros(4))
    assert guarded.is_valid(np.array([1.0, 0.0, 0.0, 0.0]))


def test_a_constraint_outside_the_limits_leaves_nothing() -> None:
    far = JointConstraint("joint_1", 0, math.tau, 0.1, 0.1)
    with pytest.raises(PlanningError, match="joint 'joint_1' has lower limit") as caught:
        plan(_SPACE, _ARM, np.zeros(4), [np.zeros(4)], constraints=[far])
    assert caught.value.code is ErrorCode.START_STATE_VIOLATES_PATH_CONSTRAINTS
