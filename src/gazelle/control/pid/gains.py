"""Gains of a PID, how its integral is kept from winding up, and reading them from parameters."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from enum import Enum

from gazelle.parameters import Parameter, ParameterKind
from gazelle.parameters.reader import ParameterReader

__all__ = ["AntiWindup", "PidGains", "gain_rows", "read_gains"]


class AntiWindup(Enum):
    """``antiwindup_strategy`` of ROS 2's control_toolbox; LEGACY is all that older ones have."""

    LEGACY = "legacy"
    NONE = "none"
    BACK_CALCULATION = "back_calculation"
    CONDITIONAL_INTEGRATION = "conditional_integration"


@dataclass(frozen=True, slots=True)
class PidGains:
    """Gains of one PID, named as control_toolbox names them.

    Attributes:
        p, i, d: gains on error, its integral over seconds and its rate.
        i_max, i_min: bounds of what the integral adds to the command, ``i_clamp_max`` and
            ``i_clamp_min``. With ROS 1's default 0 the integral adds nothing.
        antiwindup: of LEGACY: the integral itself is kept within the bounds; otherwise only what
            it adds to the command is.
        u_max, u_min: bounds of the command.
        strategy: how the integral is kept from growing while the command is bounded.
        tracking_time_constant: of BACK_CALCULATION, s; 0 derives it from the gains.
        error_deadband: strategies other than LEGACY do not integrate errors up to this size.
    """

    p: float = 0.0
    i: float = 0.0
    d: float = 0.0
    i_max: float = 0.0
    i_min: float = 0.0
    antiwindup: bool = False
    u_max: float = math.inf
    u_min: float = -math.inf
    strategy: AntiWindup = AntiWindup.LEGACY
    tracking_time_constant: float = 0.0
    error_deadband: float = 1e-16

    @property
    def problem(self) -> str:
        """Why control_toolbox would skip these gains, empty when it would take them."""
        if self.i_min > self.i_max:
            return f"received i_min > i_max ({self.i_min:g} > {self.i_max:g}), skip new gains"
        if self.u_min > self.u_max:
            return f"received u_min > u_max ({self.u_min:g} > {self.u_max:g}), skip new gains"
        if self.tracking_time_constant < 0.0:
            return "tracking_time_constant is negative, skip new gains"
        return ""

    @property
    def tracking_s(self) -> float:
        """Time constant of BACK_CALCULATION, by control_toolbox' rule where none is given.

        sqrt(d / i) with a derivative, p / i without; infinite where that is not a time.
        """
        if self.tracking_time_constant > 0.0:
            return self.tracking_time_constant
        if self.i == 0.0:
            return math.inf
        ratio = self.d / self.i if self.d != 0.0 else self.p / self.i
        if ratio <= 0.0:
            return math.inf
        return math.sqrt(ratio) if self.d != 0.0 else ratio

    @property
    def integral_bounds(self) -> tuple[float, float]:
        """Bounds of the error's integral: those of LEGACY with antiwindup, else infinite."""
        if not self.antiwindup or self.i == 0.0:
            return -math.inf, math.inf
        first, second = self.i_min / self.i, self.i_max / self.i
        return (first, second) if first <= second else (second, first)

    @property
    def term_bounds(self) -> tuple[float, float]:
        """Bounds of what the integral adds: those of LEGACY without antiwindup, else infinite."""
        return (-math.inf, math.inf) if self.antiwindup else (self.i_min, self.i_max)


