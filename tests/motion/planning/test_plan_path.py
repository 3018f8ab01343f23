from __future__ import annotations

import importlib.util
import math

import numpy as np
import pytest
from tests.motion.plane import Map2D, PlanarArm, space_of

from gazelle.motion.joint_space import FloatArray
from gazelle.motion.planning import (
    FINE_STEP,
    PLANNERS,
    ErrorCode,
    PlannerSettings,
    PlanningError,
    Search,
    first_fault,
    plan,
)

_SLALOM = Map2D(tuple((x, y, 0.9) for x, y in ((-1.0, -1.5), (-1.0, 0.3), (1.0, 1.5), (1.0, -0.3))))
_LEFT, _RIGHT = np.array([-3.0, 0.0]), np.array([3.0, 0.0])
_HAS_OMPL = importlib.util.find_spec("ompl") is not None


@pytest.mark.parametrize("planner", sorted(PLANNERS))
def test_every_planner_of_moveit_plans_past_circles(planner: str) -> None:
    settings = PlannerSettings(max_iterations=60)
    # Planners of OMPL that improve their paths use the time they get.
    limit_s = 8.0 if _HAS_OMPL and PLANNERS[planner].own is None else 100.0
    path = plan(
        space_of(2),
        _SLALOM,
        _LEFT,
        [_RIGHT],
        search=Search(planner=planner, settings=settings, time_limit_s=limit_s),
    )
    assert path.waypoints[0] == pytest.approx(_LEFT)
    assert path.waypoints[-1] == pytest.approx(_RIGHT)
    assert first_fault(space_of(2), _SLALOM, path.waypoints, FINE_STEP) == ""
    if PLANNERS[planner].own is not None:
        assert path.planner == planner
        assert path.notes == ()
    elif not _HAS_OMPL:
        assert path.planner == PLANNERS[planner].stand_in
        assert path.notes == (
            f"{planner} is a planner of OMPL, which is not installed "
            f'(pip install "gazelle-sim[ompl]"); {path.planner} plans instead',
        )


@pytest.mark.parametrize("planner", ["RRTConnect", "RRT", "RRTstar", "PRM", "PRMstar"])
def test_a_seed_gives_one_path(planner: str) -> None:
    settings = PlannerSettings(max_iterations=60)

    def waypoints(seed: int) -> FloatArray:
        found = plan(
            space_of(2),
            _SLALOM,
            _LEFT,
            [_RIGHT],
            search=Search(planner=planner, seed=seed, settings=settings, time_limit_s=60.0),
        )
        assert not found.timed_out
        return found.waypoints

    assert np.array_equal(waypoints(3), waypoints(3))
    assert not np.array_equal(waypoints(3), waypoints(4))


def test_optimising_planners_come_near_the_shortest_path() -> None:
    circle = Map2D(((0.0, 0.0, 1.0),))
    start, goal = np.array([-2.0, 0.0]), np.array([2.0, 0.0])
    # Two tangents and the arc between them.
    shortest = 2.0 * math.sqrt(3.0) + (math.pi - 2.0 * math.acos(0.5))
    for planner in ("RRTstar", "PRMstar"):
        settings = PlannerSettings(max_iterations=300, simplify=False)
        path = plan(
            space_of(2),
            circle,
            start,
            [goal],
            search=Search(planner=planner, settings=settings, time_limit_s=60.0),
        )
        assert shortest <= path.length < 1.1 * shortest


def test_shortcuts_shorten_a_path() -> None:
    arm = PlanarArm(((0.7, 0.5, 0.15), (-0.6, 0.6, 0.2)))
    start, goal = np.array([0.0, 0.0, 0.0]), np.array([math.pi, 0.0, 0.0])
    raw = plan(
        space_of(3), arm, start, [goal], search=Search(settings=PlannerSettings(simplify=False))
    )
    short = plan(space_of(3), arm, start, [goal])
    assert short.length < 0.9 * raw.length


def test_continuous_joints_turn_the_short_way() -> None:
    torus = Map2D(((0.0, 0.0, 1.0),), wraps=True)
    space = space_of(2, continuous=True)
    path = plan(space, torus, np.array([-3.0, 0.5]), [np.array([3.0, 0.5])])
    assert path.length == pytest.approx(math.tau - 6.0)
    assert path.waypoints[-1] == pytest.approx([3.0 - math.tau, 0.5])


@pytest.mark.parametrize("planner", ["RRTConnect", "RRT", "RRTstar", "PRM"])
def test_turning_paths_have_no_jumps(planner: str) -> None:
    wall = tuple((math.pi, y, 0.5) for y in np.linspace(-2.5, math.pi, 9))
    torus = Map2D((*wall, (0.0, 1.0, 1.2)), wraps=True)
    space = space_of(2, continuous=True)
    settings = PlannerSettings(max_iterations=300)
    goal = np.array([-2.2, 2.0])
    path = plan(
        space,
        torus,
        np.array([2.2, 2.0]),
        [goal],
        search=Search(planner=planner, settings=settings, time_limit_s=100.0),
    )
    assert first_fault(space, torus, path.waypoints, FINE_STEP) == ""
    turns = (path.waypoints[-1] - goal) / math.tau
    assert turns == pytest.approx(np.round(turns), abs=1e-9)


