"""A robot of two joints without physics, and a controller that writes down what happens."""

from __future__ import annotations

from typing import Any, ClassVar

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.interface_values import InterfaceValues
from gazelle.control.resource_manager import JointResource, Robot
from gazelle.description.model import Model
from gazelle.parameters import Parameter, ParameterTable

RECORDER = "test_controllers/Recorder"


class Hardware:
    """Commands become states at once; everything it is told is written down."""

    name, type, plugin = "block", "system", "test/Hardware"
    writes_every_step = False

    def __init__(
        self, interface_values: InterfaceValues, joints: tuple[JointResource, ...]
    ) -> None:
        self.interface_values, self.joints = interface_values, joints
        self.log: list[Any] = []
        self.refusal = ""

    def read(self, time_ns: int, period_ns: int) -> None:
        self.log.append(("read", time_ns))

    def write(self, time_ns: int, period_ns: int) -> None:
        self.log.append(("write", time_ns))

    def check_switch(self, start: frozenset[str], stop: frozenset[str]) -> str:
        return self.refusal

    def switch(self, start: frozenset[str], stop: frozenset[str]) -> None:
        self.log.append(("switch", start, stop))

    def reset(self) -> None:
        self.log.append(("reset",))


class Recorder(Controller):
    """Claims one interface of its joint and writes down what happens to it."""

    TABLE: ClassVar[ControllerTable] = ControllerTable(
        ParameterTable(
            "recorder",
            "test",
            ("test_controllers/Recorder",),
            (
                Parameter("joint", "text", None, "joint"),
                Parameter("interface", "text", "effort", "interface"),
                Parameter("gain", "number", 1.0, "gain", live=True),
                Parameter("fails_in", "text", "", "where to raise"),
            ),
        ),
        interfaces="any",
    )

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        context.parameters.require("joint")
        self._fails_in = context.parameters.text("fails_in")
        self.gain = context.parameters.number("gain")
        joint = context.parameters.text("joint")
        self.commands = (f"{joint}/{context.parameters.text('interface')}",)
        context.command_indices(self.commands)
        self.states = (f"{joint}/position",)
        self.calls: list[tuple[Any, ...]] = []

    def start(self, time_ns: int) -> None:
        self._do("start", time_ns)

    def update(self, time_ns: int, period_ns: int) -> None:
        self._do("update", time_ns, period_ns)

    def stop(self, time_ns: int) -> None:
        self._do("stop", time_ns)

    def changed(self, values: dict[str, Any]) -> str:
        if values.get("gain", 0) < 0:
            return "gain must not be negative"
        self.gain = values["gain"]
        return ""

    def close(self) -> None:
        self.calls.append(("close",))

    def _do(self, *call: Any) -> None:
        self.calls.append(call)
        if call[0] == self._fails_in:
            raise ValueError("broken on purpose")


def fake_robot(ros_version: int) -> tuple[Robot, Hardware]:
    """Return a robot with joints ``left`` and ``right``."""
    interfaces = ("position", "velocity", "effort")
    names = ("hardware_interface/EffortJointInterface",)
    joints = tuple(JointResource(name, interfaces, interfaces, names) for name in ("left", "right"))
    interface_values = InterfaceValues()
    for joint in joints:
        for interface in interfaces:
            interface_values.add_state(f"{joint.name}/{interface}", 0.0)
            interface_values.add_command(f"{joint.name}/{interface}")
    interface_values.freeze()
    hardware = Hardware(interface_values, joints)
    return Robot(
        ros_version, Model("mira"), interface_values, (hardware,), {j.name: j for j in joints}
    ), hardware
