"""Robot, joints, node and times as a user's controller sees them, by names of ROS and PR2."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.control.controller_node_interface import PublisherPort
from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.errors import ControllerError
from gazelle.control.interface_values import InterfaceValues
from gazelle.diagnostics import did_you_mean
from gazelle.interfaces import Duration, Time

if TYPE_CHECKING:
    from gazelle.control.pid import Pid as ControlPid
    from gazelle.control.pid import PidGains

__all__ = ["ControlPeriod", "ControlTime", "UserJoint", "UserNode", "UserRobot"]


_NS = 1_000_000_000


class ControlTime(Time):
    """A moment of simulated time: ``to_sec()``, ``secs``, ``nsecs``, ``float()``."""

    __slots__ = ()

    @classmethod
    def of(cls, time_ns: int) -> ControlTime:
        """Return the time of so many nanoseconds."""
        return cls(*divmod(time_ns, _NS))

    def __float__(self) -> float:
        return self.to_sec()


class ControlPeriod(Duration):
    """The time since the last update: ``to_sec()``, ``secs``, ``nsecs``, ``float()``."""

    __slots__ = ()

    @classmethod
    def of(cls, period_ns: int) -> ControlPeriod:
        """Return the period of so many nanoseconds."""
        return cls(*divmod(period_ns, _NS))

    def __float__(self) -> float:
        return self.to_sec()


_REQUIRED: Any = object()


class UserJoint:
    """One joint: what is measured, and the command that the controller gives.

    Units: rad, rad/s, N·m; m, m/s, N for prismatic joints.
    """

    __slots__ = ("_command", "_indices", "_interface_values", "interface", "name")

    def __init__(self, interface_values: InterfaceValues, name: str, interface: str) -> None:
        """Take a joint; `interface` is what it is commanded by, empty for nothing."""
        self.name = name
        self.interface = interface
        self._interface_values = interface_values
        self._command = interface_values.command_index[f"{name}/{interface}"] if interface else -1
        self._indices: dict[str, int] = {}

    @property
    def position(self) -> float:
        """Position measured."""
        return self._state("position")

    @property
    def velocity(self) -> float:
        """Velocity measured."""
        return self._state("velocity")

    @property
    def effort(self) -> float:
        """Effort measured; setting it commands an effort."""
        return self._state("effort")

    @effort.setter
    def effort(self, value: float) -> None:
        if self.interface != "effort":
            taken = f"by '{self.interface}'" if self.interface else "by nothing"
            raise ControllerError(f"joint '{self.name}' is commanded {taken}, not by 'effort'")
        self.set_command(value)

    @property
    def command(self) -> float:
        """The last command, NaN for none."""
        return (
            self._interface_values.commands.item(self._command)
            if self._command >= 0
            else float("nan")
        )

    @command.setter
    def command(self, value: float) -> None:
        self.set_command(value)

    def set_command(self, value: float) -> None:
        """Command the joint by its interface."""
        if self._command < 0:
            raise ControllerError(f"joint '{self.name}' has no command interface")
        self._interface_values.commands[self._command] = value

    # pr2_mechanism_model::JointState.
    @property
    def position_(self) -> float:
        """Position measured."""
        return self.position

    @property
    def velocity_(self) -> float:
        """Velocity measured."""
        return self.velocity

    @property
    def measured_effort_(self) -> float:
        """Effort measured."""
        return self._state("effort")

    @property
    def commanded_effort_(self) -> float:
        """The effort commanded."""
        return self.command

    @commanded_effort_.setter
    def commanded_effort_(self, value: float) -> None:
        self.effort = value

    def _state(self, interface: str) -> float:
        index = self._indices.get(interface)
        if index is None:
            name = f"{self.name}/{interface}"
            if name not in self._interface_values.state_index:
                raise ControllerError(f"joint '{self.name}' has no state interface '{interface}'")
            index = self._indices[interface] = int(self._interface_values.state_indices([name])[0])
        return self._interface_values.states.item(index)


class UserRobot:
    """The robot in `init`: joints that are asked for are claimed by the controller."""

    def __init__(
        self, context: ControllerContext, wishes: tuple[str, ...], now_ns: Callable[[], int]
    ) -> None:
        """Offer the joints of the hardware.

        Args:
            context: of the controller.
            wishes: command interfaces that the class names, such as ``wheel/velocity``.
            now_ns: the time of now.
        """
        self._context = context
        self._wishes = dict(wish.rpartition("/")[::2] for wish in wishes)
        self._joints: dict[str, UserJoint] = {}
        self._now_ns = now_ns
        self._open = True
        for wish in wishes:
            context.command_indices((wish,))

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Names of all joints of the hardware."""
        return tuple(self._context.robot.joints)

    def joint(self, name: str) -> UserJoint:
        """Return a joint and claim its command: the class's wish, effort, or its first interface.

        Raises:
            ControllerError: there is no such joint, or `init` is over.
        """
        if name in self._joints:
            return self._joints[name]
        resource = self._context.joint(name)
        if not self._open:
            raise ControllerError(f"joint '{name}' must be taken in init(), not later")
        offered = resource.command_interfaces
        interface = self._wishes.get(name) or (
            "effort" if "effort" in offered else next(iter(offered), "")
        )
        made = self._joints[name] = UserJoint(self._context.robot.interface_values, name, interface)
        return made

    def get_joint_state(self, name: str) -> UserJoint | None:
        """Return a joint as `joint` does, None when there is none, as PR2's does."""
        return self.joint(name) if name in self._context.robot.joints else None

    def get_time(self) -> ControlTime:
        """Return the time of now."""
        return ControlTime.of(self._now_ns())

    getJointState = get_joint_state  # noqa: N815 - pr2_mechanism_model's name
    getTime = get_time  # noqa: N815 - pr2_mechanism_model's name

    def close_claims(self) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """End `init`; return the command and state interfaces that were taken."""
        self._open = False
        interface_values = self._context.robot.interface_values
        taken = [f"{one.name}/{one.interface}" for one in self._joints.values() if one.interface]
        taken += [f"{name}/{interface}" for name, interface in self._wishes.items()]
        states = [
            f"{name}/{interface}"
            for name in self._joints
            for interface in ("position", "velocity")
            if f"{name}/{interface}" in interface_values.state_index
        ]
        return tuple(dict.fromkeys(taken)), tuple(states)


