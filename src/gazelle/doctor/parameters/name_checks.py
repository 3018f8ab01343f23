"""Names of joints, links, groups and controllers over all files that name them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from gazelle.control.checks import (
    ConfiguredController,
    MoveItController,
    check_control,
    configured_controllers,
    moveit_controllers,
)
from gazelle.control.robot import JointResource
from gazelle.description.model import Model
from gazelle.description.srdf import link_names
from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.doctor.parameters.controllers import (
    FoundController,
    FoundControllers,
    controllers_in,
)
from gazelle.doctor.parameters.document import Document, plain, read_document
from gazelle.doctor.parameters.hardware import check_claims, hardware_of
from gazelle.doctor.parameters.parameter_file import Layout, layout_of
from gazelle.doctor.parameters.srdf import check_srdf, group_names, srdf_names
from gazelle.doctor.report import Section

__all__ = ["NameFiles", "check_names", "read_name_files"]

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
        known = hardware or {name: JointResource(name, ("position",), ()) for name in joints}
        check_control(joints, known, source, diagnostics, moveit=found.moveit, span=model.span)
        check_claims(found.controllers, hardware, diagnostics)
    for root in found.srdfs:
        check_srdf(root, link_names(model), joints, diagnostics)
    for document in found.documents:
        _check_moveit(document, joints, found.srdfs, diagnostics)
    rows = tuple(_rows(found, model, hardware))
    return (
        Section("names", f"{model.name}: who names which joint", _COLUMNS, rows) if rows else None
    )


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
    groups = [name for root in srdfs for name in group_names(root)]
    for place, value in document.root.pairs:
        name = place.text
        is_group = "kinematics_solver" in document.keys(value)
        if is_group and groups and name not in groups:
            text = f"kinematics for group '{name}', the SRDF has none of that name (No "
            text += f"kinematics solver instantiated for group '{name}')"
            hint = did_you_mean(name, groups)
            diagnostics.report("parameters.moveit-name", text, place.span, fix=hint)


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
