from __future__ import annotations

from gazelle.simulator.pace import ClockJump, Pace, Standstill


class Wall:
    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


def test_a_world_ahead_of_real_time_waits_for_the_difference() -> None:
    wall = Wall()
    pace = Pace(1.0, clock=wall)
    wall.now += 0.010
    assert abs(pace.lead_s(30_000_000) - 0.020) < 1e-9


def test_a_factor_of_two_needs_half_the_wall_time() -> None:
    wall = Wall()
    pace = Pace(2.0, clock=wall)
    assert abs(pace.lead_s(1_000_000_000) - 0.5) < 1e-9


def test_a_world_far_behind_does_not_catch_up() -> None:
    wall = Wall()
    pace = Pace(1.0, clock=wall)
    wall.now += 5.0
    assert pace.lead_s(1_000_000) == 0.0
    assert abs(pace.lead_s(11_000_000) - 0.010) < 1e-9


def test_no_factor_never_waits() -> None:
    assert Pace(0.0, clock=Wall()).lead_s(10**12) == 0.0


def test_slices_are_a_few_milliseconds_of_wall_time() -> None:
    assert Pace(1.0).slice_steps(1_000_000) == 4
    assert Pace(1.0).slice_steps(100_000_000) == 1


def test_a_long_time_without_computing_is_a_standstill() -> None:
    wall, work = Wall(), Wall()
    standstill = Standstill(clock=wall, computing=work)
    wall.now += 20.0
    work.now += 0.1
    assert standstill.look() == 20.0
    assert standstill.look() == 0.0


def test_compiling_and_waiting_for_the_next_step_are_no_standstill() -> None:
    wall, work = Wall(), Wall()
    standstill = Standstill(clock=wall, computing=work)
    wall.now += 20.0
    work.now += 15.0
    assert standstill.look() == 0.0
    wall.now += 20.0
    assert standstill.look(expected_s=19.0) == 0.0


def test_a_clock_that_is_set_jumps_one_that_is_corrected_does_not() -> None:
    wall, clock = Wall(), Wall()
    jump = ClockJump(wall=wall, clock=clock)
    wall.now, clock.now = wall.now + 10.02, clock.now + 10.0
    assert jump.look() == 0.0
    wall.now -= 3600.0
    assert jump.look() == -3600.0
    assert jump.look() == 0.0
