"""A robot as controllers see it: interfaces, joints with limits, and the hardware behind them.

Beside it what hardware itself needs of the simulator.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Protocol

from gazelle.control.hardware.lifecycle import HardwareLifecycle
from gazelle.control.interface_values import InterfaceValues
from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics

if TYPE_CHECKING:
    from gazelle.engine import Engine

__all__ = [
    "HardwareComponent",
    "HardwareHost",
    "JointLimits",
    "JointResource",
    "ParameterStore",
    "Robot",
]


class HardwareHost(Protocol):
    """The world that simulated hardware belongs to."""

    engine: Engine
    diagnostics: Diagnostics


class ParameterStore(Protocol):
    """The ROS 1 parameter store, by global names."""

    def get(self, name: str, default: Any = ...) -> Any:
        """Return a parameter or a namespace, or `default`."""
        ...


@dataclass(frozen=True, slots=True)
class JointLimits:
    """Limits of a joint, rad, rad/s, N·m or m, m/s, N; None where there is none.

    Attributes:
        soft_lower, soft_upper, k_position, k_velocity: URDF's ``<safety_controller>``.
    """

    has_position_limits: bool = False
    lower: float = 0.0
    upper: float = 0.0
    max_velocity: float | None = None
    max_acceleration: float | None = None
    max_jerk: float | None = None
    max_effort: float | None = None
    has_soft_limits: bool = False
    soft_lower: float = 0.0
    soft_upper: float = 0.0
    k_position: float = 0.0
    k_velocity: float = 0.0


@dataclass(frozen=True, slots=True)
class JointResource:
    """A joint of the hardware.

    Attributes:
        command_interfaces: ``position``, ``velocity``, ``effort`` …, those that can be claimed.
        state_interfaces: those that can be read.
        hardware_interfaces: ROS 1 names, such as ``hardware_interface/EffortJointInterface``.
        is_continuous: positions wrap around.
    """

    name: str
    command_interfaces: tuple[str, ...]
    state_interfaces: tuple[str, ...]
    hardware_interfaces: tuple[str, ...] = ()
    is_continuous: bool = False
    limits: JointLimits = field(default_factory=JointLimits)


class HardwareComponent(Protocol):
    """One piece of hardware: a ``<ros2_control>`` block or a ROS 1 ``RobotHW``."""

    @property
    def name(self) -> str:
        """Name of the block."""
        ...

    @property
    def type(self) -> str:
        """``system``, ``actuator`` or ``sensor``."""
        ...

    @property
    def plugin(self) -> str:
        """Its class, such as ``gazebo_ros2_control/GazeboSystem``."""
        ...

    @property
    def joints(self) -> tuple[JointResource, ...]:
        """Its joints."""
        ...

    @property
    def writes_every_step(self) -> bool:
        """Whether `write` must run at every physics step, not only after an update."""
        ...

    def read(self, time_ns: int, period_ns: int) -> None:
        """Put what is measured into the states."""
        ...

    def write(self, time_ns: int, period_ns: int) -> None:
        """Act on the commands; limits are enforced here."""
        ...

    def check_switch(self, start: frozenset[str], stop: frozenset[str]) -> str:
        """Return why these command interfaces cannot be claimed together, empty when they can."""
        ...

    def switch(self, start: frozenset[str], stop: frozenset[str]) -> None:
        """Hear that command interfaces are claimed and released from now on."""
        ...

    def reset(self) -> None:
        """Start over after the world was reset."""
        ...


@dataclass(frozen=True, slots=True)
class Robot:
    """Everything a controller manager drives.

    Attributes:
        ros_version: 1 for ros_control, 2 for ros2_control.
        model: description of the robot.
        interface_values: named ``joint/interface``, without the model's name.
        components: hardware, in the order of the file.
        joints: by name, over all components.
        sensors: state interfaces of sensors by the sensor's name, in order.
        sensor_frames: ``frame_id`` of each sensor.
        absent: hardware by the name of a joint, sensor or gpio that it would give if its class
            were here; that was reported, so nobody else is to blame.
        lifecycle: states of the components.
    """

    ros_version: int
    model: Model
    interface_values: InterfaceValues
    components: tuple[HardwareComponent, ...]
    joints: Mapping[str, JointResource]
    sensors: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    sensor_frames: Mapping[str, str] = field(default_factory=dict)
    absent: Mapping[str, str] = field(default_factory=dict)
    lifecycle: HardwareLifecycle = field(default_factory=HardwareLifecycle)

    def read(self, time_ns: int, period_ns: int) -> None:
        """Measure."""
        for component in self.components:
            if self.lifecycle.reads(component.name):
                component.read(time_ns, period_ns)

    def write(self, time_ns: int, period_ns: int) -> None:
        """Act on the commands."""
        for component in self.components:
            if self.lifecycle.writes(component.name):
                component.write(time_ns, period_ns)

    def check_switch(self, start: frozenset[str], stop: frozenset[str]) -> str:
        """Return why the interfaces cannot be claimed together, empty when they can."""
        reasons = (component.check_switch(start, stop) for component in self.components)
        return next((reason for reason in reasons if reason), "")

    def switch(self, start: frozenset[str], stop: frozenset[str]) -> None:
        """Tell the hardware what is claimed and released."""
        indices = self.interface_values.command_indices(
            [name for name in start | stop if name in self.interface_values.command_index]
        )
        self.interface_values.stiffness[indices] = self.interface_values.damping[indices] = 0.0
        for component in self.components:
            component.switch(start, stop)
