"""ROS 1's controllers with a PID a joint, of effort_controllers and velocity_controllers.

``JointPositionController``, ``JointVelocityController`` and ``JointGroupPositionController``.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.controllers.joint_error import JointRange
from gazelle.control.errors import ControllerError
from gazelle.control.interface_values import Array
from gazelle.control.pid import Pid, PidArray, PidGains, PidStatePort, offer_live_gains, read_gains
from gazelle.control.pid.gains import gain_rows
from gazelle.description.model import JointType
from gazelle.interfaces.stamps import stamped
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.parameters.reader import ParameterReader

__all__ = [
    "PID_PARAMETERS",
    "PID_TOPICS",
    "JointGroupPositionController",
    "JointPositionController",
    "JointVelocityController",
    "PidJointController",
    "required_gains",
]


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
        self._index = int(context.command_indices(self.commands)[0])
        self._position_index, self._velocity_index = context.state_indices(self.states).tolist()
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
        message.command = self.robot.interface_values.commands.item(self._index)
        gains = self.pid.gains
        message.p, message.i, message.d = gains.p, gains.i, gains.d
        message.i_clamp, message.antiwindup = gains.i_max, gains.antiwindup
        self._fill(message)
        self._publisher.publish(message)

    def _fill(self, message: Any) -> None:
        """Add what only some of them tell."""

    def _take(self, message: Any) -> None:
        self.command = float(message.data)


class JointVelocityController(PidJointController):
    """Turns one joint at a velocity by effort.

    Attributes:
        command: the velocity wanted, rad/s or m/s.
    """

    TABLE = ControllerTable(
        ParameterTable(
            "joint_velocity",
            "Moves one joint at a velocity: a PID of the velocity's error commands its effort.",
            ("effort_controllers/JointVelocityController",),
            PID_PARAMETERS,
        ),
        interfaces="claims effort of the joint; reads position and velocity",
        topics=PID_TOPICS,
        behaviour=(
            "It begins with velocity 0 (joint_velocity_controller.cpp).",
            "Once stopped it leaves its last effort with the hardware.",
        ),
    )

    def __init__(self, context: ControllerContext) -> None:
        """Look up joint and gains."""
        super().__init__(context)
        self._begin(context, "effort")

    def start(self, time_ns: int) -> None:
        """Begin with velocity 0."""
        self.command = 0.0
        self.pid.reset()

    def update(self, time_ns: int, period_ns: int) -> None:
        """Command what the PID wants."""
        interface_values = self.robot.interface_values
        velocity = interface_values.states.item(self._velocity_index)
        error = self.command - velocity
        interface_values.commands[self._index] = self.pid.compute(error, period_ns * 1e-9)
        interface_values.answer(self._index, 0.0, self.pid.gains.p)
        self._tell(time_ns, period_ns, process_value=velocity, error=error, command=self.command)


class JointGroupPositionController(Controller):
    """Holds several joints at positions by effort."""

    TABLE = ControllerTable(
        ParameterTable(
            "joint_group_position",
            "Holds several joints at positions: a PID for each commands its effort.",
            ("effort_controllers/JointGroupPositionController",),
            (
                Parameter(
                    "joints", "texts", None, "the joints, in the order of the array; required"
                ),
                *gain_rows("<joint>.pid", (1,)),
                Parameter(
                    "<joint>.pid.publish_state",
                    "refused",
                    None,
                    "the PIDs of a group publish no states",
                ),
            ),
        ),
        interfaces="claims effort of the joints; reads their positions",
        topics=(
            Topic("~/command", "std_msgs/Float64MultiArray", "listens"),
            Topic(
                "~/<joint>/pid/set_parameters",
                "dynamic_reconfigure/Reconfigure",
                "service",
                "p, i, d, i_clamp_min, i_clamp_max, antiwindup",
            ),
        ),
        behaviour=(
            "It begins where the joints are, and holds them there "
            "(joint_group_position_controller.cpp).",
            "Limits and the way round are those of JointPositionController.",
            "An array of the wrong length is not taken.",
        ),
    )

    def __init__(self, context: ControllerContext) -> None:
        """Look up joints and gains."""
        super().__init__(context)
        parameters = context.parameters
        parameters.require("joints")
        joints = parameters.texts("joints")
        if not joints:
            raise ControllerError(f"{context.name}: List of joint names is empty.")
        self._ranges = [JointRange.of(context, joint) for joint in joints]
        self._lower = np.array([row.lower for row in self._ranges])
        self._upper = np.array([row.upper for row in self._ranges])
        turning = (JointType.REVOLUTE, JointType.CONTINUOUS)
        self._turning = [k for k, row in enumerate(self._ranges) if row.type in turning]
        self.commands = tuple(f"{joint}/effort" for joint in joints)
        self.states = tuple(f"{joint}/position" for joint in joints)
        self._indices = context.command_indices(self.commands)
        self._state_indices = context.state_indices(self.states)
        self.pids = PidArray([required_gains(parameters, f"{joint}.pid") for joint in joints])
        for index, joint in enumerate(joints):
            offer_live_gains(context, f"{joint}/pid", (self.pids, index))
        self._command: Array = np.zeros(len(joints))
        context.ports.subscription("~/command", "std_msgs/Float64MultiArray", self._take)

    def start(self, time_ns: int) -> None:
        """Hold the joints where they are."""
        self._command = self.robot.interface_values.states[self._state_indices]
        self._command = np.clip(self._command, self._lower, self._upper)
        self.pids.reset()

    def update(self, time_ns: int, period_ns: int) -> None:
        """Command what the PIDs want."""
        interface_values = self.robot.interface_values
        positions = interface_values.states[self._state_indices]
        errors = self._command - positions
        # Angles nearer than half a turn are their own shortest way.
        for k in self._turning:
            if abs(errors.item(k)) >= np.pi:
                errors[k] = self._ranges[k].error(positions.item(k), self._command.item(k))
        interface_values.commands[self._indices] = self.pids.compute(errors, period_ns * 1e-9)
        interface_values.answer(self._indices, *self.pids.stiffness_and_damping)

    def _take(self, message: Any) -> None:
        values = np.array(message.data, dtype=np.float64)
        if len(values) == len(self.commands):
            self._command = np.clip(values, self._lower, self._upper)
            return
        text = f"Dimension of command ({len(values)}) does not match number of joints "
        text += f"({len(self.commands)})! Not executing!"
        self.context.ports.log("error", f"{self.context.name}: {text}")


class JointPositionController(PidJointController):
    """Holds one joint at a position by effort or velocity.

    Attributes:
        command: the position wanted, rad or m, as it came.
    """

    TABLE = ControllerTable(
        ParameterTable(
            "joint_position",
            "Holds one joint at a position: a PID of the position's error commands its effort or "
            "velocity.",
            (
                "effort_controllers/JointPositionController",
                "velocity_controllers/JointPositionController",
            ),
            PID_PARAMETERS,
        ),
        interfaces="claims effort or velocity of the joint, as its type says; reads"
        " position and velocity",
        topics=PID_TOPICS,
        behaviour=(
            "It begins where the joint is, and holds it there (joint_position_controller.cpp).",
            "Commands are kept within the limits of revolute and prismatic joints.",
            "Revolute joints take the shorter way round if it ends within their limits, continuous "
            "ones always (angles::shortest_angular_distance…).",
            "Once stopped it leaves its last command with the hardware.",
        ),
    )

    def __init__(self, context: ControllerContext) -> None:
        """Look up joint and gains."""
        super().__init__(context)
        joint = self._begin(context, context.type.partition("_")[0])
        self._range = JointRange.of(context, joint)

    def start(self, time_ns: int) -> None:
        """Hold the joint where it is."""
        self.command = self._range.clip(
            self.robot.interface_values.states.item(self._position_index)
        )
        self.pid.reset()

    def update(self, time_ns: int, period_ns: int) -> None:
        """Command what the PID wants."""
        interface_values = self.robot.interface_values
        position = interface_values.states.item(self._position_index)
        command = self._range.clip(self.command)
        error = self._range.error(position, command)
        interface_values.commands[self._index] = self.pid.compute(error, period_ns * 1e-9)
        gains = self.pid.gains
        interface_values.answer(self._index, gains.p, gains.d)
        self._tell(time_ns, period_ns, process_value=position, error=error, command=command)

    def _fill(self, message: Any) -> None:
        message.process_value_dot = self.robot.interface_values.states.item(self._velocity_index)
