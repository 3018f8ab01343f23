"""Joints without a simulator: bodies of known inertia that efforts accelerate exactly."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from tests.control.recording_ports import RecordingPorts

from gazelle.control.controller_parameters import controller_parameters
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.interface_values import InterfaceValues
from gazelle.control.resource_manager import JointLimits, JointResource, Robot
from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics

__all__ = ["Plant", "PlantJoint", "make_controller", "make_robot", "run"]

ALL = ("position", "velocity", "effort")
MS = 1_000_000


@dataclass(frozen=True)
class PlantJoint:
    """A joint of the plant.

    Attributes:
        inertia: kg·m² or kg.
        load: constant effort that acts beside the commanded one, such as gravity, N·m or N.
        damping: viscous, N·m·s/rad or N·s/m.
    """

    name: str
    inertia: float = 1.0
    position: float = 0.0
    velocity: float = 0.0
    load: float = 0.0
    damping: float = 0.0
    commands: tuple[str, ...] = ALL
    states: tuple[str, ...] = ALL
    is_continuous: bool = False
    limits: JointLimits = field(default_factory=JointLimits)


class Plant:
    """Hardware of independent joints.

    Of a joint's commands the first that is a number acts, in the order effort, velocity, position;
    none leaves it to its load. Efforts are limited as the joint says. Nothing else is: a position
    is reached within one step, as Gazebo's SetPosition does.

    Attributes:
        position, velocity, effort: true state (N,), in the order of the joints.
    """

    name, type, plugin = "plant", "system", "test/Plant"
    writes_every_step = False

    def __init__(self, interface_values: InterfaceValues, rows: Sequence[PlantJoint]) -> None:
        self._interface_values, self._rows = interface_values, tuple(rows)
        self.joints = tuple(_resource(row) for row in rows)
        self.switches: list[tuple[frozenset[str], frozenset[str]]] = []
        for row in rows:
            for interface in row.states:
                interface_values.add_state(f"{row.name}/{interface}")
            for interface in row.commands:
                interface_values.add_command(f"{row.name}/{interface}")
        self._limit = np.array([row.limits.max_effort or math.inf for row in rows])
        self.reset()

    def reset(self) -> None:
        """Put everything back to the start."""
        self.position = np.array([row.position for row in self._rows], dtype=np.float64)
        self.velocity = np.array([row.velocity for row in self._rows], dtype=np.float64)
        self.effort = np.zeros(len(self._rows))
        self._wanted: list[tuple[str, float]] = [("", 0.0)] * len(self._rows)

    def read(self, time_ns: int, period_ns: int) -> None:
        """Fill the states."""
        for place, row in enumerate(self._rows):
            for interface in row.states:
                value = getattr(self, interface)[place]
                self._interface_values.states[
                    self._interface_values.state_index[f"{row.name}/{interface}"]
                ] = value

    def write(self, time_ns: int, period_ns: int) -> None:
        """Take over the commands."""
        self._wanted = [self._command(row) for row in self._rows]

    def check_switch(self, start: frozenset[str], stop: frozenset[str]) -> str:
        """Agree."""
        return ""

    def switch(self, start: frozenset[str], stop: frozenset[str]) -> None:
        """Forget the commands of what was released."""
        self.switches.append((start, stop))
        for name in stop:
            self._interface_values.commands[self._interface_values.command_index[name]] = math.nan

    def step(self, period_s: float) -> None:
        """Move on; constant efforts act on constant inertias, so this is exact."""
        for place, (row, wanted) in enumerate(zip(self._rows, self._wanted, strict=True)):
            self._step(place, row, wanted, period_s)

    def _step(self, place: int, row: PlantJoint, wanted: tuple[str, float], dt: float) -> None:
        interface, value = wanted
        x, v = self.position[place], self.velocity[place]
        if interface == "position":
            self.position[place], self.velocity[place] = value, (value - x) / dt
            self.effort[place] = 0.0
            return
        if interface == "velocity":
            self.position[place], self.velocity[place] = x + value * dt, value
            self.effort[place] = 0.0
            return
        effort = max(-self._limit[place], min(value, self._limit[place])) if interface else 0.0
        total = effort + row.load
        if row.damping == 0.0:
            a = total / row.inertia
            self.position[place], self.velocity[place] = x + v * dt + a * dt * dt / 2, v + a * dt
        else:
            end, rate = total / row.damping, row.damping / row.inertia
            kept = math.exp(-rate * dt)
            self.velocity[place] = end + (v - end) * kept
            self.position[place] = x + end * dt + (v - end) * (1.0 - kept) / rate
        self.effort[place] = effort

    def _command(self, row: PlantJoint) -> tuple[str, float]:
        for interface in ("effort", "velocity", "position"):
            if interface in row.commands:
                value = self._interface_values.commands[
                    self._interface_values.command_index[f"{row.name}/{interface}"]
                ]
                if not math.isnan(value):
                    return interface, float(value)
        return "", 0.0


def make_robot(
    joints: Sequence[PlantJoint],
    *,
    ros_version: int = 1,
    sensors: Mapping[str, Mapping[str, float]] | None = None,
    sensor_frames: Mapping[str, str] | None = None,
    model: Model | None = None,
) -> tuple[Robot, Plant]:
    """Return a robot over a plant; sensors are {name: {interface: value}} and never change."""
    interface_values = InterfaceValues()
    plant = Plant(interface_values, joints)
    for sensor, values in (sensors or {}).items():
        for interface, value in values.items():
            interface_values.add_state(f"{sensor}/{interface}", value)
    interface_values.freeze()
    robot = Robot(
        ros_version,
        model or Model("robot"),
        interface_values,
        (plant,),
        {joint.name: joint for joint in plant.joints},
        {
            name: tuple(f"{name}/{word}" for word in values)
            for name, values in (sensors or {}).items()
        },
        sensor_frames or {},
    )
    robot.read(0, 0)
    return robot, plant


def make_controller(
    cls: type[Controller],
    robot: Robot,
    parameters: Mapping[str, Any],
    *,
    ports: RecordingPorts | None = None,
    type_name: str = "",
    name: str = "controller",
    rate_hz: float = 1000.0,
    diagnostics: Diagnostics | None = None,
) -> tuple[Controller, RecordingPorts]:
    """Make a controller as the controller manager does, without one; it is not started."""
    ports = RecordingPorts() if ports is None else ports
    found = Diagnostics() if diagnostics is None else diagnostics
    read = controller_parameters(
        name, parameters, cls.TABLE.parameters, found, full_name=lambda key: f"/{name}/{key}"
    )
    context = ControllerContext(
        name, type_name or cls.TABLE.parameters.types[0], robot, read, ports, rate_hz
    )
    controller = cls(context)
    read.report_unknown()
    return controller, ports


def run(
    robot: Robot,
    controllers: Controller | Sequence[Controller],
    steps: int,
    *,
    period_ns: int = MS,
    time_ns: int = 0,
    after: Callable[[int], None] = lambda time_ns: None,
) -> int:
    """Run started controllers: read, update, write, step; returns the time reached.

    Args:
        robot: over one `Plant`.
        controllers: updated in this order.
        steps: how many.
        period_ns: of update and step.
        time_ns: time of the first update.
        after: called after each step with the time reached.
    """
    every = [controllers] if isinstance(controllers, Controller) else list(controllers)
    (plant,) = robot.components
    for _ in range(steps):
        robot.read(time_ns, period_ns)
        for controller in every:
            controller.update(time_ns, period_ns)
        robot.write(time_ns, period_ns)
        plant.step(period_ns / 1e9)  # type: ignore[attr-defined]
        time_ns += period_ns
        after(time_ns)
    return time_ns


def _resource(row: PlantJoint) -> JointResource:
    types = {"position": "Position", "velocity": "Velocity", "effort": "Effort"}
    names = tuple(
        f"hardware_interface/{types[word]}JointInterface" for word in row.commands if word in types
    )
    return JointResource(row.name, row.commands, row.states, names, row.is_continuous, row.limits)
