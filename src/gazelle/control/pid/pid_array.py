"""Many PIDs at once, in numpy."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

from gazelle.control.interface_values import Array
from gazelle.control.pid.gains import AntiWindup, PidGains
from gazelle.control.pid.pid import Pid

__all__ = ["PidArray"]


class PidArray:
    """PIDs side by side; each computes exactly what `Pid` computes with its gains.

    PIDs with one of the newer strategies are computed one by one.

    Attributes:
        gains: of each.
    """

    def __init__(self, gains: Sequence[PidGains]) -> None:
        """Begin with no errors and no integrals."""
        self.gains: tuple[PidGains, ...] = tuple(gains)
        count = len(self.gains)
        self._integral, self._last, self._errors = (np.zeros(count) for _ in range(3))
        self._rates, self._command = np.zeros(count), np.zeros(count)
        self._single: dict[int, Pid] = {}
        self._arrange()

    def __len__(self) -> int:
        return len(self.gains)

    @property
    def command(self) -> Array:
        """The last commands (N,)."""
        return self._command

    @property
    def errors(self) -> tuple[Array, Array, Array]:
        """Errors, their integrals and their rates, (N,) each; see `Pid.errors`."""
        integral = self._integral.copy()
        for index, pid in self._single.items():
            integral[index] = pid.errors[1]
        return self._errors, integral, self._rates

    @property
    def terms(self) -> tuple[Array, Array, Array]:
        """What errors, integrals and rates add to the commands, (N,) each."""
        added = np.clip(self._i * self._integral, self._low, self._high)
        for index, pid in self._single.items():
            added[index] = pid.terms[1]
        return self._p * self._errors, added, self._d * self._rates

    @property
    def stiffness_and_damping(self) -> tuple[Array, Array]:
        """The gains p and d, (N,) each."""
        return self._p, self._d

    def set_gains(self, index: int, gains: PidGains) -> None:
        """Change the gains of one; errors and integral are kept."""
        self.gains = (*self.gains[:index], gains, *self.gains[index + 1 :])
        self._arrange()

    def reset(self, indices: Iterable[int] | None = None, *, keeps_integral: bool = False) -> None:
        """Forget errors and commands of all or some, integrals unless `keeps_integral`."""
        chosen = list(range(len(self)) if indices is None else indices)
        # Others may hold these arrays: they are replaced, not written.
        kept = (self._last, self._errors, self._rates, self._command)
        self._last, self._errors, self._rates, self._command = (array.copy() for array in kept)
        for values in (self._last, self._errors, self._rates, self._command):
            values[chosen] = 0.0
        if not keeps_integral:
            self._integral[chosen] = 0.0
        for index in chosen:
            if index in self._single:
                self._single[index].reset(keeps_integral=keeps_integral)

    def compute(self, errors: Array, period_s: float, rates: Array | None = None) -> Array:
        """Return the commands (N,); the next call makes another array.

        Args:
            errors: target - state (N,).
            period_s: since the last call.
            rates: of the errors (N,); backward differences when None.
        """
        if period_s <= 0.0:
            return self._with_singles(np.zeros(len(self)), errors, period_s, rates)
        given = rates
        if rates is None:
            rates = (errors - self._last) / period_s
        integral, wanted = self._law(errors, period_s, rates)
        # NaN and infinities of any error or rate end in what is wanted: one product finds them.
        if not math.isfinite(wanted.dot(self._ones)):
            return self._compute_partly(errors, period_s, rates, given)
        own = errors.copy()
        if given is None:
            self._last = own
        self._errors, self._rates, self._integral = own, rates, integral
        self._command = wanted
        if not self._is_bounded and not self._single:
            return wanted
        command = np.minimum(np.maximum(wanted, self._u_min), self._u_max)
        self._command = command
        return self._with_singles(command.copy(), errors, period_s, given)

    def _law(self, errors: Array, period_s: float, rates: Array) -> tuple[Array, Array]:
        """Return integrals and commands, the latter without bounds."""
        integral = errors * period_s
        integral += self._integral
        if self._has_integral_bounds:
            np.minimum(integral, self._integral_high, out=integral)
            np.maximum(integral, self._integral_low, out=integral)
        command = self._p * errors
        if self._has_i:
            added = self._i * integral
            np.minimum(added, self._high, out=added)
            np.maximum(added, self._low, out=added)
            command += added
        # Also without d: a rate that is no number must not go unseen.
        command += self._d * rates
        return integral, command

    def _compute_partly(
        self, errors: Array, period_s: float, rates: Array, given: Array | None
    ) -> Array:
        """Compute where error and rate are numbers; the others command 0 and keep their state."""
        good = np.isfinite(errors) & np.isfinite(rates)
        safe, slopes = np.where(good, errors, 0.0), np.where(good, rates, 0.0)
        integral, wanted = self._law(safe, period_s, slopes)
        command = np.minimum(np.maximum(wanted, self._u_min), self._u_max)
        if given is None:
            self._last = np.where(good, errors, self._last)
        self._errors = np.where(good, errors, self._errors)
        self._rates = np.where(good, rates, self._rates)
        self._integral = np.where(good, integral, self._integral)
        self._command = np.where(good, command, self._command)
        return self._with_singles(np.where(good, command, 0.0), errors, period_s, given)

    def _with_singles(
        self, command: Array, errors: Array, period_s: float, rates: Array | None
    ) -> Array:
        for index, pid in self._single.items():
            error = float(errors[index])
            if rates is None:
                command[index] = pid.compute(error, period_s)
            else:
                command[index] = pid.compute_with_rate(error, float(rates[index]), period_s)
            self._command[index] = command[index]
        return command

    def _arrange(self) -> None:
        rows = self.gains
        self._p, self._i, self._d = (
            np.array(column)
            for column in ([r.p for r in rows], [r.i for r in rows], [r.d for r in rows])
        )
        self._ones = np.ones(len(rows))
        # The newer strategies integrate by themselves, see `_with_singles`.
        legacy = [row for row in rows if row.strategy is AntiWindup.LEGACY]
        self._has_i = any(row.i != 0.0 and row.term_bounds != (0.0, 0.0) for row in legacy)
        bounds = np.array([row.integral_bounds for row in rows]).reshape(-1, 2)
        self._integral_low, self._integral_high = bounds.T.copy()
        self._has_integral_bounds = bool(np.isfinite(bounds).any())
        self._low, self._high = np.array([row.term_bounds for row in rows]).reshape(-1, 2).T.copy()
        self._u_min = np.array([row.u_min for row in rows])
        self._u_max = np.array([row.u_max for row in rows])
        self._is_bounded = bool(np.isfinite(self._u_min).any() or np.isfinite(self._u_max).any())
        for index, row in enumerate(rows):
            if row.strategy is AntiWindup.LEGACY:
                self._single.pop(index, None)
            elif index in self._single:
                self._single[index].gains = row
            else:
                self._single[index] = Pid(row)
