"""Gazebo's ``gazebo_ros_control/DefaultRobotHWSim`` (noetic): joints driven directly."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING

from gazelle.control.hardware.engine_joints import JOINT_STATES, JointStates
from gazelle.control.hardware.ros1_joint_group import Ros1Section
from gazelle.control.hardware.ros1_joint_setup import Ros1Joint
from gazelle.control.hardware.sensor_states import SensorStates
from gazelle.control.interface_values import InterfaceValues
from gazelle.control.pid import PidArray, PidGains
from gazelle.control.resource_manager import JointResource

if TYPE_CHECKING:
    from gazelle.engine import Engine

__all__ = ["DefaultRobotHWSim"]


class DefaultRobotHWSim:
    """The joints of a ROS 1 robot.

    Commands start at 0, as in the original; joints to be held stay where they were spawned until
    a controller claims them. Limits are enforced on the command itself, which controllers can
    see, over the length of a physics step, since Gazebo writes at every step. Transmissions do
    not act: the joints are driven directly.

    Args:
        engine: the physics.
        interface_values: takes the interfaces.
        model: name of the model in the world.
        joints: in the order of the transmissions.
        gains: of the position and velocity joints that have some, by name.
        sensors: what the model measures besides its joints, which the original does not offer.
        held: joints to hold until they are claimed.
        plugin: class that the file names.

    Attributes:
        sections: joints by the way they are commanded.
    """

    name = "RobotHWSim"
    type = "system"

    def __init__(
        self,
        engine: Engine,
        interface_values: InterfaceValues,
        model: str,
        joints: Sequence[Ros1Joint],
        *,
        sensors: SensorStates,
        gains: Mapping[str, PidGains] | None = None,
        held: Collection[str] = (),
        plugin: str = "gazebo_ros_control/DefaultRobotHWSim",
    ) -> None:
        self.plugin = plugin
        self.joints: tuple[JointResource, ...] = tuple(joint.resource() for joint in joints)
        self.sensors = sensors
        self._engine = engine
        self._states = JointStates(
            engine, interface_values, model, [(joint.name, JOINT_STATES) for joint in joints]
        )
        self.sections = tuple(_sections(engine, interface_values, model, joints, gains or {}))
        self._to_hold = frozenset(held)
        self._claimed: set[str] = set()
        self._written_ns = -1

    @property
    def writes_every_step(self) -> bool:
        """True with PIDs: they run at every step, on the states last read."""
        return any(section.pids is not None for section in self.sections)

    def start(self) -> None:
        """Hold what is to be held; called once the interfaces are frozen."""
        self._states.read()
        for section in self.sections:
            section.hold(self._to_hold - self._claimed, self._states.position)

    def read(self, time_ns: int, period_ns: int) -> None:
        """Measure."""
        self._states.read()
        self.sensors.read()

    def write(self, time_ns: int, period_ns: int) -> None:
        """Enforce limits, run PIDs, command the joints."""
        step_ns = self._engine.step_ns
        is_new = time_ns != self._written_ns
        self._written_ns = time_ns
        steps = max(1, period_ns // step_ns)
        for section in self.sections:
            section.write(self._states, step_ns * 1e-9, steps, is_new=is_new)

    def check_switch(self, start: frozenset[str], stop: frozenset[str]) -> str:
        """Return nothing: a joint has one interface, so no switch can be wrong."""
        return ""

    def switch(self, start: frozenset[str], stop: frozenset[str]) -> None:
        """Let go of joints claimed for the first time; released joints keep their last command."""
        names = {name.rpartition("/")[0] for name in start}
        self._claimed |= names
        for section in self.sections:
            section.free(names)

    def set_stop(self, active: bool) -> None:
        """Begin or end an emergency stop: no effort, no speed, positions stay."""
        for section in self.sections:
            section.stop(active, self._states.position)

    def reset(self) -> None:
        """Start over after the world was reset."""
        self._written_ns = -1
        for section in self.sections:
            section.reset()
        self.start()


def _sections(
    engine: Engine,
    interface_values: InterfaceValues,
    model: str,
    joints: Sequence[Ros1Joint],
    gains: Mapping[str, PidGains],
) -> list[Ros1Section]:
    made = []
    for interface in ("effort", "position", "velocity"):
        mine = [index for index, joint in enumerate(joints) if joint.interface == interface]
        with_pids = [index for index in mine if joints[index].name in gains]
        without = [index for index in mine if index not in with_pids]
        if without:
            made.append(Ros1Section(engine, interface_values, model, joints, without, None))
        if with_pids:
            pids = PidArray(tuple(gains[joints[index].name] for index in with_pids))
            made.append(Ros1Section(engine, interface_values, model, joints, with_pids, pids))
    return made