def test_goals_on_a_limit_are_clamped_and_goals_beyond_are_told() -> None:
    space, free = space_of(2), Map2D(())
    path = plan(space, free, _LEFT, [np.array([math.pi + 5e-4, 0.0])])
    assert path.waypoints[-1, 0] == math.pi
    with pytest.raises(PlanningError, match=r"goal: joint 'joint_1' is at 3\.2, outside") as caught:
        plan(space, free, _LEFT, [np.array([3.2, 0.0])])
    assert caught.value.code is ErrorCode.INVALID_GOAL_CONSTRAINTS


def test_a_start_slightly_outside_is_led_back_in() -> None:
    path = plan(space_of(2), Map2D(()), np.array([-3.2, 0.0]), [_RIGHT])
    assert path.waypoints[0] == pytest.approx([-3.2, 0.0])
    assert path.waypoints[1] == pytest.approx([-math.pi, 0.0])
    assert "the start lies outside the limits (joint 'joint_1' is at -3.2" in path.notes[0]
    with pytest.raises(PlanningError, match=r"start: joint 'joint_1' is at -3\.5") as caught:
        plan(space_of(2), Map2D(()), np.array([-3.5, 0.0]), [_RIGHT])
    assert caught.value.code is ErrorCode.INVALID_ROBOT_STATE


def test_collisions_at_the_ends_name_the_obstacle() -> None:
    circles = Map2D(((-3.0, 0.0, 0.2), (3.0, 0.0, 0.2)))
    with pytest.raises(PlanningError, match="start: the robot collides with circle 0") as caught:
        plan(space_of(2), circles, _LEFT, [np.zeros(2)])
    assert caught.value.code is ErrorCode.START_STATE_IN_COLLISION
    with pytest.raises(PlanningError, match="goal: the robot collides with circle 1") as caught:
        plan(space_of(2), circles, np.zeros(2), [_RIGHT])
    assert caught.value.code is ErrorCode.GOAL_IN_COLLISION


def test_any_of_several_goals_will_do() -> None:
    circles = Map2D(((3.0, 0.0, 0.2),))
    path = plan(space_of(2), circles, np.zeros(2), [_RIGHT, np.array([0.0, 1.0])])
    assert path.waypoints[-1] == pytest.approx([0.0, 1.0])


def test_goals_are_drawn_where_the_first_cannot_be_reached() -> None:
    # A closed ring around the first goal.
    angles = np.linspace(0.0, math.tau, 24, endpoint=False)
    ring = Map2D(tuple((1.5 + 0.8 * math.cos(a), 0.8 * math.sin(a), 0.2) for a in angles))
    offered = [np.array([1.5, 0.0]), np.array([-1.0, 2.0])]

    def source(rng: np.random.Generator) -> FloatArray | None:
        return offered.pop(0) if offered else None

    path = plan(space_of(2), ring, np.array([-2.0, 0.0]), source, search=Search(time_limit_s=100.0))
    assert path.waypoints[-1] == pytest.approx([-1.0, 2.0])


def test_a_goal_that_nothing_reaches_is_no_ik_solution() -> None:
    with pytest.raises(PlanningError, match="no configuration that reaches the goal") as caught:
        plan(space_of(2), Map2D(()), _LEFT, lambda rng: None)
    assert caught.value.code is ErrorCode.NO_IK_SOLUTION
    with pytest.raises(PlanningError, match="goal: the robot collides with circle 0") as caught:
        plan(space_of(2), Map2D(((3.0, 0.0, 0.2),)), _LEFT, lambda rng: _RIGHT)
    assert caught.value.code is ErrorCode.GOAL_IN_COLLISION


def test_what_cannot_be_reached_times_out_and_says_so() -> None:
    angles = np.linspace(0.0, math.tau, 24, endpoint=False)
    ring = Map2D(tuple((0.8 * math.cos(a), 0.8 * math.sin(a), 0.2) for a in angles))
    with pytest.raises(PlanningError, match=r"RRTConnect found no path within 0\.2 s") as caught:
        plan(space_of(2), ring, _LEFT, [np.zeros(2)], search=Search(time_limit_s=0.2))
    assert caught.value.code is ErrorCode.TIMED_OUT


def test_walls_thinner_than_the_search_is_fine_are_found_by_the_last_check() -> None:
    wall = Map2D(tuple((0.0, y, 0.02) for y in np.arange(-math.pi, 1.0, 0.03)))
    for seed in range(1):
        path = plan(
            space_of(2),
            wall,
            np.array([-1.0, 0.0]),
            [np.array([1.0, 0.0])],
            search=Search(seed=seed),
        )
        assert first_fault(space_of(2), wall, path.waypoints, 0.001) == ""
        assert path.length > 2.5


def test_names_of_planners_are_understood_as_moveit_writes_them() -> None:
    for name in ("", "RRTkConfigDefault", "geometric::RRT", "arm[RRTkConfigDefault]"):
        path = plan(space_of(2), Map2D(()), _LEFT, [_RIGHT], search=Search(planner=name))
        assert path.planner == ("RRT" if name else "RRTConnect")
        assert path.notes == ()
    path = plan(space_of(2), Map2D(()), _LEFT, [_RIGHT], search=Search(planner="RRTConect"))
    assert path.planner == "RRTConnect"
    assert path.notes == (
        "there is no planner 'RRTConect'; RRTConnect plans instead, as in MoveIt. "
        "Did you mean 'RRTConnect'?",
    )


def test_start_and_goal_in_one_place_are_a_path() -> None:
    path = plan(space_of(2), Map2D(()), _LEFT, [_LEFT])
    assert path.waypoints.shape == (2, 2)
    assert path.length == 0.0
