"""How ``<gazebo reference="link">`` changes the look of a link's visuals."""

from __future__ import annotations

from dataclasses import replace

from gazelle.description.materials import GAZEBO_MATERIAL_NAMES, gazebo_material
from gazelle.description.model import Link, Material, Visual
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.checking import report_plugin_of
from gazelle.description.sdf_reader.materials import read_material
from gazelle.description.urdf_reader.gazebo_values import (
    bool_value,
    float_value,
    report_passed_over,
    report_unknown,
    value_of,
)
from gazelle.description.xml import Tag
from gazelle.diagnostics import did_you_mean

__all__ = ["apply_visual_words"]

_VISUAL_CHILDREN = ("cast_shadows", "laser_retro", "material", "transparency")


def apply_visual_words(link: Link, tags: list[Tag], context: ReadContext) -> Link:
    """Return the link with ``<material>`` and ``<visual>`` elements applied to all its visuals.

    ``<material>`` names a Gazebo script and wins over URDF's own colours, as in Gazebo.

    Args:
        link: the link.
        tags: its ``<material>`` and ``<visual>`` elements, in document order.
        context: where to report, and look-up of scripts.
    """
    visuals = link.visuals
    if tags:
        report_passed_over(link.name, visuals, tags[0], context)
    for tag in tags:
        if tag.name == "visual":
            for plugin in tag.find_all("plugin"):
                report_plugin_of(plugin, "visual", context)
            visuals = tuple(_apply_block(visual, tag, context) for visual in visuals)
            continue
        material = _script_material(tag, context)
        if material is not None:
            visuals = tuple(replace(visual, material=material) for visual in visuals)
    return replace(link, visuals=visuals)


def _script_material(tag: Tag, context: ReadContext) -> Material | None:
    name = value_of(tag)
    if not name and tag.children:
        message = "a <material> with elements inside has no effect here, where the text is the"
        message += " name of a material; the shapes keep their own look"
        inside = next((item.text_of("name") for item in tag.find_all("script")), "")
        fix = f"write <material>{inside or 'Gazebo/Orange'}</material>"
        context.diagnostics.report("urdf.gazebo-material", message, tag.span, fix=fix)
        return None
    found = gazebo_material(name)
    if found is None:
        hint = did_you_mean(name, GAZEBO_MATERIAL_NAMES)
        message = f"material '{name}' is none of Gazebo's; the shapes keep their own look"
        context.diagnostics.report("urdf.gazebo-material", message, tag.span, fix=hint)
    return found


def _apply_block(visual: Visual, block: Tag, context: ReadContext) -> Visual:
    for tag in block.children:
        if tag.name == "transparency":
            value = float_value(tag, context)
            visual = visual if value is None else replace(visual, transparency=value)
        elif tag.name == "cast_shadows":
            visual = replace(visual, cast_shadows=bool_value(tag, True, context))
        elif tag.name == "laser_retro":
            value = float_value(tag, context)
            visual = visual if value is None else replace(visual, laser_retro=value)
        elif tag.name == "material":
            visual = replace(visual, material=read_material(tag, context) or visual.material)
        elif tag.name not in (*_VISUAL_CHILDREN, "plugin"):
            report_unknown(tag, "a visual", _VISUAL_CHILDREN, context)
    return visual
