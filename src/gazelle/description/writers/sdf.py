"""Models and worlds as SDF."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from gazelle.description.model import (
    Collision,
    Inertial,
    Joint,
    JointAxis,
    JointType,
    Link,
    Model,
    Visual,
    World,
)
from gazelle.description.sdformat_emulation import Release
from gazelle.description.writers.gazebo_tags import plugin_markup
from gazelle.description.writers.geometry_elements import add_sdf_geometry
from gazelle.description.writers.output_files import Converted, OutputFiles
from gazelle.description.writers.sdf_elements import (
    add_light,
    add_material,
    add_pose,
    add_sensor,
    add_surface,
)
from gazelle.description.writers.unscoped_names import free_name, with_plain_names
from gazelle.description.writers.xml_markup import (
    Markup,
    head_comments,
    number,
    numbers,
    report_addresses,
    tidy,
)
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = ["to_sdf"]

_TENSOR = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_NO_LIMIT = 1e16
_MIN_KG, _MIN_KG_M2 = 1e-6, 1e-9
_ALL_VISIBLE = 0xFFFFFFFF


def to_sdf(
    source: World | Model,
    *,
    diagnostics: Diagnostics,
    output_files: OutputFiles | None = None,
    release: Release = Release.V12,
) -> Converted:
    """Write a model, or a world with all its models, as SDF.

    Args:
        source: what to write.
        diagnostics: receives ``convert.…`` for everything that cannot be said or is said
            differently.
        output_files: where the text will stand and how files are named.
        release: gives the version written: 1.9 for Fortress, 1.7 for Gazebo 11.
    """
    found = Diagnostics()
    outputs = output_files or OutputFiles(relative=True)
    version = ".".join(map(str, release.spec))
    sdf = Markup("sdf", {"version": version})
    writer = _ModelWriter(outputs, found)
    if isinstance(source, Model):
        writer.add(sdf, source)
    else:
        _add_world(sdf, source, writer)
    report_addresses(outputs, found)
    for item in found:
        diagnostics.add(item)
    file = source.file
    head = head_comments(file.name if file else f"'{source.name}'", found)
    return Converted(sdf.to_text(head), outputs.files)


def _add_world(sdf: Markup, world: World, writer: _ModelWriter) -> None:
    item = sdf.add("world", name=world.name)
    physics = item.add("physics", name=world.physics.name, type=world.physics.engine)
    physics.add("max_step_size", number(world.physics.max_step_size_s))
    physics.add("real_time_factor", number(world.physics.real_time_factor))
    physics.add("real_time_update_rate", number(world.physics.real_time_update_rate_hz))
    item.add("gravity", numbers(world.gravity_m_s2))
    item.add("magnetic_field", numbers(world.magnetic_field_t))
    scene = item.add("scene")
    scene.add("ambient", numbers(world.scene.ambient))
    scene.add("background", numbers(world.scene.background))
    scene.add("shadows", str(world.scene.shadows).lower())
    for light in world.lights:
        add_light(item, light, light.T_parent_light)
    for model in world.models:
        writer.add(item, model)
    for joint in world.joints:
        _add_joint(item, joint, joint.T_model_joint, writer.diagnostics, in_world=True)
    item.children += [plugin_markup(plugin) for plugin in world.plugins]


class _ModelWriter:
    """Writes models one after the other."""

    def __init__(self, output_files: OutputFiles, diagnostics: Diagnostics) -> None:
        self.diagnostics = diagnostics
        self._beside = output_files

    def add(self, owner: Markup, model: Model) -> None:
        """Append a ``<model>``."""
        model = with_plain_names(model, self.diagnostics)
        item = owner.add("model", name=model.name)
        if model.canonical_link and model.canonical_link != model.links[0].name:
            item.attributes["canonical_link"] = model.canonical_link
        add_pose(item, model.T_world_model)
        if model.static:
            item.add("static", "true")
        if model.self_collide:
            item.add("self_collide", "true")
        if not model.allow_auto_disable:
            item.add("allow_auto_disable", "false")
        for frame in model.frames:
            part = item.add("frame", name=frame.name, attached_to=frame.attached_to)
            link = model.link(frame.attached_to)
            base = link.T_model_link if link else IDENTITY_POSE
            add_pose(part, base.inverse() @ frame.T_model_frame)
        for link in model.links:
            self._add_link(item, link, model)
        frames = {link.name: link.T_model_link for link in model.links}
        for joint in model.joints:
            base = frames.get(joint.child, IDENTITY_POSE)
            T_child_joint = base.inverse() @ joint.T_model_joint
            _add_joint(item, joint, T_child_joint, self.diagnostics)
        item.children += [plugin_markup(plugin) for plugin in model.plugins]
        self._report_ros(model)

    def _add_link(self, owner: Markup, link: Link, model: Model) -> None:
        item = owner.add("link", name=link.name)
        add_pose(item, link.T_model_link)
        if not link.gravity:
            item.add("gravity", "false")
        if link.self_collide is not None:
            item.add("self_collide", str(link.self_collide).lower())
        if link.kinematic:
            item.add("kinematic", "true")
        if link.linear_damping or link.angular_damping:
            decay = item.add("velocity_decay")
            decay.add("linear", number(link.linear_damping))
            decay.add("angular", number(link.angular_damping))
        self._add_inertial(item, link, model)
        for collision in link.collisions:
            self._add_collision(item, collision)
        taken = [collision.name for collision in link.collisions]
        for visual in link.visuals:
            # Since SDF 1.7 the parts of a link must have different names, whatever they are.
            name = f"{visual.name}_visual" if visual.name in taken else visual.name
            taken.append(free_name(name, taken))
            self._add_visual(item, replace(visual, name=taken[-1]))
        for sensor in link.sensors:
            add_sensor(item, sensor, sensor.T_link_sensor, self.diagnostics)
        for light in link.lights:
            add_light(item, light, light.T_parent_light)

    def _add_inertial(self, item: Markup, link: Link, model: Model) -> None:
        inertial = link.inertial
        if model.static and (inertial is None or inertial.mass_kg <= 0):
            return
        if inertial is None or inertial.mass_kg <= 0:
            inertial = Inertial(
                _MIN_KG, inertia_kg_m2=(_MIN_KG_M2, 0, 0, _MIN_KG_M2, 0, _MIN_KG_M2)
            )
            message = (
                f"link '{link.name}' has no mass, which SDF does not allow; it is given "
                f"{_MIN_KG:g} kg"
            )
            self.diagnostics.report("convert.approximated", message, link.span)
        part = item.add("inertial")
        add_pose(part, inertial.T_link_com)
        part.add("mass", number(inertial.mass_kg))
        tensor = part.add("inertia")
        for word, value in zip(_TENSOR, inertial.inertia_kg_m2, strict=True):
            tensor.add(word, number(value))

    def _add_collision(self, item: Markup, collision: Collision) -> None:
        part = item.add("collision", name=collision.name)
        add_pose(part, collision.T_link_collision)
        add_sdf_geometry(part, collision.shape, self._beside)
        if collision.surface.max_contacts is not None:
            part.add("max_contacts", number(collision.surface.max_contacts))
        if collision.laser_retro:
            part.add("laser_retro", number(collision.laser_retro))
        add_surface(part, replace(collision.surface, span=None))

    def _add_visual(self, item: Markup, visual: Visual) -> None:
        part = item.add("visual", name=visual.name)
        add_pose(part, visual.T_link_visual)
        add_sdf_geometry(part, visual.shape, self._beside)
        if visual.material is not None:
            add_material(part, visual.material, self._beside)
        if visual.transparency:
            part.add("transparency", number(visual.transparency))
        if not visual.cast_shadows:
            part.add("cast_shadows", "false")
        if visual.laser_retro:
            part.add("laser_retro", number(visual.laser_retro))
        if visual.visibility_flags != _ALL_VISIBLE:
            part.add("visibility_flags", number(visual.visibility_flags))

    def _report_ros(self, model: Model) -> None:
        lost: Sequence[str] = [f"transmission '{item.name}'" for item in model.transmissions]
        lost = [*lost, *(f"ros2_control '{item.name}'" for item in model.ros2_controls)]
        if lost:
            message = f"SDF has no place for {', '.join(lost)} of '{model.name}'"
            self.diagnostics.report("convert.left-out", message, model.span)


def _add_joint(
    owner: Markup,
    joint: Joint,
    T_child_joint: Pose,
    diagnostics: Diagnostics,
    *,
    in_world: bool = False,
) -> None:
    kind = joint.type
    if kind in (JointType.FLOATING, JointType.PLANAR):
        if kind is JointType.PLANAR:
            message = f"joint '{joint.name}' is planar, which SDF cannot say; its links move freely"
            diagnostics.report("convert.left-out", message, joint.span)
        return
    item = owner.add("joint", name=joint.name, type=kind.value)
    add_pose(item, T_child_joint)
    if in_world:
        item.children[-1:] = []
        xyz_rpy_owner = Markup("joint")
        add_pose(xyz_rpy_owner, T_child_joint)
        for pose in xyz_rpy_owner.children:
            pose.attributes["relative_to"] = "world"
            item.children.append(pose)
    item.add("parent", joint.parent or "world")
    item.add("child", joint.child)
    _add_kind(item, joint)
    if joint.axis is not None:
        _add_axis(item, "axis", joint.axis, joint, diagnostics)
    if joint.axis2 is not None:
        _add_axis(item, "axis2", joint.axis2, joint, diagnostics)
    _add_physics(item, joint)
    for sensor in joint.sensors:
        add_sensor(item, sensor, sensor.T_link_sensor, diagnostics)


def _add_kind(item: Markup, joint: Joint) -> None:
    if joint.type is JointType.SCREW and joint.thread_pitch_rad_m:
        item.add("thread_pitch", number(-joint.thread_pitch_rad_m))
    if joint.type is JointType.GEARBOX:
        item.add("gearbox_ratio", number(joint.gearbox_ratio))
        item.add("gearbox_reference_body", joint.gearbox_reference_body)


def _add_axis(
    item: Markup, name: str, axis: JointAxis, joint: Joint, diagnostics: Diagnostics
) -> None:
    part = item.add(name)
    part.add("xyz", numbers(map(tidy, axis.xyz)))
    if axis.position:
        part.add("initial_position", number(axis.position))
    limit = Markup("limit")
    for word, value in (("lower", axis.lower), ("upper", axis.upper)):
        if abs(value) < _NO_LIMIT:
            limit.add(word, number(value))
    for word, value in (("effort", axis.effort), ("velocity", axis.velocity)):
        if value < _NO_LIMIT:
            limit.add(word, number(value))
    part.children += [limit] if limit.children else []
    dynamics = Markup("dynamics")
    for word in ("damping", "friction", "spring_reference", "spring_stiffness"):
        if value := getattr(axis, word):
            dynamics.add(word, number(value))
    part.children += [dynamics] if dynamics.children else []
    if joint.mimic is not None and name == "axis":
        # SDF 1.11; releases before it warn and pass it over.
        mimic = part.add("mimic", joint=joint.mimic.joint)
        mimic.add("multiplier", number(joint.mimic.multiplier))
        mimic.add("offset", number(joint.mimic.offset))
        mimic.add("reference", "0")
        message = (
            f"joint '{joint.name}' mimics '{joint.mimic.joint}' in words of SDF 1.11; Gazebo "
            "Classic and Fortress pass them over"
        )
        diagnostics.report("convert.approximated", message, joint.span)


def _add_physics(item: Markup, joint: Joint) -> None:
    physics, ode = Markup("physics"), Markup("ode")
    for word in ("cfm", "erp"):
        if (value := getattr(joint, word)) is not None:
            ode.add(word, number(value))
    if joint.implicit_spring_damper:
        ode.add("implicit_spring_damper", "true")
    limit = Markup("limit")
    for word, value in (("cfm", joint.limit_cfm), ("erp", joint.limit_erp)):
        if value is not None:
            limit.add(word, number(value))
    ode.children += [limit] if limit.children else []
    physics.children += [ode] if ode.children else []
    if joint.provide_feedback:
        physics.add("provide_feedback", "true")
    item.children += [physics] if physics.children else []