class UserNode:
    """The controller's node handle: parameters, topics and log in its own namespace."""

    def __init__(self, context: ControllerContext, now_ns: Callable[[], int]) -> None:
        """Offer what the ports have."""
        self._context = context
        self._now_ns = now_ns
        self._publishers: dict[str, PublisherPort] = {}

    @property
    def name(self) -> str:
        """Name of the controller."""
        return self._context.name

    def get_param(self, name: str, default: Any = _REQUIRED) -> Any:
        """Return a parameter such as ``pid_steer/p``, or a whole group as a dictionary.

        Raises:
            ControllerError: it is not there and no default was given.
        """
        parameters = self._context.parameters
        key = name.removeprefix("~").strip("/").replace("/", ".")
        found = parameters.raw(key, _REQUIRED) if not name.startswith("/") else _REQUIRED
        if found is not _REQUIRED:
            return found
        if default is not _REQUIRED:
            return default
        hint = did_you_mean(key, parameters.tree) or "there are: " + (
            ", ".join(parameters.tree) or "none"
        )
        raise ControllerError(f"parameter '{parameters.full_name(key)}' is not set; {hint}")

    def read_gains(self, group: str) -> PidGains | None:
        """Return the gains of a PID below a parameter, None when there is no ``p``."""
        from gazelle.control.pid import read_gains

        key = group.strip("~/").replace("/", ".")
        return read_gains(self._context.parameters, key, ros_version=self._context.ros_version)

    def offer_live_gains(self, group: str, pid: ControlPid) -> None:
        """Let others change the gains of a PID while the controller runs."""
        from gazelle.control.pid import offer_live_gains

        offer_live_gains(self._context, group.strip("~/"), pid)

    def has_param(self, name: str) -> bool:
        """Tell whether a parameter or group is there."""
        return self.get_param(name, None) is not None

    def get_namespace(self) -> str:
        """Return the controller's namespace, such as ``/mira/my_controller``."""
        return "/" + "/".join(filter(None, (self._context.namespace, self._context.name)))

    def getParam(self, name: str, default: Any = None) -> Any:
        """Return a parameter, `default` when it is not there."""
        return self.get_param(name, default)

    hasParam = has_param  # noqa: N815 - ROS' C++ name
    getNamespace = get_namespace  # noqa: N815 - ROS' C++ name

    def message(self, type_name: str, **fields: Any) -> Any:
        """Return a message of a type such as ``std_msgs/Float64``."""
        from gazelle.interfaces import message_type

        return message_type(type_name)(**fields)

    def advertise(self, topic: str, message_type: Any, *, latch: bool = False) -> PublisherPort:
        """Offer a topic; relative names lie below the controller's."""
        made = self._publishers.get(topic)
        if made is None:
            name = _type_name(message_type)
            made = self._context.ports.publisher(_own(topic), name, latch=latch)
            self._publishers[topic] = made
        return made

    def publish(self, topic: str, message: Any) -> None:
        """Send a message; the topic is offered with the first one."""
        self.advertise(topic, type(message)).publish(message)

    def subscribe(self, topic: str, message_type: Any, callback: Callable[[Any], None]) -> None:
        """Listen; `callback` runs between two updates."""
        self._context.ports.subscription(_own(topic), _type_name(message_type), callback)

    def now(self) -> ControlTime:
        """Return the time of now."""
        return ControlTime.of(self._now_ns())

    def log_debug(self, text: str) -> None:
        """Log a detail."""
        self._context.ports.log("debug", text)

    def log_info(self, text: str) -> None:
        """Log what goes on."""
        self._context.ports.log("info", text)

    def log_warn(self, text: str) -> None:
        """Log a warning."""
        self._context.ports.log("warn", text)

    def log_error(self, text: str) -> None:
        """Log an error."""
        self._context.ports.log("error", text)


def _own(topic: str) -> str:
    """A node handle of a controller starts at the controller's name."""
    return topic if topic.startswith(("/", "~")) else f"~/{topic}"


def _type_name(message_type: Any) -> str:
    if isinstance(message_type, str):
        return message_type
    name = getattr(message_type, "TYPE_NAME", "") or getattr(message_type, "_type", "")
    if not name:
        raise ControllerError(f"{message_type!r} is not a message type")
    return str(name)
