"""Names of joints, links, groups, controllers and interfaces over all files that name them."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from gazelle.control.checks import (
    ConfiguredController,
    MoveItController,
    check_control,
    configured_controllers,
    moveit_controllers,
)
from gazelle.control.hardware.ros1_joint_setup import HARDWARE_INTERFACES
from gazelle.control.hardware.ros2_tags import read_hardware_tags
from gazelle.control.resource_manager import JointResource
from gazelle.description.model import Model
from gazelle.description.srdf import link_names
from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostic, Diagnostics, did_you_mean
from gazelle.doctor.packages.dependency_checks import is_slip
from gazelle.doctor.parameters.controllers import (
    FoundController,
    FoundControllers,
    controllers_in,
)
from gazelle.doctor.parameters.parameter_file import (
    Document,
    Layout,
    layout_of,
    plain,
    read_document,
    scalars,
)
from gazelle.doctor.report import Section
from gazelle.documents.yaml import YamlMapping
from gazelle.parameters.trees import nested

__all__ = [
    "NameFiles",
    "check_claims",
    "check_names",
    "check_srdf",
    "group_names",
    "hardware_of",
    "read_name_files",
    "srdf_names",
]

# element: attributes that name links, joints
_LINKS = {
    "chain": ("base_link", "tip_link"),
    "disable_collisions": ("link1", "link2"),
    "enable_collisions": ("link1", "link2"),
    "disable_default_collisions": ("link",),
    "end_effector": ("parent_link",),
    "link": ("name",),
    "link_sphere_approximation": ("link",),
    "virtual_joint": ("child_link",),
}
_JOINTS = {"joint": ("name",), "passive_joint": ("name",)}
_GROUPS = {"group_state": ("group",), "end_effector": ("group", "parent_group")}
_BY_TYPE = {
    "diff_drive_controller": "velocity",
    "effort_controllers": "effort",
    "position_controllers": "position",
    "velocity_controllers": "velocity",
}
_WHEEL_KEYS = ("left_wheel", "right_wheel", "left_wheel_names", "right_wheel_names")
_MOVEIT_MANAGER = "moveit_simple_controller_manager"
_COLUMNS = ("name", "URDF", "hardware", "controllers", "MoveIt")


@dataclass(slots=True)
class NameFiles:
    """Files that name joints.

    Attributes:
        controllers: of all parameter files, each name once.
        moveit: what MoveIt sends trajectories to.
        documents: those of MoveIt.
        srdfs: root elements.
    """

    controllers: list[FoundController] = field(default_factory=list)
    moveit: list[MoveItController] = field(default_factory=list)
    documents: list[Document] = field(default_factory=list)
    srdfs: list[Tag] = field(default_factory=list)

    @property
    def ros_version(self) -> int:
        """1 or 2, by the controllers; 0 when there are none."""
        return max((item.ros_version for item in self.controllers), default=0)

    def joints(self) -> set[str]:
        """Return every joint that is named, as far as that can be told without a robot."""
        found = {name for item in self.configured() for name in item.joints}
        found |= {name for item in self.moveit for name in item.joints}
        for document in self.documents:
            for key in ("joint_limits", "initial_positions"):
                found |= set(document.keys(document.find(key)))
        for root in self.srdfs:
            found |= srdf_names(root)[1]
        return {name for name in found if "$" not in name}

    def configured(self) -> tuple[ConfiguredController, ...]:
        """Return the controllers with the joints they name."""
        return configured_controllers(FoundControllers(self.controllers))


def group_names(root: Tag) -> tuple[str, ...]:
    """Return the groups an SRDF defines."""
    return tuple(tag.attributes.get("name", "") for tag in root.find_all("group"))


def srdf_names(root: Tag) -> tuple[set[str], set[str]]:
    """Return the links and the joints that an SRDF names."""
    links: set[str] = set()
    joints: set[str] = set()
    for tag in root.walk():
        links |= {tag.attributes[key] for key in _LINKS.get(tag.name, ()) if key in tag.attributes}
        joints |= {
            tag.attributes[key] for key in _JOINTS.get(tag.name, ()) if key in tag.attributes
        }
    return links, joints


def check_srdf(
    root: Tag,
    links: Collection[str],
    joints: Collection[str],
    diagnostics: Diagnostics,
) -> None:
    """Report names of an SRDF that the robot, or the SRDF itself, does not have.

    Args:
        root: its ``<robot>``.
        links: of the robot.
        joints: of the robot.
        diagnostics: receives the findings.
    """
    groups = group_names(root)
    virtual = {tag.attributes.get("name", "") for tag in root.find_all("virtual_joint")}
    known_joints = {*joints, *virtual}
    for tag in root.walk():
        for key in _LINKS.get(tag.name, ()):
            _check(tag, key, "link", links, diagnostics)
        for key in _JOINTS.get(tag.name, ()):
            _check(tag, key, "joint", known_joints, diagnostics)
        for key in _GROUPS.get(tag.name, ()):
            _check(tag, key, "group", groups, diagnostics)
    for group in root.find_all("group"):
        for inner in group.find_all("group"):
            _check(inner, "name", "group", groups, diagnostics)


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
        _check_states(item, hardware, diagnostics)
        _check_gains(item, hardware, diagnostics)
        # One word that is wrong is wrong for every joint of the list.
        lacking: dict[tuple[str, str], list[JointResource]] = {}
        for joint, interface, key in _claims(item):
            resource = hardware.get(joint)
            if resource is not None and interface not in resource.command_interfaces:
                lacking.setdefault((interface, key), []).append(resource)
        for (interface, key), (resource, *others) in lacking.items():
            joint, has = resource.name, ", ".join(resource.command_interfaces) or "none"
            text = f"controller '{item.name}' ({item.type}) needs the command interface "
            text += f"'{interface}' of joint '{joint}', which has {has} "
            text += f"({_words(item, joint, interface)})"
            if others:
                names = ", ".join(f"'{one.name}'" for one in others)
                text += f"; {names} {'lacks' if len(others) == 1 else 'lack'} it, too"
            hint = did_you_mean(interface, resource.command_interfaces)
            fix = hint or _fix(item, interface, resource)
            diagnostics.report(
                "parameters.interface-claim", text, item.place_of(key, interface), fix=fix
            )


def read_name_files(files: Sequence[Path]) -> NameFiles:
    """Read the files of one robot; their own mistakes are told where each file is checked."""
    found = NameFiles()
    quiet = Diagnostics()
    names: set[str] = set()
    for path in files:
        if path.suffix == ".srdf":
            root = read_xml(path, quiet)
            found.srdfs += [root] if root is not None and root.name == "robot" else []
            continue
        document = read_document(path, quiet)
        layout = layout_of(document) if document is not None else Layout.OTHER
        if document is None or "$(" in _text(path):
            continue
        if layout is Layout.MOVEIT:
            found.documents.append(document)
            if "fake" not in path.name:
                found.moveit += moveit_controllers(plain(document.root))
        for item in controllers_in(document, layout):
            if item.name not in names:
                names.add(item.name)
                found.controllers.append(item)
    return found


def check_names(model: Model, files: Sequence[Path], *, diagnostics: Diagnostics) -> Section | None:
    """Compare the names of a robot with those of its controllers' and MoveIt's files.

    Args:
        model: the robot, read from its URDF.
        files: parameter files and SRDFs that are for this robot.
        diagnostics: receives the findings.

    Returns:
        The section ``names``: one row per joint or controller; None when no file names any.
    """
    found = read_name_files(files)
    joints = {joint.name: joint for joint in model.joints}
    hardware = hardware_of(model)
    if found.controllers or found.moveit:
        # Without any controller here, MoveIt's own list is all there is to compare.
        source = FoundControllers(found.controllers or _as_controllers(found.moveit, model))
        movable = [name for name, joint in joints.items() if joint.axis is not None]
        known = hardware or {name: JointResource(name, ("position",), ()) for name in movable}
        told = Diagnostics()
        check_control(joints, known, source, told, moveit=found.moveit, span=model.span)
        for item in told:
            diagnostics.add(_where_named(item, found, joints))
        check_claims(found.controllers, hardware, diagnostics)
    for root in found.srdfs:
        check_srdf(root, link_names(model), joints, diagnostics)
    for document in found.documents:
        _check_moveit(document, joints, found.srdfs, diagnostics)
    rows = tuple(_rows(found, model, hardware))
    return (
        Section("names", f"{model.name}: who names which joint", _COLUMNS, rows) if rows else None
    )


def _where_named(item: Diagnostic, found: NameFiles, joints: Collection[str]) -> Diagnostic:
    """Return a disagreement at the name that the robot does not have, where that is written."""
    if item.code != "control.names-disagree":
        return item
    rows = [line.split()[0] for line in item.message.split("\n")[2:] if line.split()]
    for name in rows:
        if name in joints:
            continue
        for controller in found.controllers:
            for key, (node, _) in controller.nodes.items():
                if name in _texts(plain(node)):
                    return replace(item, span=controller.place_of(key, name))
        for document in found.documents:
            places = (one.span for _, one, _ in scalars(document.root) if one.text == name)
            span = next(places, None)
            if span is not None:
                return replace(item, span=span)
    return item


def _check(tag: Tag, key: str, kind: str, known: Collection[str], diagnostics: Diagnostics) -> None:
    name = tag.attributes.get(key, "")
    if not name or name in known or "$" in name:
        return
    words = {
        "link": f"Link '{name}' is not known to URDF",
        "joint": f"Joint '{name}' is not known to the URDF",
        "group": f"Group '{name}' not found",
    }
    owner = "the SRDF has" if kind == "group" else "the robot has"
    text = f"<{tag.name} {key}=\"{name}\">: {owner} no {kind} '{name}' ({words[kind]}); MoveIt "
    text += "leaves the element out"
    hint = did_you_mean(name, known)
    diagnostics.report("parameters.srdf-name", text, tag.span, fix=hint)


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


def _check_states(
    item: FoundController, hardware: Mapping[str, JointResource], diagnostics: Diagnostics
) -> None:
    """Report state interfaces in the list of a ROS 2 controller that no joint of it has."""
    tree = nested(item.tree)
    if item.ros_version != 2 or not isinstance(tree.get("state_interfaces"), list):
        return
    joints = [hardware[name] for name in _texts(tree.get("joints")) if name in hardware]
    for interface in _texts(tree.get("state_interfaces")):
        lacking = [one for one in joints if interface not in one.state_interfaces]
        if not lacking or not lacking[0].state_interfaces:
            continue
        has = ", ".join(lacking[0].state_interfaces)
        text = f"controller '{item.name}' ({item.type}) needs the state interface '{interface}' of "
        text += f"joint '{lacking[0].name}', which has {has} (State interface with "
        text += f"'{lacking[0].name}/{interface}' does not exist)"
        hint = did_you_mean(interface, lacking[0].state_interfaces)
        fix = hint or f'add <state_interface name="{interface}"/> to the joint in <ros2_control>'
        place = item.place_of("state_interfaces", interface)
        diagnostics.report("parameters.interface-claim", text, place, fix=fix)


def _check_gains(item: FoundController, joints: Collection[str], diagnostics: Diagnostics) -> None:
    """Report gains and constraints for joints that are slips for those of the controller."""
    tree = nested(item.tree)
    own = [*_texts(tree.get("joints")), *_texts(tree.get("joint"))]
    for key in ("gains", "constraints"):
        branch = tree.get(key)
        for name, value in branch.items() if isinstance(branch, Mapping) else ():
            if not isinstance(value, Mapping) or name in own or name in joints:
                continue
            slip = next((one for one in own if is_slip(name, one)), "")
            if slip:
                text = f"controller '{item.name}' has {key} of joint '{name}', which is none of "
                text += f"its joints: {', '.join(own)}; they have no effect"
                found = (place for at, (_, place) in item.nodes.items() if f".{name}." in f".{at}.")
                span = next(found, item.span)
                hint = f"did you mean '{slip}'?"
                diagnostics.report("parameters.gains-joint", text, span, fix=hint)


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


def _as_controllers(moveit: Sequence[MoveItController], model: Model) -> list[FoundController]:
    from gazelle.diagnostics import SourceSpan

    span = model.span or SourceSpan(model.name)
    kind = "joint_trajectory_controller/JointTrajectoryController"
    return [
        FoundController(item.name, item.name, kind, 2, {"joints": list(item.joints)}, {}, span)
        for item in moveit
    ]


def _check_moveit(
    document: Document,
    joints: Mapping[str, Any],
    srdfs: Sequence[Tag],
    diagnostics: Diagnostics,
) -> None:
    for key in ("joint_limits", "initial_positions"):
        node = document.find(key)
        names = document.keys(node)
        if 2 * sum(name in joints for name in names) < len(names):
            # Names before a prefix is put in front of them, or of another robot.
            continue
        for name in names if node is not None else ():
            if name not in joints and node is not None:
                text = f"'{key}' names joint '{name}', the robot has none of that name"
                span = document.key(node, name).span
                hint = did_you_mean(name, joints)
                diagnostics.report("parameters.moveit-name", text, span, fix=hint)
    _check_moveit_controllers(document, diagnostics)
    groups = [name for root in srdfs for name in group_names(root)]
    for place, value in document.root.pairs:
        name = place.text
        is_group = "kinematics_solver" in document.keys(value)
        if is_group and groups and name not in groups:
            text = f"kinematics for group '{name}', the SRDF has none of that name (No "
            text += f"kinematics solver instantiated for group '{name}')"
            hint = did_you_mean(name, groups)
            diagnostics.report("parameters.moveit-name", text, place.span, fix=hint)


def _check_moveit_controllers(document: Document, diagnostics: Diagnostics) -> None:
    """Report controllers whose ``type`` or ``joints`` are spelt otherwise."""
    branch = document.find(_MOVEIT_MANAGER) or document.root
    for key, value in branch.pairs if isinstance(branch, YamlMapping) else ():
        words = [one.text for one, _ in value.pairs] if isinstance(value, YamlMapping) else []
        if not isinstance(value, YamlMapping) or not {"type", "joints"} & set(words):
            continue
        for wanted in {"type", "joints"} - set(words):
            slip = next((word for word in words if is_slip(word, wanted)), "")
            if slip:
                place = next(one.span for one, _ in value.pairs if one.text == slip)
                text = f"MoveIt's controller '{key.text}' has no '{wanted}' and has '{slip}' (No "
                text += f"{wanted} specified for controller {key.text})"
                fix = f"did you mean '{wanted}' for '{slip}'?"
                diagnostics.report("parameters.moveit-name", text, place, fix=fix)


def _rows(
    found: NameFiles, model: Model, hardware: Mapping[str, JointResource]
) -> Iterator[tuple[str, ...]]:
    urdf = {joint.name: joint.type.value for joint in model.joints}
    named = _by_joint([(item.name, item.joints) for item in found.configured()])
    planned = _by_joint([(item.name, item.joints) for item in found.moveit])
    for name in dict.fromkeys([*hardware, *named, *planned]):
        interfaces = ", ".join(hardware[name].command_interfaces) if name in hardware else ""
        yield name, urdf.get(name, ""), interfaces, named.get(name, ""), planned.get(name, "")


def _by_joint(owners: Sequence[tuple[str, tuple[str, ...]]]) -> dict[str, str]:
    found: dict[str, str] = {}
    for owner, joints in owners:
        for joint in joints:
            found[joint] = f"{found[joint]}, {owner}" if joint in found else owner
    return found


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
