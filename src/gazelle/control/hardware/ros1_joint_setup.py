"""Which joints a ROS 1 robot has and how each is commanded, from its transmissions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from gazelle.control.controller_parameters import controller_parameters
from gazelle.control.hardware.control_description import ControlDescription
from gazelle.control.joint_limits import limits_from_parameters, limits_of
from gazelle.control.parameter_sources.ros1_parameter_server import ParameterSource
from gazelle.control.pid import PidGains, read_gains
from gazelle.control.pid.gains import gain_rows
from gazelle.control.resource_manager import (
    HardwareHost,
    JointLimits,
    JointResource,
    ParameterStore,
)
from gazelle.control.transmissions.transmission import read_transmission
from gazelle.description.model import (
    JointType,
    Model,
    TransmissionJoint,
    TransmissionTag,
)
from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.parameters import ParameterTable
from gazelle.parameters.reader import ParameterReader

__all__ = [
    "GAINS_NAME",
    "HARDWARE_INTERFACES",
    "Ros1Joint",
    "gains_parameters",
    "joints_to_hold",
    "read_joint_gains",
    "read_ros1_joints",
]


HARDWARE_INTERFACES = {
    "EffortJointInterface": "effort",
    "PositionJointInterface": "position",
    "VelocityJointInterface": "velocity",
}

"""What DefaultRobotHWSim knows, without ``hardware_interface/``."""

_PREFIX = "hardware_interface/"

_STATES = ("position", "velocity", "effort")


@dataclass(frozen=True, slots=True)
class Ros1Joint:
    """A joint of the hardware.

    Attributes:
        interface: ``effort``, ``position``, ``velocity``, or empty for one that can only be read.
        type: as the description says; turning joints measure errors around the circle.
    """

    name: str
    interface: str
    type: JointType
    limits: JointLimits

    def resource(self) -> JointResource:
        """Return it as controllers see it."""
        names: tuple[str, ...] = ("hardware_interface/JointStateInterface",)
        if self.interface:
            names = (f"{_PREFIX}{self.interface.capitalize()}JointInterface", *names)
        return JointResource(
            self.name,
            (self.interface,) if self.interface else (),
            _STATES,
            names,
            self.type is JointType.CONTINUOUS,
            self.limits,
        )


def read_ros1_joints(
    host: HardwareHost,
    model: Model,
    description: ControlDescription,
    parameters: ParameterStore,
    namespace: str,
) -> tuple[Ros1Joint, ...]:
    """Return the joints of all transmissions that the simulated model has.

    Args:
        host: where to report, and the physics.
        model: as it is in the world.
        description: joints and transmissions, of the model or of ``robot_description``.
        parameters: ``<namespace>/joint_limits/<joint>`` is read.
        namespace: of the robot, absolute, without a slash at the end.
    """
    reader = _Reader(host, model, description, parameters, namespace)
    return tuple(reader.joints())


def _is_foreign(member: TransmissionJoint) -> bool:
    """Tell a joint whose interfaces are all of other packages than ROS's."""
    names = [name.replace("::", "/") for name in member.hardware_interfaces]
    return bool(names) and all("/" in name and not name.startswith(_PREFIX) for name in names)


