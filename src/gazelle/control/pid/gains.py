"""Gains of a PID and how its integral is kept from winding up."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

__all__ = ["AntiWindup", "PidGains"]


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
