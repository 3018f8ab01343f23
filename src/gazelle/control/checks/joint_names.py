"""Do URDF, hardware, controllers and MoveIt mean the same joints?"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

from gazelle.control.checks.configured_controllers import ConfiguredController, MoveItController
from gazelle.control.resource_manager import JointResource
from gazelle.diagnostics import did_you_mean
from gazelle.diagnostics.suggestions import nearest_names

__all__ = ["Disagreement", "disagreements", "table_text"]

_NONE = "–"
_HEADINGS = ("name", "URDF", "hardware", "controllers", "MoveIt", "")


@dataclass(frozen=True, slots=True)
class Disagreement:
    """A name that some of the files have and others do not.

    Attributes:
        name: a joint, or a controller that MoveIt names.
        urdf: its type in the robot description, empty when it is not there.
        hardware: its command interfaces, empty when transmissions and ``<ros2_control>`` blocks
            do not have it.
        controllers: controllers that name it.
        moveit: controllers of MoveIt that name it.
        remark: what is wrong, with the nearest name.
    """

    name: str
    urdf: str
    hardware: str
    controllers: tuple[str, ...]
    moveit: tuple[str, ...]
    remark: str


def disagreements(
    urdf: Mapping[str, str],
    hardware: Mapping[str, JointResource],
    controllers: Sequence[ConfiguredController],
    moveit: Sequence[MoveItController] = (),
    absent: Collection[str] = (),
) -> tuple[Disagreement, ...]:
    """Compare the four places that name joints.

    Args:
        urdf: joints of the robot description and their types.
        hardware: joints that transmissions or ``<ros2_control>`` give to controllers.
        controllers: what the parameters describe.
        moveit: what MoveIt sends trajectories to.
        absent: joints of hardware that was not loaded, which is reported by itself.

    Returns:
        every name that is missing somewhere it is needed, in the order of the places. A joint
        that nobody wants to control is no disagreement.
    """
    named = _by_joint((item.name, _joints_of(item, urdf)) for item in controllers)
    planned = _by_joint((item.name, item.joints) for item in moveit)
    rows = []
    for name in dict.fromkeys([*hardware, *named, *planned]):
        if name in absent and name in urdf and name not in hardware:
            continue
        remark = _remark(name, urdf, hardware, named, planned if moveit else None)
        if remark:
            interfaces = ", ".join(hardware[name].command_interfaces) if name in hardware else ""
            rows.append(
                Disagreement(
                    name,
                    urdf.get(name, ""),
                    interfaces or ("state only" if name in hardware else ""),
                    named.get(name, ()),
                    planned.get(name, ()),
                    remark,
                )
            )
    return (*rows, *_unknown_controllers(controllers, moveit))


def table_text(rows: Sequence[Disagreement]) -> str:
    """Return the rows as a table of text, one line each below a line of headings."""
    cells = [_HEADINGS]
    for row in rows:
        names = (", ".join(row.controllers), ", ".join(row.moveit))
        cells.append((row.name, row.urdf, row.hardware, *names, row.remark))
    widths = [max(len(line[column] or _NONE) for line in cells) for column in range(5)]
    lines = []
    for line in cells:
        padded = [(text or _NONE).ljust(width) for text, width in zip(line, widths, strict=False)]
        lines.append("  ".join([*padded, line[5]]).rstrip())
    return "\n".join(lines)


def _joints_of(controller: ConfiguredController, urdf: Mapping[str, str]) -> tuple[str, ...]:
    """Return the joints a controller names; one of unknown type may call other things joints."""
    if controller.is_known:
        return controller.joints
    names = controller.joints
    return tuple(name for name in names if name in urdf or nearest_names(name, urdf))


def _remark(
    name: str,
    urdf: Mapping[str, str],
    hardware: Mapping[str, JointResource],
    named: Mapping[str, tuple[str, ...]],
    planned: Mapping[str, tuple[str, ...]] | None,
) -> str:
    if name not in urdf:
        return _with_nearest("the robot has no such joint", name, urdf)
    if urdf[name] == "fixed":
        return "the joint is fixed"
    if name not in hardware:
        return "no transmission or <ros2_control> gives it to controllers"
    if planned is not None and name in planned and name not in named:
        return "MoveIt plans for it, no controller moves it"
    return ""


def _unknown_controllers(
    controllers: Sequence[ConfiguredController], moveit: Sequence[MoveItController]
) -> list[Disagreement]:
    names = [item.name for item in controllers]
    rows = []
    for item in moveit:
        last = item.name.rpartition("/")[2]
        if item.name not in names and last not in names:
            remark = _with_nearest("no such controller is configured", item.name, names)
            rows.append(Disagreement(item.name, "", "", (), (item.name,), remark))
    return rows


def _with_nearest(text: str, name: str, existing: Collection[str]) -> str:
    if nearest_names(name, existing):
        return f"{text}; {did_you_mean(name, existing)}"
    return text


def _by_joint(rows: Iterable[tuple[str, Sequence[str]]]) -> dict[str, tuple[str, ...]]:
    found: dict[str, tuple[str, ...]] = {}
    for owner, joints in rows:
        for joint in joints:
            found[joint] = (*found.get(joint, ()), owner)
    return found
