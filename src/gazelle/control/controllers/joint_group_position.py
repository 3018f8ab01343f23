"""ROS 1's effort_controllers/JointGroupPositionController: a PID for each of several joints."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.controllers.joint_error import JointRange
from gazelle.control.controllers.pid_joint import required_gains
from gazelle.control.errors import ControllerError
from gazelle.control.interface_values import Array
from gazelle.control.pid import PidBank, offer_live_gains
from gazelle.control.pid.reading import gain_rows
from gazelle.control.table import ControllerTable
from gazelle.description.model import JointType
from gazelle.parameters import Parameter, ParameterTable, Topic

__all__ = ["JointGroupPositionController"]


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
        self._places = context.command_places(self.commands)
        self._state_places = context.state_places(self.states)
        self.pids = PidBank([required_gains(parameters, f"{joint}.pid") for joint in joints])
        for place, joint in enumerate(joints):
            offer_live_gains(context, f"{joint}/pid", (self.pids, place))
        self._command: Array = np.zeros(len(joints))
        context.ports.subscription("~/command", "std_msgs/Float64MultiArray", self._take)

    def start(self, time_ns: int) -> None:
        """Hold the joints where they are."""
        self._command = self.robot.bank.states[self._state_places]
        self._command = np.clip(self._command, self._lower, self._upper)
        self.pids.reset()

    def update(self, time_ns: int, period_ns: int) -> None:
        """Command what the PIDs want."""
        bank = self.robot.bank
        positions = bank.states[self._state_places]
        errors = self._command - positions
        # Angles nearer than half a turn are their own shortest way.
        for k in self._turning:
            if abs(errors.item(k)) >= np.pi:
                errors[k] = self._ranges[k].error(positions.item(k), self._command.item(k))
        bank.commands[self._places] = self.pids.compute(errors, period_ns * 1e-9)
        bank.answer(self._places, *self.pids.stiffness_and_damping)

    def _take(self, message: Any) -> None:
        values = np.array(message.data, dtype=np.float64)
        if len(values) == len(self.commands):
            self._command = np.clip(values, self._lower, self._upper)
            return
        text = f"Dimension of command ({len(values)}) does not match number of joints "
        text += f"({len(self.commands)})! Not executing!"
        self.context.ports.log("error", f"{self.context.name}: {text}")
