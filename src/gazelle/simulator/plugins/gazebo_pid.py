"""The PID of Gazebo's own plug-ins (``gz::math::PID``), which is not control_toolbox's."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["GazeboPid"]


@dataclass(slots=True)
class GazeboPid:
    """Gains, bounds and memory of one loop.

    The error is actual minus target, and the command its negative feedback. A pair of bounds
    whose lower one is above the upper one bounds nothing.

    Attributes:
        p, i, d: gains.
        i_max, i_min: bounds of the integral's term.
        cmd_max, cmd_min: bounds of the command.
        offset: added to the command.
    """

    p: float
    i: float
    d: float
    i_max: float = -1.0
    i_min: float = 0.0
    cmd_max: float = -1.0
    cmd_min: float = 0.0
    offset: float = 0.0
    _integral: float = 0.0
    _last_error: float = 0.0

    def update(self, error: float, period_s: float) -> float:
        """Return the command for an error (actual minus target)."""
        if period_s <= 0:
            return 0.0
        self._integral += self.i * period_s * error
        if self.i_max >= self.i_min:
            self._integral = min(max(self._integral, self.i_min), self.i_max)
        slope = (error - self._last_error) / period_s
        self._last_error = error
        command = self.offset - self.p * error - self._integral - self.d * slope
        if self.cmd_max >= self.cmd_min:
            command = min(max(command, self.cmd_min), self.cmd_max)
        return command

    def reset(self) -> None:
        """Forget the past."""
        self._integral = self._last_error = 0.0
