"""Joints of ``<ros2_control>`` blocks: interfaces, limits, mimics and gains."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from gazelle.control.hardware.engine_joints import JOINT_STATES
from gazelle.control.hardware.ros2_tags import HardwareTag, InterfaceTag, PartTag
from gazelle.control.joint_limits import limits_of
from gazelle.control.pid import AntiWindup, PidGains
from gazelle.control.resource_manager import HardwareHost, JointLimits, JointResource
from gazelle.description.model import JointType, Model
from gazelle.diagnostics import did_you_mean

__all__ = ["Ros2Joint", "Ros2Mimic", "read_mimics", "read_ros2_joints", "resource_of"]

_GAZEBO_COMMANDS = ("position", "velocity", "effort")
_GAIN_WORDS = ("kp", "ki", "kd", "max_integral_error", "min_integral_error")


class Ros2Mimic(NamedTuple):
    """``position = offset + multiplier · position(leader)``.

    Attributes:
        is_physical: the description has a ``<mimic>``: the physics couples the joints itself.
    """

    joint: str
    leader: str
    multiplier: float
    offset: float
    is_physical: bool


@dataclass(frozen=True, slots=True)
class Ros2Joint:
    """A joint of simulated hardware.

    Attributes:
        commands: by interface, with the bounds of its commands.
        states: interfaces that can be read.
        gains: of ``position`` and ``velocity`` commands that PIDs turn into efforts.
    """

    name: str
    commands: Mapping[str, InterfaceTag]
    states: Mapping[str, InterfaceTag]
    limits: JointLimits
    is_continuous: bool
    gains: Mapping[str, PidGains]

    def resource(self) -> JointResource:
        """Return it as controllers see it."""
        return JointResource(
            self.name,
            tuple(self.commands),
            tuple(self.states),
            (),
            self.is_continuous,
            self.limits,
        )


def resource_of(part: PartTag, model: Model) -> JointResource:
    """Return a joint of hardware that needs no physics."""
    joint = model.joint(part.name)
    return JointResource(
        part.name,
        tuple(item.name for item in part.commands),
        tuple(item.name for item in part.states),
        (),
        joint is not None and joint.type is JointType.CONTINUOUS,
        JointLimits() if joint is None else limits_of(joint),
    )


def read_ros2_joints(
    host: HardwareHost, model: Model, tag: HardwareTag, gains: Mapping[str, Any]
) -> tuple[Ros2Joint, ...]:
    """Return the joints of a block that the simulated model has.

    Args:
        host: where to report, and the physics.
        model: as it is in the world.
        tag: the block.
        gains: ``pid_gains`` of the plug-in's node.
    """
    found = []
    for part in tag.of_kind("joint"):
        if _exists(host, model, tag, part):
            found.append(_read_joint(host, model, part, gains))
    return tuple(found)


def read_mimics(host: HardwareHost, model: Model, tag: HardwareTag) -> tuple[Ros2Mimic, ...]:
    """Return which joints of a block follow others.

    Since Jazzy ``<mimic>`` of the joint counts; before, the parameters ``mimic`` and
    ``multiplier`` of the block's joint did. Either is taken.
    """
    names = [part.name for part in tag.of_kind("joint")]
    found = []
    for part in tag.of_kind("joint"):
        joint = model.joint(part.name)
        described = None if joint is None or not part.may_mimic else joint.mimic
        leader = part.parameters.get("mimic", "")
        if described is not None:
            row = (described.joint, described.multiplier, described.offset)
            found.append(Ros2Mimic(part.name, *row, is_physical=True))
        elif leader in names:
            row = (
                leader,
                _number(host, part, "multiplier", 1.0),
                _number(host, part, "offset", 0.0),
            )
            found.append(Ros2Mimic(part.name, *row, is_physical=False))
        elif leader:
            text = f"joint '{part.name}' of '{tag.name}' mimics '{leader}', which is not a joint of"
            text += f" the block; it does not follow (Mimicked joint '{leader}' not found)"
            hint = did_you_mean(leader, names)
            host.diagnostics.report("control.ros2-control-mimic", text, part.span, fix=hint)
    return tuple(found)


def _exists(host: HardwareHost, model: Model, tag: HardwareTag, part: PartTag) -> bool:
    joint = model.joint(part.name)
    if joint is not None and host.engine.joint(f"{model.name}::{part.name}").is_driveable:
        return True
    text = f"hardware '{tag.name}' has joint '{part.name}', which "
    hint = ""
    if joint is None:
        text += f"model '{model.name}' does not have; it is left out (Skipping joint in the URDF"
        text += f" named '{part.name}' which is not in the gazebo model.)"
        hint = did_you_mean(part.name, [item.name for item in model.joints if item.axis])
    else:
        text += f"is {joint.type.value} and cannot be driven; it is left out"
    host.diagnostics.report("control.hardware-joint", text, part.span, fix=hint)
    return False


def _read_joint(
    host: HardwareHost, model: Model, part: PartTag, parameters: Mapping[str, Any]
) -> Ros2Joint:
    joint = model.joint(part.name)
    assert joint is not None
    commands: dict[str, InterfaceTag] = {}
    gains: dict[str, PidGains] = {}
    for item in part.commands:
        name = item.name.removesuffix("_pid")
        if name not in _GAZEBO_COMMANDS or name in commands:
            _report_interface(host, part, "command", item, _GAZEBO_COMMANDS)
            continue
        commands[name] = item
        found = None if name == "effort" else _gains(host, part, item.name, parameters)
        if found is not None:
            gains[name] = found
    states = {item.name: item for item in part.states if item.name in JOINT_STATES}
    for item in part.states:
        if item.name not in states:
            _report_interface(host, part, "state", item, JOINT_STATES)
    is_continuous = joint.type is JointType.CONTINUOUS
    return Ros2Joint(part.name, commands, states, limits_of(joint), is_continuous, gains)


def _report_interface(
    host: HardwareHost, part: PartTag, kind: str, item: InterfaceTag, known: Sequence[str]
) -> None:
    text = f"{part.kind} '{part.name}' has the {kind} interface '{item.name}', which simulated "
    text += f"hardware does not offer or has already ({', '.join(known)}); it is left out"
    hint, span = did_you_mean(item.name, known), item.span or part.span
    host.diagnostics.report("control.ros2-control-interface", text, span, fix=hint)


def _gains(
    host: HardwareHost, part: PartTag, interface: str, parameters: Mapping[str, Any]
) -> PidGains | None:
    """Return the gains of a position or velocity command.

    They stand in the block as ``pos_kp``, ``vel_kp`` …, or in the parameters of the plug-in's
    node as ``pid_gains.<interface>.<joint>.kp`` (gazebo_ros2_control, Humble and later).
    """
    prefix = "pos_" if interface.startswith("position") else "vel_"
    if any(f"{prefix}{word}" in part.parameters for word in _GAIN_WORDS[:3]):
        values = {
            word: _number(host, part, f"{prefix}{word}", 0.0)
            for word in _GAIN_WORDS
            if f"{prefix}{word}" in part.parameters
        }
    else:
        group = parameters.get(interface, {})
        tree = group.get(part.name, {}) if isinstance(group, Mapping) else {}
        values = {
            word: float(tree[word])
            for word in _GAIN_WORDS
            if isinstance(tree, Mapping) and isinstance(tree.get(word), int | float)
        }
        if not {"kp", "ki", "kd"} <= set(values):
            return None
    largest = 1.7976931348623157e308
    return PidGains(
        values.get("kp", 0.0),
        values.get("ki", 0.0),
        values.get("kd", 0.0),
        i_max=values.get("max_integral_error", largest),
        # The original's default is the smallest positive number, meant as the most negative one.
        i_min=values.get("min_integral_error", -largest),
        strategy=AntiWindup.LEGACY,
    )


def _number(host: HardwareHost, part: PartTag, key: str, default: float) -> float:
    text = part.parameters.get(key)
    if text is None:
        return default
    try:
        return float(text)
    except ValueError:
        message = f"parameter '{key}' of {part.kind} '{part.name}' is '{text}', not a number;"
        message += f" {default:g} is used"
        host.diagnostics.report("control.ros2-control-value", message, part.span)
        return default
