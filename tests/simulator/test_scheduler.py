from __future__ import annotations

import itertools
from fractions import Fraction

import pytest

from gazelle.simulator.scheduler import (
    NEVER,
    ORDER_CLOCK,
    ORDER_CONTROL,
    ORDER_SENSOR,
    Scheduler,
    Task,
    gz_sensor_period_in_steps,
    measured_period_in_steps,
    period_in_steps,
    throttled_period_in_steps,
)

MS = 1_000_000


def run_until(scheduler: Scheduler, last: int) -> list[int]:
    """Advance as the loop does: from one due iteration to the next."""
    iteration, visited = 0, []
    while iteration < last:
        iteration = min(last, max(iteration + 1, scheduler.next_due()))
        scheduler.run_due(iteration)
        visited.append(iteration)
    return visited


@pytest.mark.parametrize(
    ("rate_hz", "steps"), [(5.5, 182), (20.0, 50), (15.0, 67), (30.0, 34), (1000.0, 1), (0.0, 1)]
)
def test_periods_from_the_last_message_are_whole_steps_rounded_up(
    rate_hz: float, steps: int
) -> None:
    assert measured_period_in_steps(rate_hz, MS) == steps


@pytest.mark.parametrize(("rate_hz", "steps"), [(30.0, 33), (5.5, 181), (2000.0, 1), (0.0, 1)])
def test_periods_of_gz_sensors_are_whole_milliseconds_rounded_down(
    rate_hz: float, steps: int
) -> None:
    assert gz_sensor_period_in_steps(rate_hz, MS) == steps
    assert gz_sensor_period_in_steps(30.0, 4 * MS) == Fraction(33, 4)


@pytest.mark.parametrize(
    ("rate_hz", "steps"), [(0.0, Fraction(100, 3)), (15.0, Fraction(200, 3)), (29.0, 200 / 3)]
)
def test_a_plug_in_that_throttles_skips_whole_readings(rate_hz: float, steps: float) -> None:
    assert throttled_period_in_steps(period_in_steps(30.0, MS), rate_hz, MS) == pytest.approx(steps)


def test_plug_in_rates_are_exact_on_average() -> None:
    scheduler, ticks = Scheduler(MS), []
    scheduler.add(Task("30 Hz", period_in_steps(30.0, MS), lambda: ticks.append(scheduler._now)))
    run_until(scheduler, 3000)
    assert ticks[:3] == [34, 67, 100]
    assert len(ticks) == 90


def test_nothing_is_visited_between_due_steps() -> None:
    scheduler = Scheduler(MS)
    scheduler.add(Task("ten", Fraction(10), lambda: None))
    assert run_until(scheduler, 50) == [10, 20, 30, 40, 50]


def test_tasks_of_one_step_run_in_order_of_kind_then_of_adding() -> None:
    scheduler, ran = Scheduler(MS), []
    for name, order in (
        ("scan", ORDER_SENSOR),
        ("drive", ORDER_CONTROL),
        ("clock", ORDER_CLOCK),
        ("second drive", ORDER_CONTROL),
    ):
        scheduler.add(Task(name, Fraction(1), lambda name=name: ran.append(name), order))
    scheduler.run_due(1)
    assert ran == ["clock", "drive", "second drive", "scan"]


def test_unwanted_tasks_sleep_and_are_asked_every_50_ms() -> None:
    scheduler, asked = Scheduler(MS), []

    def wanted() -> bool:
        asked.append(scheduler._now)
        return False

    scheduler.add(Task("idle", Fraction(1), lambda: None, wanted=wanted))
    run_until(scheduler, 1000)
    assert len(asked) <= 20
    assert max(b - a for a, b in itertools.pairwise(asked)) <= 100


def test_a_task_that_becomes_wanted_keeps_its_grid() -> None:
    scheduler, ticks, wanted = Scheduler(MS), [], [False]
    scheduler.add(
        Task("scan", Fraction(182), lambda: ticks.append(scheduler._now), wanted=lambda: wanted[0])
    )
    run_until(scheduler, 400)
    wanted[0] = True
    scheduler.look()
    iteration = 400
    while iteration < 1000:
        iteration = min(1000, scheduler.next_due())
        scheduler.run_due(iteration)
    assert ticks == [546, 728, 910]


def test_restart_begins_all_grids_at_zero() -> None:
    scheduler, ticks = Scheduler(MS), []
    scheduler.add(Task("ten", Fraction(10), lambda: ticks.append(scheduler._now)))
    run_until(scheduler, 25)
    scheduler.restart()
    assert scheduler.next_due() == 10
    run_until(scheduler, 20)
    assert ticks == [10, 20, 10, 20]


def test_a_removed_task_never_runs_again_even_from_its_own_action() -> None:
    scheduler, runs = Scheduler(MS), []

    def once() -> None:
        runs.append(1)
        scheduler.remove(task)

    task = scheduler.add(Task("once", Fraction(5), once))
    scheduler.run_due(30)
    assert runs == [1]
    assert scheduler.next_due() == NEVER


def test_a_new_step_size_keeps_rates() -> None:
    scheduler, ticks = Scheduler(MS), []
    scheduler.add(Task("100 Hz", Fraction(10), lambda: ticks.append(scheduler._now)))
    scheduler.set_step(2 * MS)
    run_until(scheduler, 50)
    assert len(ticks) == 10


def test_many_missed_ticks_are_caught_up_one_by_one() -> None:
    scheduler, ticks = Scheduler(MS), []
    scheduler.add(Task("ten", Fraction(10), lambda: ticks.append(1)))
    assert scheduler.run_due(100) == 10


def test_what_a_task_raises_is_told_and_the_others_run() -> None:
    scheduler, ran, told = Scheduler(MS), [], []
    bad = scheduler.add(Task("bad", Fraction(1), lambda: ran.append(1 // 0)))
    scheduler.add(Task("good", Fraction(1), lambda: ran.append("good")))
    assert scheduler.run_due(1, lambda task, error: told.append((task, str(error)))) == 2
    assert ran == ["good"]
    assert told == [(bad, "integer division or modulo by zero")]
    with pytest.raises(ZeroDivisionError):
        scheduler.run_due(2)


def test_what_nobody_wants_is_put_to_rest_before_it_is_due() -> None:
    scheduler, ticks, wanted = Scheduler(MS), [], [False]
    task = Task("t", Fraction(1), lambda: ticks.append(1), wanted=lambda: wanted[0])
    scheduler.add(task)
    scheduler.add(Task("other", Fraction(20), lambda: ticks.append(20)))
    scheduler.rest()
    assert scheduler.next_due() == 20
    wanted[0] = True
    scheduler.look()
    assert scheduler.next_due() == 1
