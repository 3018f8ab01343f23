"""``<gazebo>`` blocks: what only Gazebo's words can say about a robot's parts."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from gazelle.description.model import Joint, Link, Model, PluginTag, Surface, Visual
from gazelle.description.writers.output_files import OutputFiles
from gazelle.description.writers.sdf_elements import (
    add_light,
    add_material,
    add_sensor,
    add_surface,
    is_script,
)
from gazelle.description.writers.unscoped_names import part_names
from gazelle.description.writers.urdf_elements import is_plain
from gazelle.description.writers.xml_markup import Markup, from_tag, number, numbers
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose

__all__ = ["joint_block", "link_block", "model_blocks", "plugin_markup"]

_SURFACE_ELEMENTS = {
    "mu1": "mu1",
    "mu2": "mu2",
    "kp": "kp",
    "kd": "kd",
    "min_depth_m": "minDepth",
    "max_vel_m_s": "maxVel",
}
_ALL_VISIBLE = 0xFFFFFFFF


def link_block(
    link: Link, T_new_link: Pose, output_files: OutputFiles, diagnostics: Diagnostics
) -> Markup | None:
    """Return the block of a link; None when URDF's own words say everything.

    Args:
        link: the link.
        T_new_link: its own frame in the one it gets.
        output_files: names textures.
        diagnostics: receives what differs between shapes of one link, which no block can say.
    """
    block = Markup("gazebo", {"reference": link.name})
    _add_visual_material(block, link, output_files, diagnostics)
    _add_contact(block, link)
    if not link.gravity:
        block.add("turnGravityOff", "true")
    if link.self_collide is not None:
        block.add("selfCollide", str(link.self_collide).lower())
    if link.kinematic:
        block.add("kinematic", "true")
    if link.linear_damping or link.angular_damping:
        decay = block.add("velocity_decay")
        decay.add("linear", number(link.linear_damping))
        decay.add("angular", number(link.angular_damping))
    for sensor in link.sensors:
        add_sensor(block, sensor, T_new_link @ sensor.T_link_sensor, diagnostics)
    for light in link.lights:
        add_light(block, light, T_new_link @ light.T_parent_light)
    return block if block.children else None


def joint_block(joint: Joint, diagnostics: Diagnostics) -> Markup | None:
    """Return the block of a joint; None when URDF's own words say everything."""
    block = Markup("gazebo", {"reference": joint.name})
    axis = joint.axis
    if axis is not None and (axis.spring_stiffness or axis.spring_reference):
        block.add("springStiffness", number(axis.spring_stiffness))
        block.add("springReference", number(axis.spring_reference))
    for name, value in (("stopCfm", joint.limit_cfm), ("stopErp", joint.limit_erp)):
        if value is not None:
            block.add(name, number(value))
    for name, flag in (
        ("implicitSpringDamper", joint.implicit_spring_damper),
        ("provideFeedback", joint.provide_feedback),
        ("disableFixedJointLumping", joint.disable_fixed_joint_lumping),
    ):
        if flag:
            block.add(name, "true")
    soft = {"cfm": joint.cfm, "erp": joint.erp}
    if any(value is not None for value in soft.values()):
        ode = block.add("physics").add("ode")
        for name, value in soft.items():
            if value is not None:
                ode.add(name, number(value))
    for sensor in joint.sensors:
        add_sensor(block, sensor, sensor.T_link_sensor, diagnostics)
    return block if block.children else None


