"""Rotors on a fixed base: joints whose motion under effort is known exactly."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from gazelle.control.hardware.gazebo_system import SystemOptions
from gazelle.control.hardware.ros1_robot import RobotParameters, build_ros1_robot
from gazelle.control.hardware.ros2_robot import build_ros2_robot
from gazelle.control.parameter_sources.ros1_parameter_server import StoreSource
from gazelle.control.resource_manager import Robot
from gazelle.description.model import Model, World
from gazelle.description.read_context import ReadContext
from gazelle.description.urdf_reader.reader import read_urdf
from gazelle.diagnostics import Diagnostics
from gazelle.engine import Engine
from gazelle.simulator.intra_process_node import LocalParameters

INERTIA = 0.5
STEP_S = 0.001


def rotor(
    name: str,
    kind: str = "revolute",
    limit: str = 'lower="-3" upper="3" effort="10" velocity="4"',
    axis: str = "0 0 1",
    more: str = "",
) -> str:
    """Return a joint at the base and its link, 0.5 kg·m² about every axis."""
    limits = f"<limit {limit}/>" if limit else ""
    return f"""<link name="{name}_link"><inertial><mass value="1"/>
    <inertia ixx="{INERTIA}" iyy="{INERTIA}" izz="{INERTIA}" ixy="0" ixz="0" iyz="0"/></inertial>
    </link><joint name="{name}" type="{kind}"><parent link="world"/><child link="{name}_link"/>
    <axis xyz="{axis}"/>{limits}{more}</joint>"""  # fmt: skip


def transmission(joint: str, interface: str = "Effort", prefix: str = "hardware_interface/") -> str:
    """Return the simple transmission of a joint."""
    return f"""<transmission name="{joint}_trans">
    <type>transmission_interface/SimpleTransmission</type><joint name="{joint}">
    <hardwareInterface>{prefix}{interface}JointInterface</hardwareInterface></joint>
    <actuator name="{joint}_motor"><mechanicalReduction>1</mechanicalReduction></actuator>
    </transmission>"""


def urdf(*parts: str) -> str:
    """Return a robot fixed to the world."""
    return f'<robot name="rig"><link name="world"/>{"".join(parts)}</robot>'


@dataclass
class Rig:
    """A robot in a world of its own, driven without any controller manager.

    Attributes:
        period: physics steps between two updates.
    """

    engine: Engine
    model: Model
    diagnostics: Diagnostics
    robot: Robot = field(init=False)
    period: int = 1

    @property
    def hardware(self) -> Any:
        return self.robot.components[0]

    def claim(self, *names: str) -> None:
        """Claim command interfaces."""
        assert self.robot.check_switch(frozenset(names), frozenset()) == ""
        self.robot.switch(frozenset(names), frozenset())

    def drop(self, *names: str) -> None:
        """Release command interfaces."""
        self.robot.switch(frozenset(), frozenset(names))

    def command(self, **values: float) -> None:
        """Give commands, ``j_effort=1.0`` for ``j/effort``."""
        for key, value in values.items():
            name = "/".join(key.rsplit("_", 1))
            self.robot.interface_values.commands[
                self.robot.interface_values.command_index[name]
            ] = value

    def state(self, name: str) -> float:
        """Return a state as controllers see it."""
        (place,) = self.robot.interface_values.state_indices([name])
        self.robot.read(self.engine.time_ns, 0)
        return float(self.robot.interface_values.states[place])

    def run(self, steps: int, **values: float) -> np.ndarray:
        """Read, command and write at every period as the loaders do; return positions (steps, N).

        The commands are given anew at every update, as controllers do.
        """
        names = [f"rig::{joint}" for joint in self.robot.joints]
        seen = []
        for _ in range(steps):
            now, step_ns = self.engine.time_ns, self.engine.step_ns
            if self.engine.iteration % self.period == 0:
                self.robot.read(now, self.period * step_ns)
                self.command(**values)
                self.robot.write(now, self.period * step_ns)
            for component in self.robot.components:
                if component.writes_every_step:
                    component.write(now, step_ns)
            self.engine.step()
            seen.append([self.engine.joint(name).position for name in names])
        return np.array(seen)

    def position(self, joint: str) -> float:
        """Return where a joint is."""
        return self.engine.joint(f"rig::{joint}").position

    def velocity(self, joint: str) -> float:
        """Return how fast a joint moves."""
        return self.engine.joint(f"rig::{joint}").velocity

    def codes(self) -> list[str]:
        """Return the codes of what was reported by the control layer."""
        return [item.code for item in self.diagnostics if item.code.startswith("control.")]


def _rig(parts: Sequence[str], gravity: bool) -> Rig:
    diagnostics = Diagnostics()
    model = read_urdf(urdf(*parts), context=ReadContext(None, diagnostics, "rig.urdf"))
    assert model is not None
    world = World(models=(model,), gravity_m_s2=(0.0, 0.0, -9.8 if gravity else 0.0))
    return Rig(Engine(world, diagnostics=diagnostics), model, diagnostics)


def ros1_rig(
    *parts: str, parameters: Mapping[str, Any] | None = None, gravity: bool = False, **options: Any
) -> Rig:
    """Return a ROS 1 robot in namespace ``/rig``; `parameters` are those of the namespace."""
    rig = _rig(parts, gravity)
    store = LocalParameters()
    if parameters:
        store.set("/rig", dict(parameters))
    source = StoreSource(store, "/rig")
    rig.robot = build_ros1_robot(rig, rig.model, source, RobotParameters(store, "/rig"), **options)
    return rig


def ros2_rig(
    *parts: str, is_gz: bool = False, hold: bool = True, gravity: bool = False, **options: Any
) -> Rig:
    """Return a ROS 2 robot with a control loop of 100 Hz."""
    rig = _rig(parts, gravity)
    rig.period = 10
    chosen = SystemOptions(is_gz, hold, 0.1, 100.0)
    rig.robot = build_ros2_robot(rig, rig.model, chosen, **options)
    return rig


def block(
    *joints: str, plugin: str = "gazebo_ros2_control/GazeboSystem", parameters: str = ""
) -> str:
    """Return a ``<ros2_control>`` block."""
    return f"""<ros2_control name="hw" type="system"><hardware><plugin>{plugin}</plugin>
    {parameters}</hardware>{"".join(joints)}</ros2_control>"""


def joint(
    name: str, commands: Sequence[str] = ("position",), states: str = "", more: str = ""
) -> str:
    """Return a joint of a block; states are position, velocity and effort by default."""
    made = "".join(f'<command_interface name="{item}"/>' for item in commands)
    words = ("position", "velocity", "effort")
    states = states or "".join(f'<state_interface name="{item}"/>' for item in words)
    return f'<joint name="{name}">{made}{states}{more}</joint>'
