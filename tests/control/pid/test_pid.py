"""The PID against its formula, written down a second time."""

from __future__ import annotations

import math
import random
import time
import timeit
from dataclasses import replace

import numpy as np
import pytest

from gazelle.control.pid import AntiWindup, Pid, PidArray, PidGains

PERIOD_S = 0.001


class Reference:
    """control_toolbox' formula (wiki.ros.org/control_toolbox), in the order it is printed there."""

    def __init__(self, gains: PidGains) -> None:
        self.gains = gains
        self.sum_of_errors = 0.0
        self.previous = 0.0

    def __call__(self, error: float, dt: float) -> float:
        g = self.gains
        self.sum_of_errors += error * dt
        if g.antiwindup and g.i:
            ends = sorted((g.i_min / g.i, g.i_max / g.i))
            self.sum_of_errors = float(np.clip(self.sum_of_errors, *ends))
        integral = g.i * self.sum_of_errors
        if not g.antiwindup:
            integral = float(np.clip(integral, g.i_min, g.i_max))
        slope = (error - self.previous) / dt
        self.previous = error
        return float(np.clip(g.p * error + integral + g.d * slope, g.u_min, g.u_max))


def _errors(count: int) -> list[float]:
    noise = random.Random(4)
    return [math.sin(0.01 * k) * 3.0 + noise.gauss(0.0, 0.1) for k in range(count)]


GAINS = (
    PidGains(100.0, 10.0, 1.0, 0.5, -0.2),
    PidGains(100.0, 10.0, 1.0, 0.5, -0.2, antiwindup=True),
    PidGains(3.0, -2.0, 0.1, 0.5, -0.2, antiwindup=True),
    PidGains(3.0, 2.0, 0.0),
    PidGains(3.0, 2.0, 0.0, math.inf, -math.inf),
    PidGains(30.0, 20.0, 0.2, 5.0, -5.0, u_max=40.0, u_min=-10.0),
)


@pytest.mark.parametrize("gains", GAINS)
def test_command_is_the_published_formula(gains: PidGains) -> None:
    pid, reference = Pid(gains), Reference(gains)
    for error in _errors(3000):
        assert pid.compute(error, PERIOD_S) == pytest.approx(reference(error, PERIOD_S), abs=1e-9)


def test_integral_without_clamp_adds_nothing() -> None:
    with_i, without_i = Pid(PidGains(2.0, 50.0, 0.1)), Pid(PidGains(2.0, 0.0, 0.1))
    for error in _errors(500):
        assert with_i.compute(error, PERIOD_S) == without_i.compute(error, PERIOD_S)


def test_antiwindup_leaves_the_bound_at_once() -> None:
    wound, kept = (Pid(PidGains(0.0, 1.0, 0.0, 1.0, -1.0, antiwindup=on)) for on in (False, True))
    for _ in range(100):
        assert wound.compute(1.0, 0.1) == kept.compute(1.0, 0.1)
    assert kept.compute(-1.0, 0.1) == pytest.approx(0.9)
    assert wound.compute(-1.0, 0.1) == 1.0


def test_first_derivative_counts_from_zero() -> None:
    pid = Pid(PidGains(0.0, 0.0, 2.0))
    assert pid.compute(0.5, 0.01) == pytest.approx(2.0 * 0.5 / 0.01)
    assert pid.compute(0.5, 0.01) == 0.0
    pid.reset()
    assert pid.compute(0.5, 0.01) == pytest.approx(100.0)


@pytest.mark.parametrize("error", [math.nan, math.inf, -math.inf])
def test_no_number_commands_nothing_and_changes_nothing(error: float) -> None:
    pid, untouched = Pid(GAINS[0]), Pid(GAINS[0])
    for one in (pid, untouched):
        one.compute(0.3, PERIOD_S)
    assert pid.compute(error, PERIOD_S) == 0.0
    assert pid.compute_with_rate(0.1, error, PERIOD_S) == 0.0
    assert pid.compute(0.3, 0.0) == 0.0
    assert pid.errors == untouched.errors
    assert pid.compute(0.4, PERIOD_S) == untouched.compute(0.4, PERIOD_S)


def test_given_rate_replaces_the_difference() -> None:
    pid = Pid(PidGains(2.0, 0.0, 3.0))
    assert pid.compute_with_rate(1.0, -0.5, PERIOD_S) == pytest.approx(2.0 - 1.5)
    assert pid.errors == (1.0, PERIOD_S, -0.5)


def test_live_gains_scale_the_integral_so_far() -> None:
    pid = Pid(PidGains(0.0, 1.0, 0.0, 100.0, -100.0))
    for _ in range(10):
        pid.compute(2.0, 0.1)
    pid.gains = replace(pid.gains, i=3.0)
    assert pid.compute(0.0, 0.1) == pytest.approx(3.0 * 2.0)


def test_terms_add_up_to_the_command() -> None:
    for gains in (*GAINS[:5], PidGains(2.0, 1.0, 0.1, 9.0, -9.0, strategy=AntiWindup.NONE)):
        pid = Pid(gains)
        for error in _errors(50):
            before = pid.errors[1]
            command = pid.compute(error, PERIOD_S)
            p, i, d = pid.terms
            if gains.strategy is not AntiWindup.LEGACY:
                i = before
            assert p + i + d == pytest.approx(command)