def model_blocks(model: Model, diagnostics: Diagnostics) -> list[Markup]:
    """Return the blocks about the whole robot, and its plug-ins."""
    elements = Markup("gazebo")
    if model.static:
        elements.add("static", "true")
    if model.self_collide:
        elements.add("self_collide", "true")
    if not model.allow_auto_disable:
        elements.add("allow_auto_disable", "false")
    blocks = [elements] if elements.children else []
    parts = part_names(model)
    for plugin in model.plugins:
        block = Markup("gazebo")
        if plugin.reference in parts:
            block.attributes["reference"] = plugin.reference
        elif plugin.reference:
            message = (
                f"plug-in '{plugin.name}' of the nested model '{plugin.reference}' becomes one of "
                "the whole robot"
            )
            diagnostics.report("convert.approximated", message, plugin.span)
        block.children.append(plugin_markup(plugin))
        blocks.append(block)
    return blocks


def plugin_markup(plugin: PluginTag) -> Markup:
    """Return the ``<plugin>`` as it was; one of before 2012 under today's name."""
    markup = from_tag(plugin.parameters)
    if markup.name != "plugin":
        markup.name = "plugin"
        markup.attributes = {"name": plugin.name, "filename": plugin.filename}
    return markup


def _add_visual_material(
    block: Markup, link: Link, output_files: OutputFiles, diagnostics: Diagnostics
) -> None:
    visuals = link.visuals
    visual = Markup("visual")
    if len({item.transparency for item in visuals}) == 1 and visuals[0].transparency:
        visual.add("transparency", number(visuals[0].transparency))
    shadow = _common(link, "cast_shadows", diagnostics)
    if shadow is False:
        visual.add("cast_shadows", "false")
    retro = _common(link, "laser_retro", diagnostics)
    if retro:
        visual.add("laser_retro", number(retro))
    if any(item.visibility_flags != _ALL_VISIBLE for item in visuals):
        message = f"visibility_flags of link '{link.name}' cannot be said in URDF"
        diagnostics.report("convert.left-out", message, link.span)
    material = visuals[0].material if len({item.material for item in visuals}) == 1 else None
    if material is not None and is_script(material):
        block.add("material", material.name)
    elif material is not None and not is_plain(material):
        add_material(visual, material, output_files)
    elif material is None:
        _report_materials(link, visuals, diagnostics)
    block.children += [visual] if visual.children else []


def _report_materials(link: Link, visuals: Iterable[Visual], diagnostics: Diagnostics) -> None:
    rich = [item for item in visuals if item.material is not None and not is_plain(item.material)]
    if rich:
        names = ", ".join(f"'{item.name}'" for item in rich)
        message = (
            f"the visuals of link '{link.name}' look different from each other: {names} keep "
            "their diffuse colour only, for URDF has no ambient, specular or emissive colour"
        )
        diagnostics.report("convert.left-out", message, rich[0].span)


def _common(link: Link, name: str, diagnostics: Diagnostics) -> Any:
    """Return what all visuals of a link share; None (reported) when they differ."""
    values = {getattr(item, name) for item in link.visuals}
    if len(values) > 1:
        message = f"the visuals of link '{link.name}' differ in {name}; none of it is written"
        diagnostics.report("convert.left-out", message, link.span)
    return values.pop() if len(values) == 1 else None


def _add_contact(block: Markup, link: Link) -> None:
    if not link.collisions:
        return
    surface = replace(link.collisions[0].surface, span=None)
    elements = {name: getattr(surface, key) for key, name in _SURFACE_ELEMENTS.items()}
    rest = replace(
        surface, mu1=None, mu2=None, kp=None, kd=None, min_depth_m=None, max_vel_m_s=None,
        fdir1=None, max_contacts=None,
    )  # fmt: skip
    if rest != Surface():
        # All of it in one place: a block of SDF's words replaces what stands beside it.
        add_surface(block.add("collision"), surface)
        elements = {}
    for name, value in elements.items():
        if value is not None:
            block.add(name, number(value))
    if surface.fdir1 is not None and elements:
        block.add("fdir1", numbers(surface.fdir1))
    if surface.max_contacts is not None:
        block.add("maxContacts", number(surface.max_contacts))
    if link.collisions[0].laser_retro:
        block.add("laserRetro", number(link.collisions[0].laser_retro))
