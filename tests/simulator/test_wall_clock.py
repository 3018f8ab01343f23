from __future__ import annotations

from gazelle.simulator.wall_clock import Pace


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
