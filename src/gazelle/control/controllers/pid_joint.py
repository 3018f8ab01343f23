"""What ROS 1's controllers of one joint with one PID share."""

from __future__ import annotations

from typing import Any

from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.errors import ControllerError
from gazelle.control.pid import Pid, PidGains, PidStatePort, offer_live_gains, read_gains
from gazelle.control.pid.reading import gain_rows
from gazelle.interfaces.stamps import stamped
from gazelle.parameters import Parameter, Topic
from gazelle.parameters.reader import ParameterReader

__all__ = ["PID_PARAMETERS", "PID_TOPICS", "PidJointController", "required_gains"]

_STATE_EVERY = 10

PID_PARAMETERS = (
    Parameter("joint", "text", None, "the joint; required"),
    *gain_rows("pid", (1,)),
    Parameter("pid.publish_state", "flag", False, "offer `~/pid/state`"),
)
PID_TOPICS = (
    Topic("~/command", "std_msgs/Float64", "listens"),
    Topic("~/state", "control_msgs/JointControllerState", rate="every 10th update"),
    Topic("~/pid/state", "control_msgs/PidState", rate="every update, with pid/publish_state"),
    Topic(
        "~/pid/set_parameters",
        "dynamic_reconfigure/Reconfigure",
        "service",
        "p, i, d, i_clamp_min, i_clamp_max, antiwindup",
    ),
)


def required_gains(parameters: ParameterReader, key: str) -> PidGains:
    """Return the gains below a key, which must be there.

    Raises:
        ControllerError: there is no ``p``.
    """
    gains = read_gains(parameters, key)
    if gains is not None:
        return gains
    namespace = parameters.full_name(key)
    raise ControllerError(f"No p gain specified for pid.  Namespace: {namespace}")


class PidJointController(Controller):
    """One joint, one PID, ``~/command`` and ``~/state``."""

    def _begin(self, context: ControllerContext, interface: str) -> str:
        """Read joint and gains, offer topics and live gains; return the joint."""
        parameters = context.parameters
        parameters.require("joint")
        joint = parameters.text("joint")
        context.joint(joint)
        self.commands = (f"{joint}/{interface}",)
        self.states = (f"{joint}/position", f"{joint}/velocity")
        self._place = int(context.command_places(self.commands)[0])
        self._position_place, self._velocity_place = context.state_places(self.states).tolist()
        self.pid = Pid(required_gains(parameters, "pid"))
        self._count = 0
        self._publisher = context.ports.publisher("~/state", "control_msgs/JointControllerState")
        self._pid_state = None
        if parameters.flag("pid.publish_state"):
            self._pid_state = PidStatePort(context.ports, "~/pid/state")
        offer_live_gains(context, "pid", self.pid)
        context.ports.subscription("~/command", "std_msgs/Float64", self._take)
        self.command = 0.0
        return joint

    def _tell(
        self, time_ns: int, period_ns: int, *, process_value: float, error: float, command: float
    ) -> None:
        """Publish the state of PID and controller as often as the original."""
        if self._pid_state is not None:
            self._pid_state.publish(self.pid, time_ns, period_ns)
        self._count += 1
        if (self._count - 1) % _STATE_EVERY or not self._publisher.matched:
            return
        message = stamped("control_msgs/JointControllerState", time_ns)
        message.set_point, message.process_value = command, process_value
        message.error, message.time_step = error, period_ns * 1e-9
        message.command = self.robot.bank.commands.item(self._place)
        gains = self.pid.gains
        message.p, message.i, message.d = gains.p, gains.i, gains.d
        message.i_clamp, message.antiwindup = gains.i_max, gains.antiwindup
        self._fill(message)
        self._publisher.publish(message)

    def _fill(self, message: Any) -> None:
        """Add what only some of them tell."""

    def _take(self, message: Any) -> None:
        self.command = float(message.data)
