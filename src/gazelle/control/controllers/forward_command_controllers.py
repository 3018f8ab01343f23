"""Controllers that pass numbers on: ROS 1's of one joint, lists of both ROS."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.errors import ControllerError
from gazelle.control.interface_values import Array, Indices
from gazelle.parameters import Parameter, ParameterTable, Topic

__all__ = [
    "JointCommandController",
    "JointGroupCommandController",
    "MultiInterfaceCommandController",
]


_JOINT_INTERFACES = {
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
            tuple(_JOINT_INTERFACES),
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
        interface = _JOINT_INTERFACES[context.type.replace("::", "/")]
        self.commands = (f"{joint}/{interface}",)
        self._index = int(context.command_indices(self.commands)[0])
        self._state_index = -1
        if interface == "position":
            self.states = (f"{joint}/position",)
            self._state_index = int(context.state_indices(self.states)[0])
        self._command = 0.0
        context.ports.subscription("~/command", "std_msgs/Float64", self._take)

    def start(self, time_ns: int) -> None:
        """Begin at rest, where the joint is."""
        self._command = 0.0
        if self._state_index >= 0:
            self._command = self.robot.interface_values.states.item(self._state_index)

    def update(self, time_ns: int, period_ns: int) -> None:
        """Pass the command on."""
        self.robot.interface_values.commands[self._index] = self._command

    def _take(self, message: Any) -> None:
        self._command = float(message.data)


_INTERFACES = {
    "effort_controllers/JointGroupEffortController": "effort",
    "velocity_controllers/JointGroupVelocityController": "velocity",
    "position_controllers/JointGroupPositionController": "position",
}

_FORWARD = "forward_command_controller/ForwardCommandController"

_MULTI = "forward_command_controller/MultiInterfaceForwardCommandController"

_ARRAY = "std_msgs/Float64MultiArray"

_UNTIL_TOLD = "In ROS 2 nothing is commanded before the first message after each activation."


class _ForwardController(Controller):
    """Passes arrays on.

    Attributes:
        stop_value: written to every interface at the stop; None leaves the commands.
    """

    stop_value: float | None = None

    def _forward(self, commands: tuple[str, ...]) -> None:
        """Look up interfaces and listen."""
        context = self.context
        self.commands = commands
        self._indices: Indices = context.command_indices(commands)
        self._values: Array | None = None
        topic = "~/command" if context.ros_version == 1 else "~/commands"
        context.ports.subscription(topic, _ARRAY, self._take)

    def start(self, time_ns: int) -> None:
        """Forget what came before."""
        self._values = None

    def update(self, time_ns: int, period_ns: int) -> None:
        """Pass the last array on."""
        if self._values is not None:
            self.robot.interface_values.commands[self._indices] = self._values

    def stop(self, time_ns: int) -> None:
        """Set everything to 0 where the original does."""
        if self.stop_value is not None:
            self.robot.interface_values.commands[self._indices] = self.stop_value

    def _take(self, message: Any) -> None:
        values = np.array(message.data, dtype=np.float64)
        count = len(self.commands)
        if len(values) == count:
            self._values = values
            return
        if self.context.ros_version == 1:
            text = (
                f"Dimension of command ({len(values)}) does not match number of joints ({count})! "
            )
            text += "Not executing!"
        else:
            text = f"command size ({len(values)}) does not match number of interfaces ({count})"
        self.context.ports.log("error", f"{self.context.name}: {text}")


class JointGroupCommandController(_ForwardController):
    """Passes arrays on to one interface of several joints, in both generations."""

    TABLE = ControllerTable(
        ParameterTable(
            "joint_group_command",
            "Passes an array of commands on to the same interface of several joints.",
            (*_INTERFACES, _FORWARD),
            (
                Parameter(
                    "joints", "texts", None, "the joints, in the order of the array; required"
                ),
                Parameter(
                    "interface_name",
                    "text",
                    None,
                    "interface of ForwardCommandController; required there",
                    ros_versions=(2,),
                ),
            ),
        ),
        interfaces="claims effort, velocity or position of the joints, as the type says, or"
        " `interface_name`",
        topics=(
            Topic("~/command", _ARRAY, "listens", ros_versions=(1,)),
            Topic("~/commands", _ARRAY, "listens", ros_versions=(2,)),
        ),
        behaviour=(
            "In ROS 1 efforts and velocities begin at 0 and positions where the joints are "
            "(joint_group_*_controller.cpp).",
            _UNTIL_TOLD,
            "In ROS 2 effort_controllers and velocity_controllers command 0 when they stop.",
            "An array of the wrong length is not taken.",
        ),
    )

    def __init__(self, context: ControllerContext) -> None:
        """Look up the joints."""
        super().__init__(context)
        parameters = context.parameters
        parameters.require("joints")
        joints = parameters.texts("joints")
        if not joints:
            empty = ("List of joint names is empty.", "'joints' parameter was empty")
            raise ControllerError(f"{context.name}: {empty[context.ros_version - 1]}")
        for joint in joints:
            context.joint(joint)
        kind = context.type.replace("::", "/")
        interface = _INTERFACES.get(kind, "")
        if not interface:
            parameters.require("interface_name")
            interface = parameters.text("interface_name")
        elif parameters.has("interface_name"):
            text = f"'interface_name' has no effect: {context.type} commands {interface}"
            parameters.report("parameter.idle", text, key="interface_name")
        self._forward(tuple(f"{joint}/{interface}" for joint in joints))
        self._state_indices: Indices | None = None
        if context.ros_version == 1 and interface == "position":
            self.states = self.commands
            self._state_indices = context.state_indices(self.states)
        if context.ros_version == 2 and interface != "position" and kind != _FORWARD:
            self.stop_value = 0.0

    def start(self, time_ns: int) -> None:
        """Begin at rest in ROS 1, with nothing in ROS 2."""
        super().start(time_ns)
        if self._state_indices is not None:
            self._values = self.robot.interface_values.states[self._state_indices]
        elif self.context.ros_version == 1:
            self._values = np.zeros(len(self.commands))


class MultiInterfaceCommandController(_ForwardController):
    """Passes arrays on to several interfaces of one joint."""

    TABLE = ControllerTable(
        ParameterTable(
            "multi_interface_command",
            "Passes an array of commands on to several interfaces of one joint.",
            (_MULTI,),
            (
                Parameter("joint", "text", None, "the joint; required", ros_versions=(2,)),
                Parameter(
                    "interface_names",
                    "texts",
                    None,
                    "its interfaces, in the order of the array; required",
                    ros_versions=(2,),
                ),
            ),
        ),
        interfaces="claims `interface_names` of the joint",
        topics=(Topic("~/commands", _ARRAY, "listens", ros_versions=(2,)),),
        behaviour=(_UNTIL_TOLD, "Once stopped it leaves its last command with the hardware."),
    )

    def __init__(self, context: ControllerContext) -> None:
        """Look up the interfaces."""
        super().__init__(context)
        context.parameters.require("joint")
        context.parameters.require("interface_names")
        joint = context.parameters.text("joint")
        context.joint(joint)
        names = context.parameters.texts("interface_names")
        self._forward(tuple(f"{joint}/{name}" for name in names))
