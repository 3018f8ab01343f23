"""The robot of ROS 2: engine and ``<ros2_control>`` blocks behind ros2_control's interfaces."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from gazelle.control.hardware.gazebo_system import GazeboSystem, SystemOptions
from gazelle.control.hardware.generic_system import GENERIC_PARAMETERS, GenericSystem
from gazelle.control.hardware.lifecycle import HardwareLifecycle
from gazelle.control.hardware.ros2_joint_setup import read_mimics, read_ros2_joints, resource_of
from gazelle.control.hardware.ros2_tags import HardwareTag, read_hardware_tags
from gazelle.control.hardware.sensor_states import SensorSource, SensorStates
from gazelle.control.interface_values import InterfaceValues
from gazelle.control.resource_manager import HardwareHost, Robot
from gazelle.description.model import Model
from gazelle.diagnostics import did_you_mean

__all__ = ["MOCK_VARIABLE", "build_ros2_robot"]

MOCK_VARIABLE = "GAZELLE_MOCK_HARDWARE"
"""Variable that has mock hardware in the place of compiled classes that are not here."""


_CLASSIC = ("gazebo_ros2_control/GazeboSystem",)
_GZ = ("gz_ros2_control/GazeboSimSystem", "ign_ros2_control/IgnitionSystem")
_MOCK = ("mock_components/GenericSystem", "fake_components/GenericSystem")
_KNOWN = (*_CLASSIC, *_GZ, *_MOCK)


def build_ros2_robot(
    host: HardwareHost,
    model: Model,
    options: SystemOptions,
    *,
    gains: Mapping[str, Any] | None = None,
    sensors: SensorSource | None = None,
) -> Robot:
    """Return the robot of a model in the world; joints have their initial values and hold.

    Args:
        host: the physics, and where to report.
        model: as it is in the world, with its ``<ros2_control>`` blocks.
        options: of the plug-in that loads the hardware.
        gains: ``pid_gains`` of the plug-in's node.
        sensors: what the model can measure; None for nothing.
    """
    builder = _Builder(host, model, options, gains or {}, sensors)
    tags = read_hardware_tags(model, host.diagnostics)
    if not tags:
        text = f"model '{model.name}' has no <ros2_control> block: there is nothing to control"
        text += " (no ros2_control tag)"
        host.diagnostics.report("control.ros2-control-missing", text, model.span)
    for tag in tags:
        builder.add(tag)
    return builder.robot()


class _Builder:
    def __init__(
        self,
        host: HardwareHost,
        model: Model,
        options: SystemOptions,
        gains: Mapping[str, Any],
        sensors: SensorSource | None,
    ) -> None:
        self._host, self._model, self._options = host, model, options
        self._gains, self._sensors = gains, sensors
        self._interface_values = InterfaceValues()
        self._components: list[GazeboSystem | GenericSystem] = []
        self._interfaces: dict[str, tuple[str, ...]] = {}
        self._frames: dict[str, str] = {}
        self._absent: dict[str, str] = {}
        self._owners: dict[str, str] = {}

    def add(self, tag: HardwareTag) -> None:
        """Make the hardware of a block; a block whose class is unknown is reported only."""
        self._make(tag)
        for name in (*self._interface_values.command_index, *self._interface_values.state_index):
            self._owners.setdefault(name, tag.name)

    def _make(self, tag: HardwareTag) -> None:
        plugin = tag.plugin.replace("::", "/")
        if plugin not in self._known() and self._options.mocks_compiled:
            self._report_mocked(tag)
            self._add_mock(tag)
            return
        if plugin not in self._known():
            self._absent.update({part.name: tag.name for part in tag.parts})
            self._report_unknown(tag)
        elif plugin in _MOCK:
            if self._options.has_world:
                self._report_elsewhere(tag, "it mirrors commands and moves nothing")
            self._add_mock(tag)
        else:
            is_gz = plugin in _GZ
            if is_gz is not self._options.is_gz:
                self._report_elsewhere(tag, "it works here all the same")
            self._add_simulated(tag, self._options._replace(is_gz=is_gz))

    def robot(self) -> Robot:
        """Return everything added, ready to be read."""
        self._interface_values.freeze()
        for component in self._components:
            component.start()
        joints = {joint.name: joint for item in self._components for joint in item.joints}
        held = {*joints, *self._interfaces}
        return Robot(
            2,
            self._model,
            self._interface_values,
            tuple(self._components),
            joints,
            self._interfaces,
            self._frames,
            {name: tag for name, tag in self._absent.items() if name not in held},
            HardwareLifecycle(self._owners),
        )

    def _add_simulated(self, tag: HardwareTag, options: SystemOptions) -> None:
        host, model = self._host, self._model
        joints = read_ros2_joints(host, model, tag, self._gains)
        mimics = read_mimics(host, model, tag)
        sensors = SensorStates(
            tag.of_kind("sensor"), self._interface_values, self._sensors, host.diagnostics
        )
        for part in tag.of_kind("gpio"):
            text = f"gpio '{part.name}' of '{tag.name}' is left out: {tag.plugin} has none"
            host.diagnostics.report("control.ros2-control-gpio", text, part.span)
        self._report_parameters(tag, ())
        self._components.append(
            GazeboSystem(
                host.engine,
                self._interface_values,
                model.name,
                tag,
                joints,
                mimics,
                sensors,
                options,
            )
        )
        self._interfaces.update(sensors.interfaces)
        self._frames.update(sensors.frames)

    def _add_mock(self, tag: HardwareTag) -> None:
        joints = [resource_of(part, self._model) for part in tag.of_kind("joint")]
        mimics = read_mimics(self._host, self._model, tag)
        self._report_parameters(tag, GENERIC_PARAMETERS)
        self._components.append(GenericSystem(tag, self._interface_values, joints, mimics))
        for part in (*tag.of_kind("sensor"), *tag.of_kind("gpio")):
            self._interfaces[part.name] = tuple(f"{part.name}/{item.name}" for item in part.states)
            self._frames[part.name] = part.parameters.get("frame_id", part.name)

    def _known(self) -> tuple[str, ...]:
        """Return the classes there are here: those of Gazebo need a world."""
        return _KNOWN if self._options.has_world else _MOCK

    def _report_unknown(self, tag: HardwareTag) -> None:
        """Say which package's class is not here, and what is lost with it."""
        plugin = tag.plugin.replace("::", "/")
        package, _, name = plugin.rpartition("/")
        if not tag.plugin:
            what = "has no <plugin>"
        elif plugin in _KNOWN:
            what = f"has class '{name}' of package '{package}', which runs in a world only"
        elif package:
            what = f"has class '{name}' of package '{package}', which is compiled code that is"
            what += " not here"
        else:
            what = f"has class '{name}', which is not here"
        lost = ", ".join(f"{part.kind} '{part.name}'" for part in tag.parts) or "nothing else"
        text = f"hardware '{tag.name}' {what}; lost with it, for every controller: {lost}"
        if tag.plugin:
            text += " (The plugin failed to load for some reason. According to the loaded plugin"
            text += f" descriptions the class {tag.plugin} does not exist.)"
        best = _GZ[0] if self._options.is_gz else _CLASSIC[0]
        if not self._options.has_world:
            best = _MOCK[0]
        hint = did_you_mean(plugin, self._known())
        hint = hint or f"where the real robot is not, write <plugin>{best}</plugin>"
        if not self._options.has_world and package and plugin not in _KNOWN:
            hint += f", or start with {MOCK_VARIABLE}=1: commands come back as states"
        self._host.diagnostics.report("control.hardware-plugin", text, tag.span, fix=hint)

    def _report_mocked(self, tag: HardwareTag) -> None:
        text = f"hardware '{tag.name}' is {_MOCK[0]} in the place of {tag.plugin}, as "
        text += f"{MOCK_VARIABLE} asks for: commands come back as states"
        fix = f"unset {MOCK_VARIABLE} where the real robot is"
        self._host.diagnostics.report("control.hardware-mocked", text, tag.span, fix=fix)

    def _report_elsewhere(self, tag: HardwareTag, what: str) -> None:
        best = _GZ[0] if self._options.is_gz else _CLASSIC[0]
        text = f"hardware '{tag.name}' is {tag.plugin}, which the model's Gazebo plug-in would not"
        text += f" load; {what}"
        fix = f"for the simulation, write <plugin>{best}</plugin>"
        self._host.diagnostics.report("control.hardware-plugin-other", text, tag.span, fix=fix)

    def _report_parameters(self, tag: HardwareTag, known: tuple[str, ...]) -> None:
        for name in tag.parameters:
            if name not in known:
                text = f"parameter '{name}' of hardware '{tag.name}' has no effect on {tag.plugin}"
                hint = did_you_mean(name, known)
                self._host.diagnostics.report(
                    "control.hardware-parameter", text, tag.span, fix=hint
                )
