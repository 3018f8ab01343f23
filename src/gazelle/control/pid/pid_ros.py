"""What the graph sees of a PID, as control_toolbox's ``PidROS``.

Its gains by dynamic_reconfigure or as ROS 2 parameters, its state as ``control_msgs/PidState``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from gazelle.control.controller_node_interface import LiveParameter, LivePort, Ports
from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.pid.gains import PidGains
from gazelle.control.pid.pid import Pid
from gazelle.control.pid.pid_array import PidArray
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import stamped

__all__ = ["PidStatePort", "offer_live_gains"]


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


_FIELDS = {"i_clamp_max": "i_max", "i_clamp_min": "i_min", "u_clamp_max": "u_max"}

_FIELDS |= {"u_clamp_min": "u_min"}


def offer_live_gains(
    context: ControllerContext, group: str, pid: Pid | tuple[PidArray, int]
) -> LivePort:
    """Offer p, i, d, i_clamp_max, i_clamp_min and antiwindup, in ROS 2 the newer ones too.

    Limits and descriptions are those of ``control_toolbox/Parameters.cfg``. Gains that
    control_toolbox would skip are refused and said on the console.

    Args:
        context: whose parameters they are.
        group: ``pid`` or ``joint_1/pid`` in ROS 1, ``gains.joint_1`` in ROS 2.
        pid: what is changed: a PID, or one of an array.
    """
    get, put = _access(pid)
    ros_version = context.ros_version
    rows = _ros1_rows(get()) if ros_version == 1 else _ros2_rows(get())
    port: LivePort | None = None

    def changed(values: dict[str, Any]) -> None:
        known = {_FIELDS.get(name, name): value for name, value in values.items()}
        gains = replace(get(), **known)
        if not gains.problem:
            put(gains)
            return
        context.ports.log("error", f"{context.name}/{group}: {gains.problem}")
        if port is not None:
            port.update(_values(get(), ros_version))

    port = context.ports.live_parameters(group, rows, changed)
    return port


def _access(
    pid: Pid | tuple[PidArray, int],
) -> tuple[Callable[[], PidGains], Callable[[PidGains], None]]:
    if isinstance(pid, Pid):
        single = pid

        def put(gains: PidGains) -> None:
            single.gains = gains

        return (lambda: single.gains), put
    pids, index = pid
    return (lambda: pids.gains[index]), (lambda gains: pids.set_gains(index, gains))


def _values(gains: PidGains, ros_version: int) -> dict[str, Any]:
    rows = _ros1_rows(gains) if ros_version == 1 else _ros2_rows(gains)
    return {row.name: row.value for row in rows}


def _ros1_rows(gains: PidGains) -> tuple[LiveParameter, ...]:
    wide = 100000.0
    low, high = "Min bounds for the integral windup", "Max bounds for the integral windup"
    return (
        LiveParameter("p", "double", gains.p, "Proportional gain.", -wide, wide),
        LiveParameter("i", "double", gains.i, "Integral gain.", -wide, wide),
        LiveParameter("d", "double", gains.d, "Derivative gain.", -1000.0, 1000.0),
        LiveParameter("i_clamp_min", "double", gains.i_min, low, -wide, 0.0),
        LiveParameter("i_clamp_max", "double", gains.i_max, high, 0.0, wide),
        LiveParameter("antiwindup", "bool", gains.antiwindup, "Antiwindup."),
    )


def _ros2_rows(gains: PidGains) -> tuple[LiveParameter, ...]:
    return (
        LiveParameter("p", "double", gains.p, "Proportional gain for PID"),
        LiveParameter("i", "double", gains.i, "Integral gain for PID"),
        LiveParameter("d", "double", gains.d, "Derivative gain for PID"),
        LiveParameter("i_clamp_max", "double", gains.i_max, "Upper integral clamp."),
        LiveParameter("i_clamp_min", "double", gains.i_min, "Lower integral clamp."),
        LiveParameter("antiwindup", "bool", gains.antiwindup, "Bounds the integral itself."),
        LiveParameter("u_clamp_max", "double", gains.u_max, "Upper output clamp."),
        LiveParameter("u_clamp_min", "double", gains.u_min, "Lower output clamp."),
        LiveParameter(
            "tracking_time_constant", "double", gains.tracking_time_constant, "Of back_calculation."
        ),
        LiveParameter(
            "error_deadband", "double", gains.error_deadband, "Errors that are not integrated."
        ),
    )