class _Reader:
    def __init__(
        self,
        host: HardwareHost,
        model: Model,
        description: ControlDescription,
        parameters: ParameterStore,
        namespace: str,
    ) -> None:
        self._host = host
        self._model = model
        self._description = description
        self._parameters = parameters
        self._namespace = namespace
        self._reduced: list[str] = []
        self._bare: list[str] = []

    def joints(self) -> Iterator[Ros1Joint]:
        seen: dict[str, str] = {}
        for tag in self._description.transmissions:
            self._check(tag)
            for member in tag.joints:
                if not self._exists(tag, member):
                    continue
                if member.name in seen:
                    text = f"joint '{member.name}' is in the transmissions '{seen[member.name]}'"
                    text += f" and '{tag.name}'; the first one counts"
                    self._report("control.transmission-twice", text, tag)
                    continue
                seen[member.name] = tag.name
                yield self._joint(tag, member)
        self._report_idle()

    def _joint(self, tag: TransmissionTag, member: TransmissionJoint) -> Ros1Joint:
        interface = self._interface(tag, member)
        joint = self._description.joints.get(member.name) or self._model.joint(member.name)
        assert joint is not None
        tree = self._parameters.get(f"{self._namespace}/joint_limits/{member.name}", {})
        limits = limits_of(joint)
        if isinstance(tree, dict):
            limits = limits_from_parameters(limits, tree)
        return Ros1Joint(member.name, interface, joint.type, limits)

    def _interface(self, tag: TransmissionTag, member: TransmissionJoint) -> str:
        names = member.hardware_interfaces
        if not names:
            names = tag.actuators[0].hardware_interfaces if tag.actuators else ()
            self._report_missing(tag, member.name, bool(names))
        if len(names) > 1:
            text = f"joint '{member.name}' has the hardware interfaces {', '.join(names)}; the"
            text += " first one is used (specifies multiple hardware interfaces. Currently the"
            text += " default robot hardware simulation interface only supports one.)"
            self._report("control.hardware-interface-extra", text, tag)
        if not names:
            return "effort"
        return self._known(tag, member.name, names[0])

    def _known(self, tag: TransmissionTag, joint: str, name: str) -> str:
        word = name.replace("::", "/").removeprefix(_PREFIX)
        if word in HARDWARE_INTERFACES:
            if word == name:
                self._bare.append(joint)
            return HARDWARE_INTERFACES[word]
        text = f"hardware interface '{name}' of joint '{joint}' is not one that Gazebo's"
        text += f" DefaultRobotHWSim has ({', '.join(HARDWARE_INTERFACES)}); the joint can be read,"
        text += " not commanded (No matching hardware interface found)"
        hint = did_you_mean(word, HARDWARE_INTERFACES)
        self._report("control.hardware-interface-unknown", text, tag, fix=hint)
        return ""

    def _report_missing(self, tag: TransmissionTag, joint: str, has_actuators: bool) -> None:
        if has_actuators:
            text = f"the hardware interface of joint '{joint}' stands in <actuator> of transmission"
            text += f" '{tag.name}'; it belongs into <joint>"
        else:
            text = f"joint '{joint}' of transmission '{tag.name}' has no <hardwareInterface>; it is"
            text += " driven by efforts, as on the PR2 (real ROS: No valid hardware interface"
            text += " element found in joint)"
        self._report("control.hardware-interface-missing", text, tag)

    def _check(self, tag: TransmissionTag) -> None:
        read_transmission(tag, self._host.diagnostics)
        if len(tag.joints) > 1:
            text = f"transmission '{tag.name}' has {len(tag.joints)} joints: each is driven"
            text += " directly (Gazebo: has more than one joint. Currently the default robot"
            text += " hardware simulation interface only supports one.)"
            self._report("control.transmission-joints", text, tag)
        reductions = [joint.mechanical_reduction for joint in tag.joints]
        reductions += [actuator.mechanical_reduction for actuator in tag.actuators]
        if any(reduction not in (0.0, 1.0) for reduction in reductions):
            self._reduced.append(tag.name)

    def _report_idle(self) -> None:
        if self._bare:
            text = f"hardware interfaces of {', '.join(self._bare)} lack '{_PREFIX}'"
            text += " (Deprecated syntax, please prepend 'hardware_interface/')"
            code = "control.hardware-interface-prefix"
            self._host.diagnostics.report(code, text, self._model.span)
        if self._reduced:
            text = "mechanical reductions have no effect on simulated joints, as in Gazebo:"
            text += f" controllers drive the joints themselves ({', '.join(self._reduced)})"
            self._host.diagnostics.report("control.transmission-idle", text, self._model.span)

    def _exists(self, tag: TransmissionTag, member: TransmissionJoint) -> bool:
        name = member.name
        full = f"{self._model.name}::{name}"
        joint = self._model.joint(name)
        if joint is not None and self._host.engine.joint(full).is_driveable:
            return True
        text = f"transmission '{tag.name}' drives joint '{name}', which "
        hint = ""
        if joint is None:
            text += f"model '{self._model.name}' does not have; it is left out, real ROS would not"
            text += " start any controller (This robot has a joint named"
            text += f' "{name}" which is not in the gazebo model.)'
            movable = [item.name for item in self._model.joints if item.axis is not None]
            hint = did_you_mean(name, movable)
        elif _is_foreign(member):
            # It names a place, such as an arm's tip, for hardware of somebody else's.
            return False
        else:
            text += f"is {joint.type.value} and cannot be driven; it is left out"
        span = next((one.span for one in tag.joints if one.name == name), None) or tag.span
        self._host.diagnostics.report("control.hardware-joint", text, span, fix=hint)
        return False

    def _report(self, code: str, text: str, tag: TransmissionTag, *, fix: str = "") -> None:
        self._host.diagnostics.report(code, text, tag.span, fix=fix)


