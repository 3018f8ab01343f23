"""``<link>``, ``<joint>`` and ``<transmission>`` of a URDF that is written."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from gazelle.description.model import (
    Collision,
    Inertial,
    Joint,
    JointAxis,
    JointType,
    Link,
    Material,
    MeshShape,
    Rgba,
    Shape,
    TransmissionTag,
    Visual,
)
from gazelle.description.writers.geometry_elements import add_urdf_geometry, as_mesh, urdf_pieces
from gazelle.description.writers.output_files import OutputFiles
from gazelle.description.writers.unscoped_names import free_name
from gazelle.description.writers.xml_markup import Markup, number, numbers, tidy, xyz_rpy
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = ["NO_LIMIT", "LinkWriter", "add_joint", "add_origin", "add_transmission", "is_plain"]

_TENSOR = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
NO_LIMIT = 1e16
"""What SDF writes for no limit; URDF has no word for it."""
_RANGED = (JointType.REVOLUTE, JointType.PRISMATIC)


@dataclass(slots=True)
class LinkWriter:
    """Writes links and gathers the materials they use.

    Attributes:
        output_files: names files and takes those that are made.
        diagnostics: receives what cannot be said.
        has_capsules: the source is a URDF, whose own capsules stay.
        materials: rgba and texture by name, in the order of their first use.
    """

    output_files: OutputFiles
    diagnostics: Diagnostics
    has_capsules: bool
    materials: dict[str, tuple[Rgba, str]] = field(default_factory=dict)

    def write(self, robot: Markup, link: Link, T_new_link: Pose) -> None:
        """Append a link.

        Args:
            robot: the ``<robot>``.
            link: what to write.
            T_new_link: the link's own frame in the one it gets.
        """
        item = robot.add("link", name=link.name)
        if link.inertial is not None:
            _add_inertial(item, link.inertial, T_new_link)
        for visual in link.visuals:
            self._add_visual(item, link, visual, T_new_link @ visual.T_link_visual)
        for collision in link.collisions:
            pose = T_new_link @ collision.T_link_collision
            for suffix, shape, T_shape_piece in self._pieces(link, collision):
                self._add_shape(
                    item, collision.name + suffix, shape, pose @ T_shape_piece, "collision"
                )

    def _add_visual(self, item: Markup, link: Link, visual: Visual, pose: Pose) -> None:
        material = "" if visual.material is None else self._material(link, visual)
        for suffix, shape, T_shape_piece in self._pieces(link, visual):
            part = self._add_shape(
                item, visual.name + suffix, shape, pose @ T_shape_piece, "visual"
            )
            if material:
                part.add("material", name=material)

    def _add_shape(self, item: Markup, name: str, shape: Shape, pose: Pose, word: str) -> Markup:
        part = item.add(word, name=name)
        add_origin(part, pose)
        add_urdf_geometry(part, shape, self.output_files)
        return part

    def _pieces(self, link: Link, owner: Collision | Visual) -> tuple[tuple[str, Shape, Pose], ...]:
        pieces = urdf_pieces(owner.shape, has_capsules=self.has_capsules)
        word = type(owner).__name__.lower()
        kind = type(owner.shape).__name__.lower().removesuffix("shape")
        if len(pieces) == 1:
            return pieces
        what = f"the {kind} of {word} '{owner.name}' of link '{link.name}'"
        if pieces:
            message = f"{what} is written as a cylinder and two spheres; URDF 1.0 has no capsule"
            self.diagnostics.report("convert.approximated", message, owner.span)
            return pieces
        mesh = as_mesh(owner.shape)
        address = None
        if mesh is not None:
            address = self.output_files.add(f"{link.name}_{owner.name}.stl", mesh[1])
        if address is None:
            why = "" if mesh is None else "; a mesh in its place needs a file to be written beside"
            message = f"{what} is left out: URDF has none{why}"
            self.diagnostics.report("convert.left-out", message, owner.span)
            return ()
        message = f"{what} is written as the mesh '{address}'"
        self.diagnostics.report("convert.approximated", message, owner.span)
        return (("", MeshShape(address, None), IDENTITY_POSE),)

    def _material(self, link: Link, visual: Visual) -> str:
        """Return the name of a visual's look in the new file."""
        assert visual.material is not None
        material = visual.material
        *rgb, alpha = material.diffuse
        if len({other.transparency for other in link.visuals}) > 1:
            alpha *= 1.0 - visual.transparency
        texture = (
            self.output_files.address(material.texture) if material.texture is not None else ""
        )
        appearance = ((rgb[0], rgb[1], rgb[2], alpha), texture)
        wanted = material.name or f"{link.name}_material"
        if self.materials.get(wanted) == appearance:
            return wanted
        known = next((name for name, item in self.materials.items() if item == appearance), "")
        if known and (not material.name or known.startswith(f"{wanted}_")):
            return known
        name = free_name(wanted, self.materials)
        self.materials[name] = appearance
        return name

    def material_tags(self) -> list[Markup]:
        """Return the ``<material>`` definitions of everything written so far."""
        found = []
        for name, (rgba, texture) in self.materials.items():
            item = Markup("material", {"name": name})
            item.add("color", rgba=numbers(rgba))
            if texture:
                item.add("texture", filename=texture)
            found.append(item)
        return found


