"""ros2_control's ``mock_components/GenericSystem``: commands come back as states.

It has no physics and moves nothing in the simulated world. Behaviour and parameters: ros2_control,
``mock_components/generic_system.cpp`` (Humble to Jazzy); ``fake_components`` was its name before.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from gazelle.control.hardware.ros2_joint_setup import Ros2Mimic
from gazelle.control.hardware.ros2_tags import HardwareTag, InterfaceTag, PartTag
from gazelle.control.interface_values import InterfaceValues
from gazelle.control.resource_manager import JointResource

__all__ = ["GENERIC_PARAMETERS", "GenericSystem"]

GENERIC_PARAMETERS = (
    "calculate_dynamics",
    "custom_interface_with_following_offset",
    "disable_commands",
    "fake_gpio_commands",
    "fake_sensor_commands",
    "mock_gpio_commands",
    "mock_sensor_commands",
    "position_state_following_offset",
    "state_following_offset",
)
"""Parameters of ``<hardware>`` that it knows."""

_DYNAMIC = ("position", "velocity", "acceleration")


class _Axis(NamedTuple):
    """Places of position, velocity and acceleration of a joint; -1 for none."""

    states: tuple[int, int, int]
    commands: tuple[int, int, int]


class GenericSystem:
    """Hardware without hardware.

    Args:
        tag: the block.
        interface_values: takes the interfaces.
        joints: resources of its joints.
        mimics: joints that follow others.
    """

    writes_every_step = False

    def __init__(
        self,
        tag: HardwareTag,
        interface_values: InterfaceValues,
        joints: Sequence[JointResource],
        mimics: Sequence[Ros2Mimic] = (),
    ) -> None:
        self.name, self.type, self.plugin = tag.name, tag.type, tag.plugin
        self.joints = tuple(joints)
        self._interface_values = interface_values
        options = tag.parameters
        self._disabled = _flag(options, "disable_commands")
        self._dynamic = _flag(options, "calculate_dynamics")
        self._offset = _number(options, "position_state_following_offset", "state_following_offset")
        self._custom = options.get("custom_interface_with_following_offset", "")
        sensors = _flag(options, "mock_sensor_commands", "fake_sensor_commands")
        gpios = _flag(options, "mock_gpio_commands", "fake_gpio_commands")
        self._initial: dict[int, float] = {}
        for part in tag.parts:
            extra = (part.kind == "sensor" and sensors) or (part.kind == "gpio" and gpios)
            self._register(part, with_commands=extra)
        self._axes = {joint.name: self._axis(joint.name) for joint in joints}
        self._modes = dict.fromkeys(self._axes, "position")
        self._mirrored = self._mirrors(tag)
        self._follows = self._custom_places(tag)
        self._mimics = [row for mimic in mimics for row in self._mimic_places(mimic)]

    def start(self) -> None:
        """Put initial values into the states; called once the interfaces are frozen."""
        states = self._interface_values.states
        for index, value in self._initial.items():
            states[index] = value
        if not self._custom:
            for axis in self._axes.values():
                if axis.states[0] >= 0:
                    states[axis.states[0]] += self._offset

    def read(self, time_ns: int, period_ns: int) -> None:
        """Make states of the commands."""
        if self._disabled:
            return
        if self._dynamic:
            for name, axis in self._axes.items():
                if period_ns > 0:
                    self._integrate(axis, self._modes[name], period_ns * 1e-9)
        states, commands = self._interface_values.states, self._interface_values.commands
        for state, command, offset in self._mirrored:
            value = commands.item(command)
            if math.isfinite(value):
                states[state] = value + offset
        for state, command in self._follows:
            value = commands.item(command) + self._offset
            if math.isfinite(value):
                states[state] = value
        for state, leader, factor, offset in self._mimics:
            states[state] = offset + factor * states.item(leader)

    def write(self, time_ns: int, period_ns: int) -> None:
        """Do nothing: there is nothing to act on."""

    def check_switch(self, start: frozenset[str], stop: frozenset[str]) -> str:
        """With ``calculate_dynamics`` a joint takes exactly one of the three commands."""
        if not self._dynamic:
            return ""
        for name in self._axes:
            claimed = [item.rpartition("/")[2] for item in start if item.startswith(f"{name}/")]
            known = [word for word in claimed if word in _DYNAMIC]
            if claimed and not known:
                words = "'position', 'velocity', or 'acceleration'"
                return f"Joint '{name}' has to have {words} interface!"
            if len(known) > 1:
                return (
                    f"Got multiple ({len(known)}) starting interfaces for joint '{name}' - this is"
                    " not supported!"
                )
        return ""

    def switch(self, start: frozenset[str], stop: frozenset[str]) -> None:
        """Remember which command of a joint counts."""
        for item in start:
            name, _, interface = item.rpartition("/")
            if name in self._modes and interface in _DYNAMIC:
                self._modes[name] = interface

    def reset(self) -> None:
        """Go back to the initial values."""
        names = self._interface_values.command_index
        for joint in self.joints:
            for interface in joint.command_interfaces:
                self._interface_values.commands[names[f"{joint.name}/{interface}"]] = math.nan
        self.start()

    def _register(self, part: PartTag, *, with_commands: bool) -> None:
        interface_values = self._interface_values
        standing = 0.0 if part.kind == "joint" else math.nan
        for item in part.states:
            index = interface_values.add_state(f"{part.name}/{item.name}")
            self._initial[index] = standing if item.initial is None else item.initial
        commands: dict[str, InterfaceTag] = {item.name: item for item in part.commands}
        if with_commands:
            commands = {item.name: InterfaceTag(item.name) for item in part.states} | commands
        for item in commands.values():
            initial = math.nan if item.initial is None else item.initial
            interface_values.add_command(f"{part.name}/{item.name}", initial)

    def _axis(self, joint: str) -> _Axis:
        states, commands = self._interface_values.state_index, self._interface_values.command_index
        first, second, third = (
            (states.get(f"{joint}/{word}", -1), commands.get(f"{joint}/{word}", -1))
            for word in _DYNAMIC
        )
        return _Axis((first[0], second[0], third[0]), (first[1], second[1], third[1]))

    def _mirrors(self, tag: HardwareTag) -> list[tuple[int, int, float]]:
        """Return states with a command of the same name, and what is added to the command."""
        found = []
        integrated = _DYNAMIC if self._dynamic else ()
        kinds = {part.name: part.kind for part in tag.parts}
        for name, command in self._interface_values.command_index.items():
            owner, _, interface = name.rpartition("/")
            if owner not in kinds or name not in self._interface_values.state_index:
                continue
            is_joint = kinds[owner] == "joint"
            if is_joint and interface in integrated:
                continue
            offset = self._offset if is_joint and interface == "position" else 0.0
            index = self._interface_values.state_index[name]
            found.append((index, command, 0.0 if self._custom else offset))
        return found

    def _custom_places(self, tag: HardwareTag) -> list[tuple[int, int]]:
        states, commands = self._interface_values.state_index, self._interface_values.command_index
        names = [part.name for part in tag.of_kind("joint")] if self._custom else []
        return [
            (states[f"{name}/{self._custom}"], commands[f"{name}/position"])
            for name in names
            if f"{name}/{self._custom}" in states and f"{name}/position" in commands
        ]

    def _mimic_places(self, mimic: Ros2Mimic) -> list[tuple[int, int, float, float]]:
        index = self._interface_values.state_index
        return [
            (
                index[f"{mimic.joint}/{word}"],
                index[f"{mimic.leader}/{word}"],
                mimic.multiplier,
                mimic.offset if word == "position" else 0.0,
            )
            for word in _DYNAMIC
            if f"{mimic.joint}/{word}" in index and f"{mimic.leader}/{word}" in index
        ]

    def _integrate(self, axis: _Axis, mode: str, period_s: float) -> None:
        states = [
            math.nan if at < 0 else self._interface_values.states.item(at) for at in axis.states
        ]
        commands = [
            math.nan if at < 0 else self._interface_values.commands.item(at) for at in axis.commands
        ]
        position, velocity, acceleration = states
        speed = velocity if math.isfinite(velocity) else 0.0
        if mode == "position" and math.isfinite(commands[0]):
            offset = 0.0 if self._custom else self._offset
            moved = commands[0] + offset
            velocity = (moved - position) / period_s
            acceleration, position = (velocity - speed) / period_s, moved
        elif mode == "velocity":
            if math.isfinite(commands[1]):
                acceleration, velocity = (commands[1] - speed) / period_s, commands[1]
            position += (velocity if math.isfinite(velocity) else 0.0) * period_s
        elif mode == "acceleration":
            acceleration = commands[2] if math.isfinite(commands[2]) else acceleration
            velocity = speed + (acceleration if math.isfinite(acceleration) else 0.0) * period_s
            position += velocity * period_s
        for at, value in zip(axis.states, (position, velocity, acceleration), strict=True):
            if at >= 0 and math.isfinite(value):
                self._interface_values.states[at] = value


def _flag(options: Mapping[str, str], *names: str) -> bool:
    return any(options.get(name, "").strip().lower() in {"true", "1"} for name in names)


def _number(options: Mapping[str, str], *names: str) -> float:
    for name in names:
        try:
            return float(options[name])
        except (KeyError, ValueError):
            continue
    return 0.0
