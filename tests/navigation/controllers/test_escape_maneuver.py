"""Turns on the spot and straight pieces where a controller finds no way on."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from gazelle.navigation.controllers import Command, NoCommand, RobotState
from gazelle.navigation.controllers.escape_maneuver import Maneuvering, Pace
from gazelle.navigation.controllers.escape_maneuver_kernels import find_maneuver
from gazelle.navigation.controllers.rollout_arguments import Outline
from gazelle.navigation.costmap import CostGrid, Footprint, footprint_cost

_LONG = Footprint.parse([[0.3, 0.15], [-0.3, 0.15], [-0.3, -0.15], [0.3, -0.15]])
_PACE = Pace(m_s=0.2, rad_s=0.6, slowest_rad_s=0.1)
_EAST = np.column_stack([np.linspace(0.5, 3.5, 61), np.full(61, 1.5), np.zeros(61)])


def _grid(*boxes: tuple[float, float, float, float]) -> CostGrid:
    """4 m × 3 m with walls around it, and boxes from x to x and from y to y."""
    costs = np.zeros((60, 80), np.uint8)
    costs[[0, -1]] = costs[:, [0, -1]] = 254
    for x0, x1, y0, y1 in boxes:
        costs[round(y0 * 20) : round(y1 * 20), round(x0 * 20) : round(x1 * 20)] = 254
    return CostGrid(costs, 0.05)


def _way(grid: CostGrid, start: Any, target: Any, footprint: Footprint = _LONG) -> np.ndarray:
    outline = Outline(footprint.points, footprint.inscribed_m, footprint.circumscribed_m, 1.0)
    return np.asarray(find_maneuver(grid.cells, outline, np.array(start), np.array(target), 0.06))


class _Inner:
    """A controller that says what the test says."""

    def __init__(self, answer: Any) -> None:
        self.answer = answer
        self.calls = 0
        self.limits: list[float | None] = []

    def set_plan(self, plan: Any, *, has_moved: bool = False) -> None:
        pass

    def compute(self, state: Any, grid: Any, footprint: Any) -> Any:
        self.calls += 1
        return self.answer

    def goal_reached(self, state: RobotState) -> bool:
        return math.dist(state.pose[:2], (3.5, 1.5)) < 0.1

    def limit_speed(self, m_s: float | None) -> None:
        self.limits.append(m_s)

    def reset(self) -> None:
        pass


def _drive(controller: Maneuvering, grid: CostGrid, pose: list[float], calls: int) -> list[Any]:
    """Drive exactly what is commanded, 0.1 s each; return the commands."""
    found = []
    for _ in range(calls):
        command = controller.compute(RobotState((pose[0], pose[1], pose[2])), grid, _LONG)
        found.append(command)
        if isinstance(command, Command):
            v, _, w = command.velocity
            pose[2] += w * 0.1
            pose[0] += v * 0.1 * math.cos(pose[2])
            pose[1] += v * 0.1 * math.sin(pose[2])
            assert footprint_cost(grid, _LONG, (pose[0], pose[1], pose[2])) >= 0
    return found


# A passage of 0.4 m in a wall; the robot stands along the wall beside it.
_PASSAGE = ((1.9, 2.1, 0.0, 1.3), (1.9, 2.1, 1.7, 3.0))
_ALONG = (1.7, 1.5, math.pi / 2)


def test_a_way_is_free_and_made_of_steps_and_turns() -> None:
    grid = _grid(*_PASSAGE)
    way = _way(grid, _ALONG, (2.8, 1.5, 0.0))
    assert len(way) > 20
    assert way[0, :2] == pytest.approx(_ALONG[:2])
    assert math.dist(way[-1, :2], (2.8, 1.5)) <= 0.06
    assert math.remainder(way[-1, 2], math.tau) == pytest.approx(0.0, abs=1e-9)
    for pose in way:
        assert footprint_cost(grid, _LONG, tuple(pose)) >= 0
    lengths = np.hypot(*np.diff(way[:, :2], axis=0).T)
    turns = np.abs([math.remainder(one, math.tau) for one in np.diff(way[:, 2])])
    for length, turn in zip(lengths, turns, strict=True):
        kind = (round(float(length), 6), round(float(turn), 6))
        assert kind in {(0.05, 0.0), (0.0, round(math.tau / 48, 6))}
    # It cannot turn where it stands: one of its ends would hit the wall beside the passage.
    assert lengths[0] == pytest.approx(0.05)


def test_there_is_no_way_through_what_is_too_narrow_or_to_outside() -> None:
    narrow = _grid((1.9, 2.1, 0.0, 1.4), (1.9, 2.1, 1.6, 3.0))
    assert not len(_way(narrow, _ALONG, (2.8, 1.5, 0.0)))
    assert not len(_way(_grid(), (1.0, 1.5, 0.0), (5.0, 1.5, 0.0)))
    assert len(_way(narrow, _ALONG, (2.8, 1.5, 0.0), Footprint.of_radius(0.04)))


def test_a_controller_that_finds_a_way_is_left_alone() -> None:
    answer = Command((0.3, 0.0, 0.1), np.zeros((1, 3)))
    inner = _Inner(answer)
    controller = Maneuvering(inner, _PACE, 0.1)
    assert controller.compute(RobotState((0.5, 1.5, 0.0)), _grid(), _LONG) is answer
    controller.set_plan(_EAST)
    pose = [0.5, 1.5, 0.0]
    assert all(one is answer for one in _drive(controller, _grid(), pose, 60))
    controller.limit_speed(0.1)
    assert inner.limits == [0.1]


def test_after_some_refusals_a_maneuver_leads_on() -> None:
    inner = _Inner(NoCommand("no velocity is good"))
    controller = Maneuvering(inner, _PACE, 0.1)
    controller.set_plan(_EAST)
    grid, pose = _grid(*_PASSAGE), list(_ALONG)
    found = _drive(controller, grid, pose, 3)
    assert [isinstance(one, Command) for one in found] == [False, False, True]
    assert found[2].note.startswith("no velocity is good; ")
    assert found[2].note.endswith(" m in straight pieces and turns on the spot lead on")
    calls = inner.calls
    for _ in range(400):
        (command,) = _drive(controller, grid, pose, 1)
        if inner.calls > calls:
            break
        assert not command.note
        assert abs(command.velocity[0]) <= 0.2 and abs(command.velocity[2]) <= 0.6
    assert pose[0] > 2.5 and abs(pose[1] - 1.5) < 0.08


def test_a_robot_that_gets_nowhere_maneuvers_but_not_in_its_goal() -> None:
    inner = _Inner(Command((0.0, 0.0, 0.0), np.zeros((1, 3))))
    for x, maneuvers in ((1.0, True), (3.4, False)):
        controller = Maneuvering(inner, _PACE, 0.1)
        controller.set_plan(_EAST)
        found = _drive(controller, _grid(), [x, 1.5, 0.0], 100)
        first = next((k for k, one in enumerate(found) if one.note), None)
        assert (first is not None) == maneuvers
        if first is not None:
            assert first == 60
            assert found[first].note.startswith("the robot gets nowhere; ")


def test_a_robot_that_swings_maneuvers_after_a_while() -> None:
    inner = _Inner(Command((0.1, 0.0, 0.0), np.zeros((1, 3))))
    for shift_m, maneuvers in ((0.0, True), (0.008, False)):
        controller = Maneuvering(inner, _PACE, 0.1)
        controller.set_plan(_EAST)
        notes = []
        for k in range(250):
            # A quarter of a metre to and fro, in two seconds each; or getting on by that.
            x = 0.6 + 0.25 * abs(k % 40 - 20) / 20 + shift_m * k
            found: Any = controller.compute(RobotState((x, 1.5, 0.0)), _grid(), _LONG)
            notes.append(found.note)
        assert any(notes) == maneuvers
        assert not any(notes[:200])


def test_what_leads_no_further_four_times_is_given_up_until_the_next_goal() -> None:
    inner = _Inner(NoCommand("stuck"))
    controller = Maneuvering(inner, _PACE, 0.1)
    controller.set_plan(_EAST)
    grid = _grid()
    begun = 0
    for _ in range(40):
        # Somebody puts it back each time.
        found = _drive(controller, grid, [1.0, 1.5, 0.0], 1)[0]
        begun += isinstance(found, Command) and bool(found.note)
        controller._way = None
    assert begun == 4
    controller.set_plan(_EAST + np.array([0.0, 0.5, 0.0]))
    assert isinstance(_drive(controller, grid, [1.0, 1.5, 0.0], 3)[2], Command)


def test_a_maneuver_ends_where_something_comes_into_its_way() -> None:
    controller = Maneuvering(_Inner(NoCommand("stuck")), _PACE, 0.1)
    controller.set_plan(_EAST)
    pose = [1.0, 1.5, 0.0]
    assert isinstance(_drive(controller, _grid(), pose, 4)[3], Command)
    wall = _grid((1.4, 1.5, 0.0, 3.0))
    assert _drive(controller, wall, pose, 1) == [NoCommand("stuck")]


def test_a_robot_that_touches_something_gets_away_from_it() -> None:
    controller = Maneuvering(_Inner(NoCommand("stuck")), _PACE, 0.1)
    controller.set_plan(_EAST)
    # Two centimetres of its corner are in the box.
    grid, state = _grid((1.25, 1.3, 1.6, 1.65)), RobotState((0.97, 1.5, 0.0))
    assert footprint_cost(grid, _LONG, state.pose) == -1
    found = [controller.compute(state, grid, _LONG) for _ in range(3)]
    assert isinstance(found[2], Command)
    # From the middle of a wall there is no way.
    grid.costs[:] = 254
    lost = Maneuvering(_Inner(NoCommand("stuck")), _PACE, 0.1)
    lost.set_plan(_EAST)
    assert [lost.compute(state, grid, _LONG) for _ in range(6)] == [NoCommand("stuck")] * 6
