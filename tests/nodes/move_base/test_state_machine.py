"""What move_base does when: the rules and words of the original, without threads or topics."""

from __future__ import annotations

import math
from typing import Any

import pytest

from gazelle.nodes.move_base.state_machine import (
    MoveBaseStateMachine,
    Outcome,
    PlanPose,
    State,
    Timing,
    Trigger,
)

_PLAN = [PlanPose(0.0, 0.0, 0.0), PlanPose(1.0, 0.0, 0.0)]
_HERE = PlanPose(0.0, 0.0, 0.0)


class _Drive:
    """A robot that does what the test says and keeps what it was told."""

    def __init__(self) -> None:
        self.now_s = 0.0
        self.current = self.takes_plan = True
        self.reached = False
        self.no_control = ""
        self.recovery_count = 4
        self.done: list[Any] = []

    def is_current(self) -> bool:
        return self.current

    def set_plan(self, plan: Any) -> bool:
        self.done.append("plan")
        return self.takes_plan

    def is_goal_reached(self) -> bool:
        return self.reached

    def control(self) -> str:
        if not self.no_control:
            self.done.append("move")
        return self.no_control

    def stop(self) -> None:
        self.done.append("stop")

    def recover(self, index: int, trigger: Trigger) -> None:
        self.done.append((index, trigger))
        self.now_s += 10.0

    def log(self, level: str, text: str) -> None:
        self.done.append(text)

    def now_ns(self) -> int:
        return int(self.now_s * 1e9)


@pytest.fixture
def drive() -> _Drive:
    return _Drive()


def _recoveries(drive: _Drive) -> list[Any]:
    return [one for one in drive.done if isinstance(one, tuple)]


def test_goal_goes_from_planning_to_control_to_success(drive) -> None:
    executive = MoveBaseStateMachine(drive, Timing())
    executive.begin()
    assert executive.wants_plan
    assert executive.cycle(_HERE) is None
    executive.planned(_PLAN)
    assert executive.state is State.CONTROLLING
    assert not executive.wants_plan
    assert executive.cycle(_HERE) is None
    assert drive.done == ["plan", "move"]
    drive.reached = True
    assert executive.cycle(_HERE) == (Outcome.SUCCEEDED, "Goal reached.")
    assert drive.done[-1] == "stop"


def test_planner_frequency_keeps_the_planner_running(drive) -> None:
    executive = MoveBaseStateMachine(drive, Timing(planner_frequency_hz=5.0))
    executive.begin()
    executive.planned(_PLAN)
    assert executive.wants_plan
    # Without a new plan the old one goes on.
    executive.planned(None, "blocked")
    assert executive.state is State.CONTROLLING


def test_planner_patience_ends_in_all_recoveries_and_the_reason(drive) -> None:
    executive = MoveBaseStateMachine(drive, Timing(planner_patience_s=5.0))
    executive.begin()
    for _ in range(4):
        drive.now_s += 4.9
        executive.planned(None, "the goal is in an obstacle")
        assert executive.state is State.PLANNING
        drive.now_s += 0.2
        executive.planned(None, "the goal is in an obstacle")
        assert executive.state is State.CLEARING
        assert executive.cycle(_HERE) is None
        executive.cycle(_HERE)
    drive.now_s += 6
    executive.planned(None, "the goal is in an obstacle")
    end = executive.cycle(_HERE)
    assert end is not None
    assert end.outcome is Outcome.ABORTED
    assert end.text == (
        "Failed to find a valid plan. Even after executing recovery behaviors."
        " Last reason: the goal is in an obstacle"
    )
    assert _recoveries(drive) == [(index, Trigger.PLANNING) for index in range(4)]


def test_max_planning_retries_end_patience_early(drive) -> None:
    executive = MoveBaseStateMachine(drive, Timing(max_planning_retries=1))
    executive.begin()
    executive.planned(None, "no")
    assert executive.state is State.PLANNING
    executive.planned(None, "no")
    assert executive.state is State.CLEARING


def test_controller_patience_plans_again_before_it_clears(drive) -> None:
    executive = MoveBaseStateMachine(drive, Timing(controller_patience_s=15.0))
    executive.begin()
    executive.planned(_PLAN)
    drive.no_control = "every way is blocked"
    executive.cycle(_HERE)
    assert executive.state is State.PLANNING
    executive.planned(_PLAN)
    drive.now_s = 15.1
    executive.cycle(_HERE)
    assert executive.state is State.CLEARING
    executive.cycle(_HERE)
    assert _recoveries(drive) == [(0, Trigger.CONTROLLING)]


def test_success_of_what_failed_starts_recoveries_from_the_first_again(drive) -> None:
    executive = MoveBaseStateMachine(drive, Timing(planner_patience_s=1.0))
    executive.begin()
    drive.now_s = 2.0
    executive.planned(None, "no")
    executive.cycle(_HERE)
    executive.cycle(_HERE)
    executive.planned(_PLAN)
    executive.cycle(_HERE)
    executive.state = State.PLANNING
    executive.cycle(_HERE)
    drive.now_s += 20.0
    executive.planned(None, "no")
    executive.cycle(_HERE)
    assert _recoveries(drive) == [(0, Trigger.PLANNING), (0, Trigger.PLANNING)]


