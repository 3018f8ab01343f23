"""One PID in plain floats, as ``control_toolbox::Pid`` computes it."""

from __future__ import annotations

import math

from gazelle.control.pid.gains import AntiWindup, PidGains

__all__ = ["Pid"]


class Pid:
    """A PID on ``error = target - state``.

    LEGACY (control_toolbox of ROS 1 and of ROS 2 up to Iron) integrates the error and multiplies
    by ``i`` afterwards; a period of 0 or an error that is no number commands 0 and changes nothing.
    The newer strategies (control_toolbox 4 and later) integrate ``i * error``; with a period of 0
    they repeat the last command, and an error that is no number commands NaN.
    After `reset` the last error counts as 0, so the first derivative is ``error / period``.
    """

    __slots__ = (
        "_error",
        "_gains",
        "_high",
        "_i",
        "_integral",
        "_integral_high",
        "_integral_low",
        "_is_bounded",
        "_is_legacy",
        "_last_error",
        "_low",
        "_p_d",
        "_rate",
        "command",
    )

    def __init__(self, gains: PidGains) -> None:
        """Begin with no error and no integral."""
        self.gains = gains
        self.reset()

    @property
    def gains(self) -> PidGains:
        """The gains; setting them keeps errors and integral, as live changes do."""
        return self._gains

    @gains.setter
    def gains(self, gains: PidGains) -> None:
        self._gains = gains
        self._p_d = (gains.p, gains.d)
        self._i = gains.i
        self._is_legacy = gains.strategy is AntiWindup.LEGACY
        self._integral_low, self._integral_high = gains.integral_bounds
        self._low, self._high = gains.term_bounds
        self._is_bounded = math.isfinite(gains.u_min) or math.isfinite(gains.u_max)

    @property
    def errors(self) -> tuple[float, float, float]:
        """Error, its integral, its rate; ``getCurrentPIDErrors``.

        The integral is that of the error with LEGACY, what it adds to the command otherwise.
        """
        return self._error, self._integral, self._rate

    @property
    def terms(self) -> tuple[float, float, float]:
        """What error, integral and rate add to the command."""
        p, d = self._p_d
        if not self._is_legacy:
            return p * self._error, self._integral, d * self._rate
        added = min(max(self._i * self._integral, self._low), self._high)
        return p * self._error, added, d * self._rate

    def reset(self, *, keeps_integral: bool = False) -> None:
        """Forget errors and command, and the integral unless `keeps_integral` (save_i_term)."""
        self._last_error = self._error = self._rate = self.command = 0.0
        if not keeps_integral:
            self._integral = 0.0

    def compute(self, error: float, period_s: float) -> float:
        """Return the command; the rate is the error's backward difference."""
        if period_s <= 0.0 or error - error != 0.0:
            return self._invalid(error, period_s)
        rate = (error - self._last_error) / period_s
        self._last_error = error
        return self.compute_with_rate(error, rate, period_s)

    def compute_with_rate(self, error: float, error_rate: float, period_s: float) -> float:
        """Return the command for a known rate of the error."""
        # x - x is 0 for numbers and NaN for infinities and NaN: one test, no calls.
        if period_s <= 0.0 or error - error != 0.0 or error_rate - error_rate != 0.0:
            return self._invalid(error + error_rate, period_s)
        self._error = error
        self._rate = error_rate
        if not self._is_legacy:
            return self._compute_newer(error, error_rate, period_s)
        integral = self._integral + period_s * error
        if integral > self._integral_high:
            integral = self._integral_high
        elif integral < self._integral_low:
            integral = self._integral_low
        self._integral = integral
        added = self._i * integral
        if added > self._high:
            added = self._high
        elif added < self._low:
            added = self._low
        p, d = self._p_d
        command = p * error + added + d * error_rate
        if self._is_bounded:
            command = min(max(command, self._gains.u_min), self._gains.u_max)
        self.command = command
        return command

    def _compute_newer(self, error: float, error_rate: float, period_s: float) -> float:
        gains = self._gains
        wanted = gains.p * error + self._integral + gains.d * error_rate
        command = min(max(wanted, gains.u_min), gains.u_max)
        self.command = command
        if abs(error) > gains.error_deadband:
            self._integrate(error, wanted, period_s)
        self._integral = min(max(self._integral, gains.i_min), gains.i_max)
        return command

    def _integrate(self, error: float, wanted: float, period_s: float) -> None:
        gains = self._gains
        cut = self.command - wanted
        if gains.strategy is AntiWindup.BACK_CALCULATION:
            if gains.i != 0.0:
                self._integral += period_s * (gains.i * error + cut / gains.tracking_s)
        elif gains.strategy is AntiWindup.NONE or cut == 0.0 or error * wanted <= 0.0:
            self._integral += period_s * gains.i * error

    def _invalid(self, error: float, period_s: float) -> float:
        if self._is_legacy:
            return 0.0
        if not math.isfinite(error) and period_s > 0.0:
            self.command = math.nan
        return self.command