def read_gains(
    parameters: ParameterReader, key: str = "pid", joint: str = "", *, ros_version: int = 1
) -> PidGains | None:
    """Return the gains below a key, None when there is no ``p`` at all.

    ``i`` and ``d`` default to 0. ``i_clamp`` gives both bounds of the integral, ``i_clamp_max`` and
    ``i_clamp_min`` one each; signs do not matter. Without any, ROS 1 and ROS 2 up to Iron bound
    the integral to 0, so ``i`` has no effect; newer ROS 2 leaves it unbounded, which generation 2
    does here. Both are said once.

    Args:
        parameters: the controller's.
        key: group of the gains.
        joint: word below the group, as in ``gains.joint_1.p``.
        ros_version: 1 or 2, for the bound of the integral when none is given.
    """
    prefix = ".".join(word for word in (key, joint) if word)
    if not parameters.has(f"{prefix}.p"):
        return None

    def number(name: str, default: float) -> float:
        return parameters.number(f"{prefix}.{name}", default)

    strategy = _strategy(parameters, prefix)
    given = [
        parameters.has(f"{prefix}.{word}") for word in ("i_clamp", "i_clamp_max", "i_clamp_min")
    ]
    clamp = abs(number("i_clamp", math.inf if ros_version == 2 else 0.0))
    gains = PidGains(
        p=number("p", 0.0),
        i=number("i", 0.0),
        d=number("d", 0.0),
        i_max=abs(number("i_clamp_max", clamp)),
        i_min=-abs(number("i_clamp_min", clamp)),
        # The newer 'legacy' bounds the integral in any case.
        antiwindup=strategy is not None or parameters.flag(f"{prefix}.antiwindup"),
        u_max=number("u_clamp_max", math.inf),
        u_min=number("u_clamp_min", -math.inf),
        strategy=strategy or AntiWindup.LEGACY,
        tracking_time_constant=number("tracking_time_constant", 0.0),
        error_deadband=number("error_deadband", 1e-16),
    )
    if gains.i != 0.0 and not any(given):
        _report_no_clamp(parameters, f"{prefix}.i", gains)
    if gains.problem:
        parameters.report("control.bad-gains", gains.problem, key=prefix)
        return PidGains(gains.p, gains.i, gains.d)
    return gains


def gain_rows(prefix: str, ros_versions: tuple[int, ...] = (1, 2)) -> tuple[Parameter, ...]:
    """Return the rows of a controller's table for gains below a key.

    In ROS 2 all but i_clamp and the strategy can be set live; in ROS 1 dynamic_reconfigure does.
    """

    def row(
        name: str, kind: ParameterKind, default: object, meaning: str, live: bool = True
    ) -> Parameter:
        is_live = live and 2 in ros_versions
        key = f"{prefix}.{name}"
        return Parameter(key, kind, default, meaning, live=is_live, ros_versions=ros_versions)

    def newer(
        name: str, kind: ParameterKind, default: object, meaning: str, live: bool = True
    ) -> Parameter:
        return replace(row(name, kind, default, meaning, live), ros_versions=(2,))

    no_clamp = "0 in ROS 1: without it i has no effect; unbounded in ROS 2"
    rows = (
        row("p", "number", 0.0, "gain of the error"),
        row("i", "number", 0.0, "gain of the error's integral"),
        row("d", "number", 0.0, "gain of the error's rate"),
        row("i_clamp", "number", None, f"bound of i's part, both ways; {no_clamp}", live=False),
        row("i_clamp_max", "number", None, "upper bound of the integral's part; i_clamp"),
        row("i_clamp_min", "number", None, "lower bound of the integral's part; -i_clamp"),
        row("antiwindup", "flag", False, "bound the integral itself, not only its part"),
    )
    if 2 not in ros_versions:
        return rows
    strategies = "legacy, none, back_calculation or conditional_integration"
    return (
        *rows,
        newer("u_clamp_max", "number", math.inf, "upper bound of the command"),
        newer("u_clamp_min", "number", -math.inf, "lower bound of the command"),
        newer("antiwindup_strategy", "text", "", strategies, live=False),
        newer("tracking_time_constant", "number", 0.0, "of back_calculation, s; 0: derived"),
        newer("error_deadband", "number", 1e-16, "errors this small are not integrated"),
    )


def _strategy(parameters: ParameterReader, prefix: str) -> AntiWindup | None:
    key = f"{prefix}.antiwindup_strategy"
    name = parameters.text(key, "")
    if not name:
        return None
    try:
        return AntiWindup(name)
    except ValueError:
        strategies = ", ".join(sorted(strategy.value for strategy in AntiWindup))
        text = f"parameter '{parameters.full_name(key)}' is '{name}', not one of {strategies}; "
        parameters.report("parameter.bad-value", text + "'none' is used", key=key)
        return AntiWindup.NONE


def _report_no_clamp(parameters: ParameterReader, key: str, gains: PidGains) -> None:
    text = f"'{parameters.full_name(key)}' is {gains.i:g} and there is no i_clamp: "
    if gains.i_max == 0.0:
        text += "its default 0 bounds the integral to nothing, so i has no effect (as in ROS 1)"
    else:
        text += "the integral is unbounded (as in ROS 2 Jazzy; up to Iron i had no effect)"
    parameters.report("control.integral-without-clamp", text, key=key)
