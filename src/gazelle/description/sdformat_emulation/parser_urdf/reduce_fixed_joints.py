"""Fixed joints dissolved: what the link below has goes to the link above.

A tensor is turned out of its own frame by roll, pitch and yaw one after the other; the sum is
turned back into the parent's inertial frame by all three at once. Operations stay in the library's
order, so that the last of the sixteen printed digits agrees.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.ignition_math import chained
from gazelle.description.sdformat_emulation.parser_urdf.console import Console
from gazelle.description.sdformat_emulation.parser_urdf.gazebo_extensions import (
    Blob,
    Extension,
    Extensions,
    move_extensions,
)
from gazelle.description.sdformat_emulation.parser_urdf.link_elements import pose_text
from gazelle.description.sdformat_emulation.parser_urdf.robot import Inertial, Joint, Link, Robot
from gazelle.description.sdformat_emulation.release import Release
from gazelle.description.urdfdom_emulation.values import Origin, rpy_from_quaternion
from gazelle.geometry import Vector3

__all__ = [
    "EndlessRobotError",
    "is_lumped",
    "is_reduced",
    "lump_fixed_joints",
    "warn_of_massless",
]

Matrix = list[list[float]]
# sdformat's LINK_INERTIA_INVALID.
_CODE = 19
_PAGE = "http://sdformat.org/tutorials?tut=sdformat_urdf_extensions"
# A link, its depth, and whether all that is fixed to it was seen.
_Step = tuple[Link, int, bool]
_WORLD = "world"
# A link with two parents is visited under both, with all below it.
_MAX_REPEATS = 100_000


class EndlessRobotError(ValueError):
    """The library would recur until its stack is full, and crash."""


def warn_of_massless(link: Link, is_without_inertial: bool, console: Console) -> None:
    """Add the warnings about a link.

    Args:
        link: the one left out.
        is_without_inertial: it has no ``<inertial>`` at all, not one without mass.
        console: receives them.
    """
    lack = (
        "no <inertial> block defined"
        if is_without_inertial
        else "a mass value of less than or equal to zero"
    )
    said = [
        f"urdf2sdf: link[{link.name}] has {lack}. Please ensure this link has a valid mass to "
        "prevent any missing links or joints in the resulting SDF model."
    ]
    above = link.joint_above
    if above is not None:
        said += [_lumping_helps("parent", above)] if above.kind == "fixed" else []
        said.append(f"urdf2sdf: parent joint[{above.name}] ignored.")
    below = [one.joint_above for one in link.children if one.joint_above is not None]
    if below:
        said += [_lumping_helps("child", one) for one in below if one.kind == "fixed"]
        said.append(f"urdf2sdf: [{len(below)}] child joints ignored.")
        said.append(f"urdf2sdf: [{len(below)}] child links ignored.")
    console.warning("massless", "\n".join(map(_coded, said)))
    console.warning("left out", _coded(f"urdf2sdf: link[{link.name}] is not modeled in sdf."))


def is_reduced(joint: Joint, extensions: Extensions) -> bool:
    """Tell whether a joint is fixed and nothing asks for it to stay."""
    kept = joint.name in extensions.kept_revolute or joint.name in extensions.kept_fixed
    return joint.kind == "fixed" and not kept


def is_lumped(link: Link, extensions: Extensions) -> bool:
    """Tell whether a link disappears in its parent; what is fixed to ``world`` does not."""
    if link.parent is None or link.joint_above is None or link.parent.name == _WORLD:
        return False
    return is_reduced(link.joint_above, extensions)


def lump_fixed_joints(robot: Robot, extensions: Extensions, console: Console) -> list[Link]:
    """Move the contents of every link on a reduced joint to its parent, the lowest ones first.

    Returns:
        The links that were lumped, in that order.

    Raises:
        EndlessRobotError: joints form a loop below the root, or links with several parents are
            visited far too often.
    """
    lumped = []
    for link in _bottom_up(robot, extensions):
        if is_lumped(link, extensions):
            _lump(link, extensions, console)
            lumped.append(link)
    return lumped


def _lump_inertia(link: Link, parent: Link, T_parent_link: Origin) -> None:
    """Add a link's mass and inertia to its parent's, which may have none yet."""
    if link.inertial is None:
        return
    if parent.inertial is None:
        parent.inertial = Inertial()
    total = _in_link_frame(parent.inertial)
    other = _in_link_frame(link.inertial)
    _turn_out(other, T_parent_link)
    _translate(other, T_parent_link.xyz_m)
    _add(total, other)
    _store(total, parent.inertial)


@dataclass(slots=True)
class _Mass:
    """A mass in kg, its centre in m and the inertia in kg m² about the frame's origin."""

    mass: float
    centre: list[float]
    inertia: Matrix