def add_origin(owner: Markup, pose: Pose) -> None:
    """Append an ``<origin>``; nothing for the identity."""
    xyz, rpy = xyz_rpy(pose)
    if (xyz, rpy) != ("0 0 0", "0 0 0"):
        owner.add("origin", xyz=xyz, rpy=rpy)


def is_plain(material: Material) -> bool:
    """Tell whether URDF's colour and texture say all of a look."""
    colour = material.diffuse
    return material == Material(
        material.name, ambient=colour, diffuse=colour, texture=material.texture
    )


def add_joint(robot: Markup, joint: Joint, T_parent_joint: Pose, diagnostics: Diagnostics) -> None:
    """Append a joint of one axis or none.

    Args:
        robot: the ``<robot>``.
        joint: what to write.
        T_parent_joint: its place in the frame the parent link has in the new file.
        diagnostics: receives what cannot be said.
    """
    axis = joint.axis
    kind = joint.type
    if kind is JointType.REVOLUTE and axis and not _is_limited(axis):
        kind = JointType.CONTINUOUS
    item = robot.add("joint", name=joint.name, type=kind.value)
    add_origin(item, T_parent_joint)
    item.add("parent", link=joint.parent)
    item.add("child", link=joint.child)
    if axis is not None:
        item.add("axis", xyz=numbers(map(tidy, axis.xyz)))
        _add_limit(item, kind, axis)
        if axis.damping or axis.friction:
            item.add("dynamics", damping=number(axis.damping), friction=number(axis.friction))
        if axis.position:
            message = (
                f"joint '{joint.name}' starts at {axis.position:g}; in URDF every joint starts at 0"
            )
            diagnostics.report("convert.left-out", message, joint.span)
    _add_extras(item, joint)


def add_transmission(
    robot: Markup, transmission: TransmissionTag, diagnostics: Diagnostics
) -> None:
    """Append a transmission in the syntax of ROS Indigo and later."""
    if not transmission.joints:
        message = (
            f"transmission '{transmission.name}' is of a kind of the PR2 with members of its own; "
            "it is left out"
        )
        diagnostics.report("convert.left-out", message, transmission.span)
        return
    item = robot.add("transmission", name=transmission.name)
    item.add("type", transmission.type)
    for joint in transmission.joints:
        member = item.add("joint", name=joint.name)
        for interface in joint.hardware_interfaces:
            member.add("hardwareInterface", interface)
        if joint.role:
            member.add("role", joint.role)
        if joint.mechanical_reduction != 1.0:
            member.add("mechanicalReduction", number(joint.mechanical_reduction))
        if joint.offset:
            member.add("offset", number(joint.offset))
    for actuator in transmission.actuators:
        member = item.add("actuator", name=actuator.name)
        for interface in actuator.hardware_interfaces:
            member.add("hardwareInterface", interface)
        if actuator.role:
            member.add("role", actuator.role)
        member.add("mechanicalReduction", number(actuator.mechanical_reduction))


def _add_inertial(link: Markup, inertial: Inertial, T_new_link: Pose) -> None:
    item = link.add("inertial")
    if inertial.estimated:
        item.comment("not in the source: estimated from the link's shapes")
    add_origin(item, T_new_link @ inertial.T_link_com)
    item.add("mass", value=number(inertial.mass_kg))
    values = zip(_TENSOR, map(number, inertial.inertia_kg_m2), strict=True)
    item.add("inertia", **dict(values))


def _is_limited(axis: JointAxis) -> bool:
    return axis.lower > -NO_LIMIT or axis.upper < NO_LIMIT


def _bounded(value: float) -> str:
    return number(math.copysign(NO_LIMIT, value) if abs(value) >= NO_LIMIT else value)


def _add_limit(item: Markup, kind: JointType, axis: JointAxis) -> None:
    limit = Markup("limit")
    if kind in _RANGED:
        limit.attributes["lower"] = _bounded(axis.lower)
        limit.attributes["upper"] = _bounded(axis.upper)
    if kind in _RANGED or axis.effort < NO_LIMIT or axis.velocity < NO_LIMIT:
        limit.attributes["effort"] = _bounded(axis.effort)
        limit.attributes["velocity"] = _bounded(axis.velocity)
    item.children += [limit] if limit.attributes else []


def _add_extras(item: Markup, joint: Joint) -> None:
    mimic, safety = joint.mimic, joint.safety
    if mimic is not None:
        attributes = {"multiplier": number(mimic.multiplier), "offset": number(mimic.offset)}
        item.add("mimic", joint=mimic.joint, **attributes)
    if safety is not None:
        names = ("soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity")
        item.add("safety_controller", **{name: number(getattr(safety, name)) for name in names})
    found = {"rising": joint.calibration_rising, "falling": joint.calibration_falling}
    given = {name: number(value) for name, value in found.items() if value is not None}
    if given:
        item.add("calibration", **given)