def test_staying_in_one_place_is_oscillation(drive) -> None:
    timing = Timing(oscillation_timeout_s=10.0, oscillation_distance_m=0.2)
    executive = MoveBaseStateMachine(drive, timing)
    executive.begin()
    executive.planned(_PLAN)
    for second, x in ((0, 0.0), (9, 0.1), (9.5, 0.3), (19, 0.4)):
        drive.now_s = second
        executive.cycle(PlanPose(x, 0.0, 0.0))
        assert executive.state is State.CONTROLLING
    drive.now_s = 19.6
    executive.cycle(PlanPose(0.4, 0.0, 0.0))
    assert (executive.state, executive.trigger) == (State.CLEARING, Trigger.OSCILLATION)


def _drive_on(drive: _Drive, executive: MoveBaseStateMachine, poses: list[PlanPose]) -> float:
    """Cycle once a second; return when a recovery began, infinite for never."""
    for pose in poses:
        drive.now_s += 1.0
        executive.cycle(pose)
        if executive.state is State.CLEARING:
            return drive.now_s
    return math.inf


def test_a_robot_that_gets_nowhere_with_commands_clears_after_its_patience(drive) -> None:
    executive = MoveBaseStateMachine(drive, Timing(controller_patience_s=15.0))
    executive.begin()
    drive.now_s = 100.0
    executive.planned(_PLAN)
    # Patience begins with the first command. Swinging to and fro is getting nowhere.
    swing = [PlanPose(0.05 * (i % 2), 0.0, 0.2 * (-1) ** i) for i in range(60)]
    assert _drive_on(drive, executive, swing) == 117.0
    assert executive.trigger is Trigger.OSCILLATION
    text = "The robot got nowhere for 15 s, though the controller has commands"
    assert any(str(one).startswith(text) for one in drive.done)
    ended = None
    while ended is None:
        drive.now_s += 1.0
        executive.planned(_PLAN)
        ended = executive.cycle(_HERE)
    assert [index for index, _ in _recoveries(drive)] == [0, 1, 2, 3]
    assert ended.outcome is Outcome.ABORTED
    assert ended.text.startswith("Robot is oscillating. Even after executing recovery behaviors.")
    assert "got nowhere for 15 s" in ended.text


def test_a_robot_that_creeps_or_turns_gets_on(drive) -> None:
    executive = MoveBaseStateMachine(drive, Timing(controller_patience_s=15.0))
    executive.begin()
    executive.planned(_PLAN)
    creeping = [PlanPose(0.01 * i, 0.0, 0.0) for i in range(60)]
    assert _drive_on(drive, executive, creeping) == math.inf
    turning = [PlanPose(0.7, 0.0, 0.06 * i) for i in range(100)]
    assert _drive_on(drive, executive, turning) == math.inf
    # Once around on the spot is enough.
    begin_s = drive.now_s
    spinning = [PlanPose(0.7, 0.0, 6.0 + 0.5 * i) for i in range(100)]
    assert _drive_on(drive, executive, spinning) < begin_s + 20.0


def test_time_without_sensors_is_not_time_without_getting_on(drive) -> None:
    executive = MoveBaseStateMachine(drive, Timing(controller_patience_s=15.0))
    executive.begin()
    executive.planned(_PLAN)
    assert _drive_on(drive, executive, [_HERE] * 10) == math.inf
    drive.current = False
    assert _drive_on(drive, executive, [_HERE] * 30) == math.inf
    drive.current = True
    assert _drive_on(drive, executive, [_HERE] * 15) == math.inf
    assert _drive_on(drive, executive, [_HERE] * 5) < math.inf


def test_stale_sensors_stop_the_robot(drive) -> None:
    executive = MoveBaseStateMachine(drive, Timing())
    executive.begin()
    executive.planned(_PLAN)
    drive.current = False
    assert executive.cycle(_HERE) is None
    assert "Sensor data is out of date" in drive.done[0]
    assert drive.done[1] == "stop"


def test_controller_that_refuses_the_plan_aborts(drive) -> None:
    executive = MoveBaseStateMachine(drive, Timing())
    executive.begin()
    executive.planned(_PLAN)
    drive.takes_plan = False
    assert executive.cycle(_HERE) == (
        Outcome.ABORTED, "Failed to pass global plan to the controller.",
    )  # fmt: skip


def test_without_recovery_a_goal_is_given_up_at_once(drive) -> None:
    executive = MoveBaseStateMachine(drive, Timing(planner_patience_s=0.0, recovery_enabled=False))
    executive.begin()
    drive.now_s = 0.1
    executive.planned(None, "no")
    end = executive.cycle(_HERE)
    assert end is not None
    assert end.outcome is Outcome.ABORTED
    assert not _recoveries(drive)


def test_plans_for_a_goal_that_is_over_are_dropped(drive) -> None:
    executive = MoveBaseStateMachine(drive, Timing())
    executive.begin()
    executive.end()
    executive.planned(_PLAN)
    assert executive.state is State.PLANNING
