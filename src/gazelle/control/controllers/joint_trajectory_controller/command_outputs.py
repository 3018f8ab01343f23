"""How a trajectory becomes commands: handed on as it is, or through one PID for each joint."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Protocol

from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.errors import ControllerError
from gazelle.control.interface_values import Array, Indices
from gazelle.control.pid import AntiWindup, PidArray, PidGains, offer_live_gains, read_gains
from gazelle.parameters.trees import flattened

__all__ = ["Forwarding", "PidOutput", "TrajectoryOutput", "report_idle_gains"]

_ROWS = {"position": 0, "velocity": 1, "acceleration": 2}
_SECONDS = 1e-9


class TrajectoryOutput(Protocol):
    """Writes the commands of a trajectory controller."""

    @property
    def commands(self) -> tuple[str, ...]:
        """Command interfaces it writes."""
        ...

    @property
    def is_closed_loop(self) -> bool:
        """Whether commands depend on errors, so it must run at every update."""
        ...

    def start(self, position: Array) -> None:
        """Begin at a place (N,)."""
        ...

    def write(self, desired: Array, effort: Array | None, error: Array, period_ns: int) -> None:
        """Command a state (3, N) with efforts (N,), from which joints differ by errors (3, N)."""
        ...

    def stop(self) -> None:
        """Command nothing more: velocities, accelerations and efforts become 0."""
        ...

    def commanded(self) -> dict[str, Array]:
        """Return the present commands by interface, (M,) of the M joints it commands, in order."""
        ...


class Forwarding:
    """Hands positions, velocities, accelerations and efforts on as they are."""

    is_closed_loop = False

    def __init__(
        self,
        context: ControllerContext,
        names: Sequence[str],
        interfaces: Sequence[str],
        columns: Indices | None = None,
    ) -> None:
        """Look up interfaces.

        Args:
            context: of the controller.
            names: joints to command.
            interfaces: of each joint.
            columns: which of the controller's joints they are, None for all of them.
        """
        self._interface_values = context.robot.interface_values
        self._interfaces = tuple(interfaces)
        self._indices = _indices(context, names, interfaces)
        self._columns = columns
        self.commands = _names(names, interfaces)

    def start(self, position: Array) -> None:
        """Command the positions (N,), and no velocities, accelerations or efforts."""
        self.stop()
        if "position" in self._indices:
            self._interface_values.commands[self._indices["position"]] = self._some(position)

    def write(self, desired: Array, effort: Array | None, error: Array, period_ns: int) -> None:
        """Hand the desired state (3, N) and efforts (N,) on; errors (3, N) do not matter."""
        commands = self._interface_values.commands
        for interface, indices in self._indices.items():
            row = _ROWS.get(interface)
            if row is not None:
                commands[indices] = self._some(desired[row])
            elif effort is not None:
                commands[indices] = self._some(effort)

    def stop(self) -> None:
        """Leave positions, set the rest to 0."""
        for interface, indices in self._indices.items():
            if interface != "position":
                self._interface_values.commands[indices] = 0.0

    def commanded(self) -> dict[str, Array]:
        """Return the present commands, (M,) by interface."""
        return {
            name: self._interface_values.commands[indices]
            for name, indices in self._indices.items()
        }

    def _some(self, values: Array) -> Array:
        return values if self._columns is None else values[self._columns]


class PidOutput:
    """Commands velocities or efforts: feed-forward of the velocity plus a PID on the error."""

    is_closed_loop = True

    def __init__(
        self,
        context: ControllerContext,
        names: Sequence[str],
        interface: str,
        feed_forward: Array,
        columns: Indices | None = None,
    ) -> None:
        """Read the gains and offer to change them live.

        Args:
            context: of the controller.
            names: joints to command.
            interface: ``velocity`` or ``effort``.
            feed_forward: of each of them.
            columns: which of the controller's joints they are, None for all of them.

        Raises:
            ControllerError: a ROS 1 controller has no gains for a joint.
        """
        self._interface_values = context.robot.interface_values
        self._interface = interface
        self._indices = _indices(context, names, (interface,))
        self._columns = columns
        self.commands = _names(names, (interface,))
        self.set_feed_forward(feed_forward)
        self._names = tuple(names)
        self._pids = PidArray([_gains(context, name) for name in names])
        separator = "/" if context.ros_version == 1 else "."
        self._live = [
            offer_live_gains(context, f"gains{separator}{name}", (self._pids, index))
            for index, name in enumerate(names)
        ]

    def set_feed_forward(self, feed_forward: Array) -> None:
        """Change what desired velocities are multiplied with, (N,)."""
        self._feed_forward, self._feeds = feed_forward, bool(feed_forward.any())

    def set_gain(self, name: str, word: str, value: Any) -> None:
        """Change what `offer_live_gains` does not: ``i_clamp`` and the newer strategies."""
        if name not in self._names:
            return
        index = self._names.index(name)
        changes: dict[str, Any] = {word: value}
        if word == "i_clamp":
            changes = {"i_max": abs(value), "i_min": -abs(value)}
            self._live[index].update({"i_clamp_max": abs(value), "i_clamp_min": -abs(value)})
        elif word == "antiwindup_strategy":
            changes = {"strategy": AntiWindup(value)}
        self._pids.set_gains(index, replace(self._pids.gains[index], **changes))

    def start(self, position: Array) -> None:
        """Forget errors and integrals, command 0; positions (N,) are not looked at."""
        self._pids.reset()
        self.stop()

    def write(self, desired: Array, effort: Array | None, error: Array, period_ns: int) -> None:
        """Compute the commands.

        Args:
            desired: positions, velocities, accelerations (3, N), rad or m.
            effort: (N,) added to the commands; None for none.
            error: desired - actual (3, N).
            period_ns: since the last call.
        """
        if self._columns is not None:
            desired, error = desired[:, self._columns], error[:, self._columns]
            effort = None if effort is None else effort[self._columns]
        command = self._pids.compute(error[0], period_ns * _SECONDS, error[1])
        if self._feeds:
            command += desired[1] * self._feed_forward
        if effort is not None:
            command += effort
        indices = self._indices[self._interface]
        self._interface_values.commands[indices] = command
        self._interface_values.answer(indices, *self._pids.stiffness_and_damping)

    def stop(self) -> None:
        """Command 0."""
        self._interface_values.commands[self._indices[self._interface]] = 0.0

    def commanded(self) -> dict[str, Array]:
        """Return the present commands, (M,) by interface."""
        return {
            name: self._interface_values.commands[indices]
            for name, indices in self._indices.items()
        }


def report_idle_gains(context: ControllerContext) -> None:
    """Say once that gains change nothing when positions are commanded."""
    parameters = context.parameters
    found = [name for name, _ in flattened({"gains": parameters.group("gains")})]
    # Whether a joint wraps stands below gains too, and has an effect.
    idle = [name for name in found if not name.endswith(("angle_wraparound", "normalize_error"))]
    if not idle or idle == ["gains"]:
        return
    text = f"'{parameters.full_name('gains')}' has no effect: with the position interface the "
    text += "trajectory's positions are commanded as they are, no PID is computed"
    fix = "command 'effort' or 'velocity' to use the gains, or remove them"
    parameters.report("control.idle-gains", text, key="gains", fix=fix)


def _gains(context: ControllerContext, name: str) -> PidGains:
    found = read_gains(context.parameters, "gains", name, ros_version=context.ros_version)
    if found is not None:
        return found
    if context.ros_version == 2:
        return PidGains()
    where = context.parameters.full_name(f"gains.{name}")
    text = f"controller '{context.name}': No p gain specified for pid. Namespace: {where} "
    raise ControllerError(f"{text}(Failed to initialize PID gains from ROS parameter server.)")


def _indices(
    context: ControllerContext, names: Sequence[str], interfaces: Sequence[str]
) -> dict[str, Indices]:
    return {
        interface: context.command_indices([f"{name}/{interface}" for name in names])
        for interface in interfaces
    }


def _names(names: Sequence[str], interfaces: Sequence[str]) -> tuple[str, ...]:
    return tuple(f"{name}/{interface}" for name in names for interface in interfaces)
