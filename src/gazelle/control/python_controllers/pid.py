"""A PID for controllers of your own, with the names of control_toolbox and of PR2's time."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gazelle.control.pid import Pid as ControlPid
from gazelle.control.pid import PidGains

if TYPE_CHECKING:
    from gazelle.control.python_controllers.controller_api import UserNode

__all__ = ["Pid"]


class Pid:
    """A PID controller; see `gazelle.control.pid.Pid` for its law.

    Example:
        >>> pid = Pid(p=150.0, i=2.0, d=30.0, i_clamp=1.0)
        >>> effort = pid.compute(target - joint.position, period)
    """

    def __init__(
        self,
        p: float = 0.0,
        i: float = 0.0,
        d: float = 0.0,
        i_clamp: float = 0.0,
        *,
        i_min: float | None = None,
        antiwindup: bool = False,
    ) -> None:
        """Begin with no error and no integral.

        Args:
            p: gain on the error.
            i: gain on its integral, s.
            d: gain on its rate.
            i_clamp: most that the integral adds to the command; with 0 it adds nothing.
            i_min: least that it adds; ``-i_clamp`` when None.
            antiwindup: bound the integral itself and not only what it adds.
        """
        low = -abs(i_clamp) if i_min is None else i_min
        self._pid = ControlPid(PidGains(p, i, d, abs(i_clamp), low, antiwindup))

    @property
    def gains(self) -> PidGains:
        """The gains; setting them keeps the integral."""
        return self._pid.gains

    @gains.setter
    def gains(self, gains: PidGains) -> None:
        self._pid.gains = gains

    def set_gains(self, **values: Any) -> None:
        """Change some gains, such as ``p=2.0``."""
        self._pid.gains = replace(self._pid.gains, **values)

    def init(self, node: UserNode, group: str = "") -> bool:
        """Read p, i, d, i_clamp … of a group of the controller's parameters; live from now on.

        Others can change them with dynamic_reconfigure, or as parameters in ROS 2.

        Returns:
            False when there is no ``p``, which is logged with control_toolbox' words.
        """
        gains = node.read_gains(group)
        if gains is None:
            place = "/".join(filter(None, (node.get_namespace(), group)))
            node.log_error(f"No p gain specified for pid.  Namespace: {place}")
            return False
        self._pid.gains = gains
        node.offer_live_gains(group, self._pid)
        return True

    def compute(self, error: float, period: Any) -> float:
        """Return the command for ``error = target - state`` after a period (s, or a duration)."""
        return self._pid.compute(error, _seconds(period))

    def compute_with_rate(self, error: float, error_rate: float, period: Any) -> float:
        """Return the command for a known rate of the error."""
        return self._pid.compute_with_rate(error, error_rate, _seconds(period))

    def update_pid(self, error: float, period: Any) -> float:
        """Return the command for ``error = state - target``, as PR2's ``updatePid`` does."""
        return self._pid.compute(-error, _seconds(period))

    def reset(self) -> None:
        """Forget errors and integral."""
        self._pid.reset()

    @property
    def command(self) -> float:
        """The last command."""
        return self._pid.command

    computeCommand = compute  # noqa: N815 - control_toolbox' name
    updatePid = update_pid  # noqa: N815 - control_toolbox' name of 2011


def _seconds(period: Any) -> float:
    to_sec = getattr(period, "to_sec", None)
    return float(period) if to_sec is None else float(to_sec())
