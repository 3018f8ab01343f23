"""Many PIDs at once, in numpy."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from gazelle.control.bank import Array
from gazelle.control.pid.gains import AntiWindup, PidGains
from gazelle.control.pid.pid import Pid

__all__ = ["PidBank"]


class PidBank:
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
        for place, pid in self._single.items():
            integral[place] = pid.errors[1]
        return self._errors, integral, self._rates

    @property
    def terms(self) -> tuple[Array, Array, Array]:
        """What errors, integrals and rates add to the commands, (N,) each."""
        added = np.clip(self._i * self._integral, self._low, self._high)
        for place, pid in self._single.items():
            added[place] = pid.terms[1]
        return self._p * self._errors, added, self._d * self._rates

    def set_gains(self, place: int, gains: PidGains) -> None:
        """Change the gains of one; errors and integral are kept."""
        self.gains = (*self.gains[:place], gains, *self.gains[place + 1 :])
        self._arrange()

    def reset(self, places: Iterable[int] | None = None, *, keeps_integral: bool = False) -> None:
        """Forget errors and commands of all or some, integrals unless `keeps_integral`."""
        chosen = list(range(len(self)) if places is None else places)
        for values in (self._last, self._errors, self._rates, self._command):
            values[chosen] = 0.0
        if not keeps_integral:
            self._integral[chosen] = 0.0
        for place in chosen:
            if place in self._single:
                self._single[place].reset(keeps_integral=keeps_integral)

    def compute(self, errors: Array, period_s: float, rates: Array | None = None) -> Array:
        """Return the commands (N,); an own array that the next call leaves alone.

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
        # One sum finds NaN and infinities without a temporary per joint.
        if not np.isfinite(errors.sum() + rates.sum()):
            return self._compute_partly(errors, period_s, rates, given)
        if given is None:
            self._last = errors.copy()
        self._errors, self._rates = errors.copy(), rates
        integral = self._integral + period_s * errors
        if self._has_integral_bounds:
            integral = np.minimum(np.maximum(integral, self._integral_low), self._integral_high)
        self._integral = integral
        added = np.minimum(np.maximum(self._i * integral, self._low), self._high)
        command = self._p * errors + added + self._d * rates
        if self._is_bounded:
            command = np.minimum(np.maximum(command, self._u_min), self._u_max)
        self._command = command
        return self._with_singles(command.copy(), errors, period_s, given)

    def _compute_partly(
        self, errors: Array, period_s: float, rates: Array, given: Array | None
    ) -> Array:
        """Compute where error and rate are numbers; the others command 0 and keep their state."""
        good = np.isfinite(errors) & np.isfinite(rates)
        kept = [values.copy() for values in self._state]
        single, self._single = self._single, {}
        safe = None if given is None else np.where(good, given, 0.0)
        result = self.compute(np.where(good, errors, 0.0), period_s, safe)
        for values, old in zip(self._state, kept, strict=True):
            values[~good] = old[~good]
        self._single = single
        return self._with_singles(np.where(good, result, 0.0), errors, period_s, given)

    @property
    def _state(self) -> tuple[Array, ...]:
        return self._last, self._errors, self._rates, self._integral, self._command

    def _with_singles(
        self, command: Array, errors: Array, period_s: float, rates: Array | None
    ) -> Array:
        for place, pid in self._single.items():
            error = float(errors[place])
            if rates is None:
                command[place] = pid.compute(error, period_s)
            else:
                command[place] = pid.compute_with_rate(error, float(rates[place]), period_s)
            self._command[place] = command[place]
        return command

    def _arrange(self) -> None:
        rows = self.gains
        self._p, self._i, self._d = (
            np.array(column)
            for column in ([r.p for r in rows], [r.i for r in rows], [r.d for r in rows])
        )
        bounds = np.array([row.integral_bounds for row in rows]).reshape(-1, 2)
        self._integral_low, self._integral_high = bounds.T.copy()
        self._has_integral_bounds = bool(np.isfinite(bounds).any())
        self._low, self._high = np.array([row.term_bounds for row in rows]).reshape(-1, 2).T.copy()
        self._u_min = np.array([row.u_min for row in rows])
        self._u_max = np.array([row.u_max for row in rows])
        self._is_bounded = bool(np.isfinite(self._u_min).any() or np.isfinite(self._u_max).any())
        for place, row in enumerate(rows):
            if row.strategy is AntiWindup.LEGACY:
                self._single.pop(place, None)
            elif place in self._single:
                self._single[place].gains = row
            else:
                self._single[place] = Pid(row)
