"""Gains read from parameters."""

from __future__ import annotations

import math
from typing import Any

import pytest

from gazelle.control.controller_parameters import controller_parameters
from gazelle.control.pid import AntiWindup, PidGains, read_gains
from gazelle.control.pid.gains import gain_rows
from gazelle.diagnostics import Diagnostics
from gazelle.parameters import ParameterTable

TABLE = ParameterTable(
    "t",
    "t",
    ("t/T",),
    (*gain_rows("pid"), *gain_rows("gains.<j>")),
)


def _read(gains: Any, **options: Any) -> tuple[PidGains | None, Diagnostics]:
    found = Diagnostics()
    parameters = controller_parameters("c", {"pid": gains, "gains": {"j": gains}}, TABLE, found)
    return read_gains(parameters, **options), found


def test_no_gains_without_p() -> None:
    assert _read({"i": 1.0})[0] is None
    assert _read({"p": 2.0})[0] == PidGains(2.0)


def test_clamps_have_signs_of_their_own() -> None:
    gains, _ = _read({"p": 1, "i": 2, "d": 3, "i_clamp": -4})
    assert gains == PidGains(1.0, 2.0, 3.0, 4.0, -4.0)
    gains, _ = _read({"p": 1, "i_clamp": 4, "i_clamp_min": 0.5, "antiwindup": True})
    assert gains == PidGains(1.0, 0.0, 0.0, 4.0, -0.5, antiwindup=True)
    gains, _ = _read({"p": 1, "i_clamp_max": 0.25}, key="gains", joint="j")
    assert gains == PidGains(1.0, 0.0, 0.0, 0.25, -0.0)


@pytest.mark.parametrize(("ros_version", "bound"), [(1, 0.0), (2, math.inf)])
def test_without_clamp_the_generations_differ_and_it_is_said(
    ros_version: int, bound: float
) -> None:
    gains, found = _read({"p": 1.0, "i": 1.0}, ros_version=ros_version)
    assert gains is not None and gains.i_max == bound
    code = "control.integral-without-clamp"
    (one,) = found.by_code(code)
    assert ("has no effect" in one.message) is (ros_version == 1)
    assert not _read({"p": 1.0, "i": 1.0, "i_clamp": 0.0})[1].by_code(code)


def test_newer_keys_choose_the_strategy_and_bound_the_command() -> None:
    newer = {"antiwindup_strategy": "back_calculation", "tracking_time_constant": 0.5}
    gains, _ = _read({"p": 1.0, "u_clamp_max": 2.0, "u_clamp_min": -3.0, **newer})
    assert gains is not None
    assert gains.strategy is AntiWindup.BACK_CALCULATION
    assert (gains.u_max, gains.u_min, gains.tracking_s) == (2.0, -3.0, 0.5)
    legacy, _ = _read({"p": 1.0, "antiwindup_strategy": "legacy"})
    assert legacy is not None and legacy.antiwindup
    wrong, found = _read({"p": 1.0, "antiwindup_strategy": "magic"})
    assert wrong is not None and wrong.strategy is AntiWindup.NONE
    assert "not one of back_calculation" in found.by_code("parameter.bad-value")[0].message


def test_contradicting_bounds_are_reported_and_left_out() -> None:
    gains, found = _read({"p": 1.0, "u_clamp_max": -2.0, "u_clamp_min": 3.0})
    assert gains == PidGains(1.0)
    code = "control.bad-gains"
    assert "received u_min > u_max" in found.by_code(code)[0].message


def test_texts_are_no_gains() -> None:
    gains, found = _read({"p": "much"})
    assert gains == PidGains(0.0)
    assert "not a number" in found.by_code("parameter.bad-value")[0].message


def test_rows_are_live_where_ros2_s_are() -> None:
    live = {row.key for row in gain_rows("g", (2,)) if row.live}
    assert live == {
        f"g.{name}"
        for name in (
            *("p", "i", "d", "i_clamp_max", "i_clamp_min", "antiwindup", "u_clamp_max"),
            *("u_clamp_min", "tracking_time_constant", "error_deadband"),
        )
    }
    assert not any(row.live for row in gain_rows("pid", (1,)))