def _in_link_frame(inertial: Inertial) -> _Mass:
    ixx, ixy, ixz, iyy, iyz, izz = inertial.tensor
    matrix = [[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]]
    mass = _Mass(inertial.mass_kg, [0.0, 0.0, 0.0], matrix)
    _turn_out(mass, inertial.origin)
    _translate(mass, inertial.origin.xyz_m)
    return mass


def _store(total: _Mass, inertial: Inertial) -> None:
    x, y, z = total.centre
    inertial.mass_kg = total.mass
    inertial.origin = inertial.origin._replace(xyz_m=(x, y, z))
    _translate(total, (-x, -y, -z))
    _rotate(total, _rotation(*rpy_from_quaternion(inertial.origin.quat_xyzw)))
    matrix = total.inertia
    upper = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))
    inertial.tensor = tuple(matrix[row][column] for row, column in upper)


def _turn_out(mass: _Mass, pose: Origin) -> None:
    roll, pitch, yaw = rpy_from_quaternion(pose.quat_xyzw)
    _rotate(mass, _rotation(-roll, 0.0, 0.0))
    _rotate(mass, _rotation(0.0, -pitch, 0.0))
    _rotate(mass, _rotation(0.0, 0.0, -yaw))


def _rotation(phi: float, theta: float, psi: float) -> Matrix:
    """Return ODE's matrix of Euler angles, the transpose of the usual one."""
    sphi, cphi = math.sin(phi), math.cos(phi)
    stheta, ctheta = math.sin(theta), math.cos(theta)
    spsi, cpsi = math.sin(psi), math.cos(psi)
    return [
        [cpsi * ctheta, spsi * ctheta, -stheta],
        [cpsi * stheta * sphi - spsi * cphi, spsi * stheta * sphi + cpsi * cphi, ctheta * sphi],
        [cpsi * stheta * cphi + spsi * sphi, spsi * stheta * cphi - cpsi * sphi, ctheta * cphi],
    ]


def _rotate(mass: _Mass, turn: Matrix) -> None:
    half = [[_dot(turn[j], mass.inertia[i]) for j in range(3)] for i in range(3)]
    mass.inertia = _product(turn, half)
    _make_symmetric(mass.inertia)
    mass.centre = [_dot(row, mass.centre) for row in turn]


def _translate(mass: _Mass, by_m: Vector3) -> None:
    old = _crossing(mass.centre)
    centre = [by + at for by, at in zip(by_m, mass.centre, strict=True)]
    new = _crossing(centre)
    after, before = _product(new, new), _product(old, old)
    for i in range(3):
        for j in range(3):
            mass.inertia[i][j] += mass.mass * (before[i][j] - after[i][j])
    _make_symmetric(mass.inertia)
    mass.centre = [at + by for at, by in zip(mass.centre, by_m, strict=True)]


def _add(total: _Mass, other: _Mass) -> None:
    whole = total.mass + other.mass
    # Without any mass the centre is no number, and neither is the inertia then.
    share = 1.0 / whole if whole else math.copysign(math.inf, whole)
    total.centre = [
        (ours * total.mass + theirs * other.mass) * share
        for ours, theirs in zip(total.centre, other.centre, strict=True)
    ]
    total.mass += other.mass
    for i in range(3):
        for j in range(3):
            total.inertia[i][j] += other.inertia[i][j]


def _crossing(a: list[float]) -> Matrix:
    return [[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]]


