"""Publishes ``control_msgs/PidState`` of a PID."""

from __future__ import annotations

from typing import Any

from gazelle.control.controller_node import Ports
from gazelle.control.pid.pid import Pid
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import stamped

__all__ = ["PidStatePort"]


class PidStatePort:
    """Tells what a PID computes, to those who subscribe (parameter ``publish_state``)."""

    def __init__(self, ports: Ports, topic: str) -> None:
        """Offer the topic, such as ``~/pid/state``."""
        self._publisher = ports.publisher(topic, "control_msgs/PidState")

    def publish(self, pid: Pid, time_ns: int, period_ns: int) -> None:
        """Send what the PID computed last."""
        if not self._publisher.matched:
            return
        seconds, rest = divmod(period_ns, 1_000_000_000)
        gains, (error, integral, rate) = pid.gains, pid.errors
        p_term, i_term, d_term = pid.terms
        duration: Any = message_type("builtin_interfaces/Duration")
        message = stamped("control_msgs/PidState", time_ns)
        message.timestep = duration(sec=seconds, nanosec=rest)
        message.error = message.p_error = error
        message.error_dot = message.d_error = rate
        message.i_error = integral
        message.p_term, message.i_term, message.d_term = p_term, i_term, d_term
        message.i_max, message.i_min = gains.i_max, gains.i_min
        message.output = pid.command
        self._publisher.publish(message)