def _newer(strategy: AntiWindup, **more: float) -> Pid:
    limits = {"i_max": math.inf, "i_min": -math.inf, "u_max": 1.0, "u_min": -1.0}
    return Pid(PidGains(1.0, 2.0, 0.5, strategy=strategy, **{**limits, **more}))


def test_back_calculation_drains_the_integral_by_what_was_cut() -> None:
    pid, integral = _newer(AntiWindup.BACK_CALCULATION), 0.0
    tracking_s = math.sqrt(0.5 / 2.0)
    previous = 0.0
    for error in _errors(500):
        wanted = error + integral + 0.5 * (error - previous) / 0.01
        command = max(-1.0, min(wanted, 1.0))
        assert pid.compute(error, 0.01) == pytest.approx(command, abs=1e-9)
        integral += 0.01 * (2.0 * error + (command - wanted) / tracking_s)
        previous = error


def test_conditional_integration_waits_while_the_command_is_cut() -> None:
    pid = _newer(AntiWindup.CONDITIONAL_INTEGRATION)
    for _ in range(100):
        assert pid.compute_with_rate(5.0, 0.0, 0.01) == 1.0
    assert pid.errors[1] == 0.0
    free = _newer(AntiWindup.NONE)
    for _ in range(100):
        free.compute_with_rate(5.0, 0.0, 0.01)
    assert free.errors[1] == pytest.approx(2.0 * 5.0 * 1.0)


def test_deadband_stops_the_newer_integrals() -> None:
    pid = _newer(AntiWindup.NONE, error_deadband=0.1)
    pid.compute_with_rate(0.1, 0.0, 1.0)
    assert pid.errors[1] == 0.0
    pid.compute_with_rate(0.2, 0.0, 1.0)
    assert pid.errors[1] == pytest.approx(0.4)


def test_newer_strategies_repeat_the_command_and_pass_nan_on() -> None:
    pid = _newer(AntiWindup.NONE)
    command = pid.compute_with_rate(0.3, 0.0, 0.01)
    assert pid.compute_with_rate(0.9, 0.0, 0.0) == command
    assert math.isnan(pid.compute(math.nan, 0.01))


def test_bank_computes_what_single_pids_compute() -> None:
    gains = (*GAINS, PidGains(1.0, 2.0, 0.5, 3.0, -3.0, u_max=2.0, strategy=AntiWindup.NONE))
    pids, singles = PidArray(gains), [Pid(row) for row in gains]
    noise = np.random.default_rng(3)
    for step in range(400):
        errors = noise.normal(size=len(gains))
        rates = noise.normal(size=len(gains)) if step % 3 == 0 else None
        if step % 7 == 0:
            errors[step % len(gains)] = math.nan
        if step == 200:
            for place, pid in enumerate(singles):
                pid.gains = replace(pid.gains, i=1.5)
                pids.set_gains(place, pid.gains)
        period_s = 0.0 if step == 50 else PERIOD_S
        if rates is None:
            wanted = [p.compute(float(e), period_s) for p, e in zip(singles, errors, strict=True)]
        else:
            rows = zip(singles, errors, rates, strict=True)
            wanted = [p.compute_with_rate(float(e), float(r), period_s) for p, e, r in rows]
        assert pids.compute(errors, period_s, rates) == pytest.approx(wanted, nan_ok=True)
        if step % 7:
            continue
        integrals = [pid.errors[1] for pid in singles]
        assert pids.errors[1] == pytest.approx(integrals)


def test_bank_resets_some() -> None:
    pids = PidArray(GAINS)
    pids.compute(np.ones(len(GAINS)), PERIOD_S)
    pids.reset([1])
    assert pids.errors[1][1] == 0.0 and pids.errors[1][0] == PERIOD_S
    assert pids.compute(np.zeros(len(GAINS)), 1.0)[1] == 0.0


def test_bank_leaves_the_arrays_of_others_alone() -> None:
    pids, rates = PidArray([PidGains(2.0, 0.0, 1.0)] * 2), np.array([0.5, 0.25])
    first = pids.compute(np.ones(2), PERIOD_S, rates)
    pids.reset()
    pids.compute(np.zeros(2), PERIOD_S, np.zeros(2))
    assert list(first) == [2.5, 2.25] and list(rates) == [0.5, 0.25]


def test_contradicting_bounds_are_a_problem() -> None:
    assert "received i_min > i_max" in PidGains(i_min=1.0).problem
    assert "u_min > u_max" in PidGains(u_min=1.0, u_max=0.0).problem
    assert not GAINS[0].problem


def test_one_computation_takes_microseconds() -> None:
    pid = Pid(GAINS[0])
    timer = timeit.Timer(lambda: pid.compute(0.25, PERIOD_S), timer=time.thread_time)
    best = min(timer.repeat(number=20_000, repeat=5))
    assert best / 20_000 < 4e-6
