"""What a robot description offers to controllers, as its tags say."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from gazelle.control.hardware.ros1_joints import HARDWARE_INTERFACES
from gazelle.control.hardware.ros2_tags import read_hardware_tags
from gazelle.control.robot import JointResource
from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.doctor.parameters.controllers import FoundController
from gazelle.parameters.trees import nested

__all__ = ["check_claims", "hardware_of"]

_BY_TYPE = {
    "diff_drive_controller": "velocity",
    "effort_controllers": "effort",
    "position_controllers": "position",
    "velocity_controllers": "velocity",
}
_WHEEL_KEYS = ("left_wheel", "right_wheel", "left_wheel_names", "right_wheel_names")


def hardware_of(model: Model) -> dict[str, JointResource]:
    """Return the joints of ``<ros2_control>`` blocks, or of transmissions when there are none."""
    blocks = read_hardware_tags(model, Diagnostics())
    found: dict[str, JointResource] = {}
    for part in (part for block in blocks for part in block.of_kind("joint")):
        # A joint may stand in several blocks: an actuator's and a sensor's.
        known = found.get(part.name, JointResource(part.name, (), ()))
        commands = (*known.command_interfaces, *(item.name for item in part.commands))
        states = (*known.state_interfaces, *(item.name for item in part.states))
        found[part.name] = JointResource(part.name, commands, states)
    if blocks:
        return found
    for tag in model.transmissions:
        actuators = [name for item in tag.actuators for name in item.hardware_interfaces]
        for joint in tag.joints:
            names = [item.rpartition("/")[2] for item in (*joint.hardware_interfaces, *actuators)]
            words = [HARDWARE_INTERFACES[name] for name in names if name in HARDWARE_INTERFACES]
            interfaces = tuple(dict.fromkeys(words))
            found[joint.name] = JointResource(joint.name, interfaces, ("position", "velocity"))
    return found


def check_claims(
    controllers: Sequence[FoundController],
    hardware: Mapping[str, JointResource],
    diagnostics: Diagnostics,
) -> None:
    """Report controllers that need an interface which their joint does not have."""
    for item in controllers:
        for joint, interface, key in _claims(item):
            resource = hardware.get(joint)
            if resource is None or interface in resource.command_interfaces:
                continue
            span = item.nodes[key][1] if key in item.nodes else item.span
            has = ", ".join(resource.command_interfaces) or "none"
            text = f"controller '{item.name}' ({item.type}) needs the command interface "
            text += f"'{interface}' of joint '{joint}', which has {has} "
            text += f"({_words(item, joint, interface)})"
            hint = did_you_mean(interface, resource.command_interfaces)
            fix = hint or _fix(item, interface, resource)
            diagnostics.report("parameters.interface-claim", text, span, fix=fix)


def _claims(item: FoundController) -> Iterator[tuple[str, str, str]]:
    """Yield joint, command interface and the parameter that says so."""
    tree = nested(item.tree)
    package = item.type.partition("/")[0]
    if package == "diff_drive_controller":
        for key in _WHEEL_KEYS:
            for joint in _texts(tree.get(key)):
                yield joint, "velocity", key
        return
    joints = _texts(tree.get("joints")) or _texts(tree.get("joint"))
    if "command_joints" in tree:
        return
    if item.ros_version == 2 and isinstance(tree.get("command_interfaces"), list):
        for interface in _texts(tree.get("command_interfaces")):
            yield from ((joint, interface, "command_interfaces") for joint in joints)
    elif item.ros_version == 2 and isinstance(tree.get("interface_name"), str):
        yield from ((joint, str(tree["interface_name"]), "interface_name") for joint in joints)
    elif package in _BY_TYPE:
        yield from ((joint, _BY_TYPE[package], "") for joint in joints)


def _words(item: FoundController, joint: str, interface: str) -> str:
    if item.ros_version == 2:
        return f"Command interface with '{joint}/{interface}' does not exist"
    name = f"hardware_interface::{interface.capitalize()}JointInterface"
    return f"Could not find resource '{joint}' in '{name}'"


def _fix(item: FoundController, interface: str, resource: JointResource) -> str:
    if item.ros_version == 2:
        return f'add <command_interface name="{interface}"/> to the joint in <ros2_control>'
    own = f"hardware_interface/{interface.capitalize()}JointInterface"
    fix = f"<hardwareInterface>{own}</hardwareInterface> in the joint's transmission"
    if resource.command_interfaces:
        other = item.type.replace(item.type.partition("_")[0], resource.command_interfaces[0], 1)
        fix += f", or type: {other}"
    return fix


def _texts(value: object) -> list[str]:
    items = value if isinstance(value, list) else [value]
    return [text for text in items if isinstance(text, str) and text and "/" not in text]
