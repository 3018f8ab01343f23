"""What every controller is: made from a context, then started, updated and stopped."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from gazelle.control.controller_node_interface import Ports
from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.errors import ControllerError
from gazelle.control.interface_values import Indices
from gazelle.control.resource_manager import JointResource, Robot
from gazelle.deprecation import warn_renamed
from gazelle.diagnostics import did_you_mean
from gazelle.parameters.reader import ParameterReader

__all__ = ["Controller", "ControllerContext"]


@dataclass(frozen=True, slots=True)
class ControllerContext:
    """What a controller is made from.

    Attributes:
        name: its name, relative to the manager's namespace.
        type: the type as the user wrote it.
        robot: interfaces and joints.
        parameters: its own.
        ports: the outside world.
        update_rate_hz: how often `update` will be called.
        namespace: of the controller manager, without slashes at its ends; empty for the root.
    """

    name: str
    type: str
    robot: Robot
    parameters: ParameterReader
    ports: Ports
    update_rate_hz: float
    namespace: str = ""

    @property
    def ros_version(self) -> int:
        """1 for ros_control, 2 for ros2_control."""
        return self.robot.ros_version

    @property
    def generation(self) -> int:
        """The old name of `ros_version`."""
        warn_renamed("ControllerContext.generation", "ros_version", gone_in="0.3.0")
        return self.ros_version

    def joint(self, name: str) -> JointResource:
        """Return a joint of the hardware.

        Raises:
            ControllerError: the hardware has no such joint; the message has the nearest names.
        """
        found = self.robot.joints.get(name)
        if found is not None:
            return found
        raise ControllerError(self._no_joint(name))

    def command_indices(self, names: Sequence[str]) -> Indices:
        """Return the indices, (n,), of command interfaces such as ``joint_1/effort``.

        Raises:
            ControllerError: one is not there; the message says what is.
        """
        known = self.robot.interface_values.command_index
        self._check(names, known, "command")
        return self.robot.interface_values.command_indices(names)

    def state_indices(self, names: Sequence[str]) -> Indices:
        """Return the indices, (n,), of state interfaces.

        Raises:
            ControllerError: one is not there; the message says what is.
        """
        known = self.robot.interface_values.state_index
        self._check(names, known, "state")
        return self.robot.interface_values.state_indices(names)

    def _check(self, names: Sequence[str], known: dict[str, int], kind: str) -> None:
        for name in names:
            if name in known:
                continue
            owner, _, interface = name.rpartition("/")
            if owner not in self.robot.joints and owner not in self.robot.sensors:
                raise ControllerError(self._no_joint(owner))
            there = [item.rpartition("/")[2] for item in known if item.startswith(f"{owner}/")]
            text = f"controller '{self.name}' needs {kind} interface '{name}'; '{owner}' has "
            text += f"{', '.join(there)}" if there else f"no {kind} interface"
            if self.ros_version == 1 and kind == "command":
                text += f" (Could not find resource '{owner}' in "
                text += f"'hardware_interface::{interface.capitalize()}JointInterface')"
            raise ControllerError(text)

    def _no_joint(self, name: str) -> str:
        if name in self.robot.absent:
            text = f"controller '{self.name}' cannot run without '{name}': hardware "
            return f"{text}'{self.robot.absent[name]}', which has it, was not loaded (see above)"
        names = [*self.robot.joints, *self.robot.sensors]
        hint = did_you_mean(name, names) or f"there are: {', '.join(names) or 'none'}"
        if name in {joint.name for joint in self.robot.model.joints}:
            given = "<transmission>" if self.ros_version == 1 else "<ros2_control> block"
            hint = f"the robot has it, but no {given} gives it to controllers"
        text = f"controller '{self.name}': the hardware has no joint or sensor '{name}'; {hint}"
        if self.ros_version == 1:
            text += f" (Could not find resource '{name}')"
        return text


class Controller:
    """Base of the controllers.

    Making one is what ros_control calls ``init`` and ros2_control ``on_configure``: parameters
    are read, topics offered, interfaces looked up; `ControllerError` says why that fails.

    Attributes:
        TABLE: what the documentation says.
        has_table: the table has all its parameters, so others of its tree are unknown; what a
            user's own class reads, it alone knows.
        commands: command interfaces it claims while active.
        states: state interfaces it reads.
        takes_all_states: it reads whatever is there, so none of them has to be.
    """

    TABLE: ClassVar[ControllerTable]
    has_table: ClassVar[bool] = True
    takes_all_states: bool = False

    def __init__(self, context: ControllerContext) -> None:
        """Keep the context; subclasses go on from here."""
        self.context = context
        self.robot = context.robot
        self.commands: tuple[str, ...] = ()
        self.states: tuple[str, ...] = ()

    def start(self, time_ns: int) -> None:
        """Begin to command; called before the first `update`."""

    def update(self, time_ns: int, period_ns: int) -> None:
        """Compute commands from states."""

    def stop(self, time_ns: int) -> None:
        """End; leave the commands as the original does."""

    def changed(self, values: dict[str, Any]) -> str:
        """Take over live parameters (names with dots).

        Returns:
            why they are refused, empty when they are taken.
        """
        return ""

    def close(self) -> None:
        """Release what `Ports` does not release by itself."""