GAINS_NAME = "gazebo_ros_control/pid_gains"


def gains_parameters(
    parameters: ParameterStore, namespace: str, diagnostics: Diagnostics
) -> ParameterReader:
    """Return ``<namespace>/gazebo_ros_control/pid_gains``; keys begin with the joint's name."""
    place = f"{namespace}/{GAINS_NAME}"
    tree = parameters.get(place, {})
    rows = gain_rows("<joint>", (1,))
    table = ParameterTable(GAINS_NAME, "PIDs of simulated joints.", rows=rows)
    return controller_parameters(
        "gazebo_ros_control",
        tree if isinstance(tree, dict) else {},
        table,
        diagnostics,
        full_name=lambda key: f"{place}/{key.replace('.', '/')}",
    )


def read_joint_gains(
    parameters: ParameterReader, model: Model, joints: Sequence[Ros1Joint]
) -> dict[str, PidGains]:
    """Return the gains of the position and velocity joints that have some.

    Position joints without are ideal servos, which is said once.
    """
    found = {}
    ideal = []
    for joint in joints:
        if joint.interface not in {"position", "velocity"}:
            continue
        gains = read_gains(parameters, "", joint.name)
        if gains is not None:
            found[joint.name] = gains
        elif joint.interface == "position":
            ideal.append(joint.name)
    if found:
        parameters.report_unknown()
    if ideal:
        text = f"position joints {', '.join(ideal)} follow their commands whatever it takes: there"
        text += f" are no gains in {parameters.full_name('<joint>')} (No p gain specified for pid)"
        parameters.diagnostics.report("control.ideal-servo", text, model.span)
    return found


# What the types of controllers that keep joints in place have in their names.
_PLACING = ("Position", "Trajectory", "Gripper")


def joints_to_hold(joints: Sequence[Ros1Joint], source: ParameterSource) -> frozenset[str]:
    """Return the joints that a configured controller names, wheels not.

    In Gazebo an arm falls between the spawn and the start of its controllers; here it waits.
    A continuous joint is a wheel unless a controller of positions or trajectories names it.
    """
    named: set[str] = set()
    placed: set[str] = set()
    for controller in source.controllers():
        texts = set(_texts(source.tree(controller)))
        named |= texts
        if any(word in (source.controller_type(controller) or "") for word in _PLACING):
            placed |= texts
    return frozenset(
        joint.name
        for joint in joints
        if joint.interface
        and joint.name in (placed if joint.type is JointType.CONTINUOUS else named)
    )


def _texts(value: Any) -> Iterator[str]:
    """Yield every text in a tree of parameters, and every key: gains go by the joint's name."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, Mapping):
        for key, inner in value.items():
            yield str(key)
            yield from _texts(inner)
    elif isinstance(value, list | tuple):
        for inner in value:
            yield from _texts(inner)
