"""Simulated hardware of ROS 2: GazeboSystem of Gazebo Classic, GazeboSimSystem of gz-sim.

Sources: gazebo_ros2_control (Foxy to Humble), ``gazebo_system.cpp``; gz_ros2_control (Humble's
ign_ros2_control to Jazzy), ``gz_system.cpp``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gazelle.control.hardware.engine_joints import JointStates
from gazelle.control.hardware.ros2_joint_group import Ros2Section
from gazelle.control.hardware.ros2_joint_setup import Ros2Joint, Ros2Mimic
from gazelle.control.hardware.ros2_tags import HardwareTag
from gazelle.control.hardware.sensor_states import SensorStates
from gazelle.control.interface_values import Array, InterfaceValues
from gazelle.control.resource_manager import JointResource

if TYPE_CHECKING:
    from gazelle.engine import Engine

__all__ = ["GazeboSystem", "SystemOptions"]

_PRIORITY = {False: ("position", "velocity", "effort"), True: ("velocity", "position", "effort")}
"""Which of several claimed commands of a joint counts, in Gazebo Classic and in gz-sim."""


class SystemOptions(NamedTuple):
    """How a Gazebo drives joints.

    Attributes:
        is_gz: gz-sim's motors with effort limits, instead of Classic's kinematic ones.
        hold_joints: joints without a claimed command stand still.
        position_proportional_gain: gz-sim's: share of the error made up for in a period.
        update_rate_hz: of the control loop.
        has_world: False where there is no simulation, and mock hardware is what is wanted.
        mocks_compiled: mock hardware takes the place of classes that are not here.
    """

    is_gz: bool
    hold_joints: bool = True
    position_proportional_gain: float = 0.1
    update_rate_hz: float = 100.0
    has_world: bool = True
    mocks_compiled: bool = False


class GazeboSystem:
    """Joints and sensors of one block.

    Args:
        engine: the physics.
        interface_values: takes the interfaces.
        model: name of the model in the world.
        tag: the block.
        joints: those that the model has.
        mimics: which of them follow others.
        sensors: of the block.
        options: how joints are driven.
    """

    type = "system"

    def __init__(
        self,
        engine: Engine,
        interface_values: InterfaceValues,
        model: str,
        tag: HardwareTag,
        joints: Sequence[Ros2Joint],
        mimics: Sequence[Ros2Mimic],
        sensors: SensorStates,
        options: SystemOptions,
    ) -> None:
        self.name, self.plugin = tag.name, tag.plugin
        self.joints: tuple[JointResource, ...] = tuple(joint.resource() for joint in joints)
        self.options = options
        self._engine, self._interface_values, self._model = engine, interface_values, model
        self._own = tuple(joints)
        self._index = {joint.name: index for index, joint in enumerate(joints)}
        self._states = JointStates(
            engine, interface_values, model, [(joint.name, tuple(joint.states)) for joint in joints]
        )
        self.sensors = sensors
        for joint in joints:
            for interface in joint.commands:
                interface_values.add_command(f"{joint.name}/{interface}")
        self._mimics = [
            row
            for row in mimics
            if row.joint in self._index and (row.is_physical or row.leader in self._index)
        ]
        self._coupled = [row for row in self._mimics if not row.is_physical]
        self._claimed: dict[str, set[str]] = {joint.name: set() for joint in joints}
        self._methods: list[str] = []
        self._sections: list[Ros2Section] = []
        self._written_ns = -1

    @property
    def writes_every_step(self) -> bool:
        """True with PIDs and with joints that follow others by the block's own word."""
        has_gains = any(joint.gains for joint in self._own)
        return bool(self._coupled) or has_gains

    def start(self) -> None:
        """Take initial values and hold joints; called once the interfaces are frozen."""
        for joint in self._own:
            handle = self._engine.joint(f"{self._model}::{joint.name}")
            position, velocity = (joint.states.get(kind) for kind in ("position", "velocity"))
            if position is not None and position.initial is not None:
                handle.set_state(position=position.initial)
            if velocity is not None and velocity.initial is not None:
                handle.set_state(velocity=velocity.initial)
        for row in self._mimics:
            self._follow_mimic(row)
        self._states.read()
        # Claimed joints too: they hold until a command comes.
        self._methods = [self._idle_method(joint) for joint in self._own]
        self._stand([index for index, word in enumerate(self._methods) if word == "hold"])
        self._arrange()

    def read(self, time_ns: int, period_ns: int) -> None:
        """Measure."""
        self._states.read()
        self.sensors.read()

    def write(self, time_ns: int, period_ns: int) -> None:
        """Command the joints."""
        step_ns = self._engine.step_ns
        is_new = time_ns != self._written_ns
        self._written_ns = time_ns
        if is_new and self.writes_every_step:
            # These look at the joints themselves, not at what controllers were told.
            self._states.group.read(self._states.position, self._states.velocity)
        steps = max(1, period_ns // step_ns)
        for section in self._sections:
            section.write(self._states, step_ns * 1e-9, steps, is_new=is_new)
        if self._coupled and is_new:
            self._follow()

    def check_switch(self, start: frozenset[str], stop: frozenset[str]) -> str:
        """Return nothing: of several commands of a joint one wins, as in Gazebo."""
        return ""

    def switch(self, start: frozenset[str], stop: frozenset[str]) -> None:
        """Take over which commands count from now on."""
        for names, change in ((stop, set.discard), (start, set.add)):
            for item in names:
                joint, _, interface = item.rpartition("/")
                if joint in self._claimed:
                    change(self._claimed[joint], interface)
                    index = self._interface_values.command_index.get(item)
                    if index is not None:
                        self._interface_values.commands[index] = math.nan
        self._states.read()
        self._arrange()

    def reset(self) -> None:
        """Start over after the world was reset."""
        self._written_ns = -1
        self._states.group.release()
        for joint in self._own:
            for interface in joint.commands:
                index = self._interface_values.command_index[f"{joint.name}/{interface}"]
                self._interface_values.commands[index] = math.nan
        for section in self._sections:
            section.forget()
        self.start()

    # --- inside --------------------------------------------------------------------------

    def _method(self, joint: Ros2Joint) -> str:
        """Return how a joint is driven now: by a command's method, or as without one."""
        idle = self._idle_method(joint)
        if idle == "mimic":
            return idle
        claimed = self._claimed[joint.name]
        for interface in _PRIORITY[self.options.is_gz]:
            if interface in claimed and interface in joint.commands:
                if interface in joint.gains and not self.options.is_gz:
                    return f"{interface}_pid"
                is_servo = interface == "position" and self.options.is_gz
                return "servo" if is_servo else interface
        return idle

    def _idle_method(self, joint: Ros2Joint) -> str:
        """Return ``mimic``, ``hold`` or ``free``: what a joint does that nobody commands."""
        if any(row.joint == joint.name for row in self._mimics):
            return "mimic"
        return "hold" if joint.commands and self.options.hold_joints else "free"

    def _arrange(self) -> None:
        """Group the joints by method; those whose method stays keep their section."""
        methods = [self._method(joint) for joint in self._own]
        changed = [index for index, word in enumerate(methods) if word != self._methods[index]]
        self._stand([index for index in changed if methods[index] == "hold"])
        leaving = [index for index in changed if methods[index] == "free" and self._methods[index]]
        if leaving:
            self._states.group.release(leaving)
        if not changed:
            return
        self._methods = methods
        kept = {section.names: section for section in self._sections}
        self._sections = []
        for method in dict.fromkeys(methods):
            if method in {"hold", "free", "mimic"}:
                continue
            indices = [index for index, word in enumerate(methods) if word == method]
            names = tuple(self._own[index].name for index in indices)
            old = kept.get(names)
            same = old is not None and old.method == method and not set(indices) & set(changed)
            self._sections.append(old if same and old is not None else self._made(indices, method))

    def _made(self, indices: Sequence[int], method: str) -> Ros2Section:
        options = self.options
        return Ros2Section(
            self._engine,
            self._interface_values,
            self._model,
            self._own,
            indices,
            method,
            servo_gain_1_s=options.position_proportional_gain * options.update_rate_hz,
            max_effort=self._motor_limits(indices),
        )

    def _motor_limits(self, indices: Sequence[int]) -> Array:
        if not self.options.is_gz:
            return np.full(len(indices), math.inf)
        limits = [self._own[index].limits.max_effort for index in indices]
        return np.array([math.inf if limit is None else limit for limit in limits])

    def _stand(self, indices: Sequence[int]) -> None:
        """Make joints stand still where they are."""
        if not indices:
            return
        values = np.full(len(self._own), math.nan)
        if self.options.is_gz:
            values[list(indices)] = 0.0
            limits = self._motor_limits(range(len(self._own)))
            self._states.group.set_velocity(values, limits)
        else:
            values[list(indices)] = self._states.position[list(indices)]
            self._states.group.lock_position(values)

    def _follow_mimic(self, row: Ros2Mimic) -> None:
        """Put a following joint where its leader wants it."""
        leader = self._engine.joint(f"{self._model}::{row.leader}").position
        follower = self._engine.joint(f"{self._model}::{row.joint}")
        follower.set_state(position=row.offset + row.multiplier * leader)

    def _follow(self) -> None:
        states = self._states
        values = np.full(len(self._own), math.nan)
        for row in self._coupled:
            target = row.offset + row.multiplier * states.position[self._index[row.leader]]
            values[self._index[row.joint]] = target
        if self.options.is_gz:
            speed = (values - states.position) * self.options.update_rate_hz
            states.group.set_velocity(speed, self._motor_limits(range(len(values))))
        else:
            states.group.lock_position(values)