def _product(left: Matrix, right: Matrix) -> Matrix:
    columns = [[row[j] for row in right] for j in range(3)]
    return [[_dot(column, row) for column in columns] for row in left]


def _dot(a: list[float], b: list[float]) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _make_symmetric(matrix: Matrix) -> None:
    matrix[1][0] = matrix[0][1]
    matrix[2][0] = matrix[0][2]
    matrix[2][1] = matrix[1][2]


def _lumping_helps(which: str, joint: Joint) -> str:
    return (
        "urdf2sdf: allowing joint lumping by removing any <disableFixedJointLumping> or "
        f"<preserveFixedJoint> gazebo tag on fixed {which} joint[{joint.name}], as well as "
        "ensuring that ParserConfig::URDFPreserveFixedJoint is false, could help resolve this "
        f"warning. See {_PAGE} for more information about this behavior."
    )


def _coded(text: str) -> str:
    return f"Error Code {_CODE}: Msg: {text}"


def _bottom_up(robot: Robot, extensions: Extensions) -> Iterator[Link]:
    """Yield links: those on reduced joints before their parent, the others after it."""
    waiting: list[_Step] = [(robot.root, 0, False)]
    visits = 0
    while waiting:
        link, depth, is_ready = waiting.pop()
        if is_ready:
            yield link
            continue
        visits += 1
        if depth > len(robot.links) or visits > len(robot.links) + _MAX_REPEATS:
            raise EndlessRobotError(link.name)
        first: list[_Step] = []
        later: list[_Step] = []
        for child in link.children:
            reduced = child.joint_above is not None and is_reduced(child.joint_above, extensions)
            (first if reduced else later).append((child, depth + 1, False))
        waiting += [*later[::-1], (link, depth, True), *first[::-1]]


def _lump(link: Link, extensions: Extensions, console: Console) -> None:
    parent, joint = link.parent, link.joint_above
    assert parent is not None and joint is not None
    if console.release is Release.V14:
        _remember(link, parent, joint, extensions)
    move_extensions(link.name, parent.name, joint.T_parent_joint, extensions, console)
    _lump_inertia(link, parent, joint.T_parent_joint)
    _move_parts(link, parent, "visual", console)
    _move_parts(link, parent, "collision", console)
    for child in link.children:
        _hang_higher(child, link, extensions)


def _remember(link: Link, parent: Link, joint: Joint, extensions: Extensions) -> None:
    """Leave frames of the joint's and the link's names, as sdformat does since 14."""
    origin = joint.T_parent_joint
    for name, holder, pose in (
        (joint.name, parent.name, pose_text(origin)),
        (link.name, joint.name, "0 0 0 0 0 0"),
    ):
        frame = SdfElement("frame", {"name": name, "attached_to": holder})
        frame.add("pose", pose)
        kept = Extension(blobs=[Blob(frame)])
        extensions.by_reference.setdefault("", []).append(kept)


def _move_parts(link: Link, parent: Link, kind: str, console: Console) -> None:
    assert link.joint_above is not None
    is_visual = kind == "visual"
    parts = parent.visuals if is_visual else parent.collisions
    held = {id(part) for part in parts}
    for part in link.visuals if is_visual else link.collisions:
        part.name = part.name or link.name
        part.origin = chained(link.joint_above.T_parent_joint, part.origin)
        if id(part) not in held:
            parts.append(part)
            continue
        console.warning(
            f"{kind} twice",
            f"attempted to add {kind} [{part.name}] to link [{parent.name}], but it already "
            f"exists in {kind}_array under name [{part.name}]",
        )


def _hang_higher(child: Link, link: Link, extensions: Extensions) -> None:
    """Hang a moving child on the nearest link above that stays."""
    joint = child.joint_above
    if joint is None or is_reduced(joint, extensions):
        return
    holder = link
    while is_lumped(holder, extensions):
        assert holder.joint_above is not None and holder.parent is not None
        joint.T_parent_joint = chained(holder.joint_above.T_parent_joint, joint.T_parent_joint)
        holder = holder.parent
    child.parent = holder
    joint.parent = holder.name
