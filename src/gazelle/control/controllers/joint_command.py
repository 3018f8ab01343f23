"""ROS 1's controllers that pass one number on to one joint."""

from __future__ import annotations

from typing import Any

from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.table import ControllerTable
from gazelle.parameters import Parameter, ParameterTable, Topic

__all__ = ["JointCommandController"]

_INTERFACES = {
    "effort_controllers/JointEffortController": "effort",
    "velocity_controllers/JointVelocityController": "velocity",
    "position_controllers/JointPositionController": "position",
}


class JointCommandController(Controller):
    """Passes ``~/command`` on to one joint's effort, velocity or position."""

    TABLE = ControllerTable(
        ParameterTable(
            "joint_command",
            "Passes a command on to the same interface of one joint.",
            tuple(_INTERFACES),
            (Parameter("joint", "text", None, "the joint; required"),),
        ),
        interfaces="claims effort, velocity or position of the joint, as its type says",
        topics=(Topic("~/command", "std_msgs/Float64", "listens"),),
        behaviour=(
            "At the start efforts and velocities are 0 and positions where the joint is "
            "(joint_*_controller.cpp).",
            "Once stopped it leaves its last command with the hardware.",
        ),
    )

    def __init__(self, context: ControllerContext) -> None:
        """Look up the joint."""
        super().__init__(context)
        context.parameters.require("joint")
        joint = context.parameters.text("joint")
        context.joint(joint)
        interface = _INTERFACES[context.type.replace("::", "/")]
        self.commands = (f"{joint}/{interface}",)
        self._place = int(context.command_places(self.commands)[0])
        self._state_place = -1
        if interface == "position":
            self.states = (f"{joint}/position",)
            self._state_place = int(context.state_places(self.states)[0])
        self._command = 0.0
        context.ports.subscription("~/command", "std_msgs/Float64", self._take)

    def start(self, time_ns: int) -> None:
        """Begin at rest, where the joint is."""
        self._command = 0.0
        if self._state_place >= 0:
            self._command = self.robot.bank.states.item(self._state_place)

    def update(self, time_ns: int, period_ns: int) -> None:
        """Pass the command on."""
        self.robot.bank.commands[self._place] = self._command

    def _take(self, message: Any) -> None:
        self._command = float(message.data)
