"""SDF ``<material>``: script, colours, textures."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from gazelle.description.materials import material_from_scripts, picture_colour
from gazelle.description.model import Material, Rgba
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.child_values import child_bool, child_float, child_rgba
from gazelle.description.xml import Tag

__all__ = ["read_material"]

_COLOURS = ("ambient", "diffuse", "specular", "emissive")


def read_material(tag: Tag | None, context: ReadContext) -> Material | None:
    """Return the look of a ``<material>`` element; None when the file gives none.

    A script comes first, colours written beside it replace the script's, as Gazebo Classic does;
    a picture stays. Where only one of ambient and diffuse is written the other one follows it.
    """
    if tag is None:
        return None
    script = tag.find("script")
    base = _from_script(script, context) if script is not None else None
    colours = {
        name: child_rgba(tag, name, (0.0, 0.0, 0.0, 1.0), context)
        for name in _COLOURS
        if tag.text_of(name)
    }
    texture = _albedo(tag, context)
    if base is None and not colours and texture is None:
        return None
    if base is None:
        base = _plain(colours, texture)
    return replace(
        base,
        ambient=_tinted(colours.get("ambient"), base, base.ambient),
        diffuse=_tinted(colours.get("diffuse"), base, base.diffuse),
        specular=colours.get("specular", base.specular),
        emissive=colours.get("emissive", base.emissive),
        texture=texture or base.texture,
        shininess=child_float(tag, "shininess", base.shininess, context),
        lighting=child_bool(tag, "lighting", base.lighting, context),
    )


def _from_script(script: Tag, context: ReadContext) -> Material | None:
    name = script.text_of("name")
    if name in ("", "__default__"):
        return None
    uris = [child.text for child in script.find_all("uri") if child.text not in ("", "__default__")]
    place = script.find("name") or script
    return material_from_scripts(name, uris, context, span=place.span)


def _plain(colours: dict[str, Rgba], texture: Path | None) -> Material:
    """Return the look of colours alone; a picture without colours is shown as it is."""
    usual: Rgba = (1.0, 1.0, 1.0, 1.0) if texture else Material().diffuse
    ambient = colours.get("ambient", colours.get("diffuse", usual))
    return Material(ambient=ambient, diffuse=colours.get("diffuse", ambient))


def _tinted(colour: Rgba | None, base: Material, unchanged: Rgba) -> Rgba:
    """Multiply with the mean colour that stands for a picture of Gazebo's own."""
    if colour is None:
        return unchanged
    red, green, blue = picture_colour(base.name) or (1.0, 1.0, 1.0)
    return (colour[0] * red, colour[1] * green, colour[2] * blue, colour[3])


def _albedo(tag: Tag, context: ReadContext) -> Path | None:
    """Return the base colour picture of physically based materials (SDF 1.6 and later)."""
    for workflow in ("metal", "specular"):
        found = tag.find("pbr", workflow, "albedo_map")
        if found is None or not found.text:
            continue
        resolved = context.resolve(found.text)
        if resolved.path is None:
            context.diagnostics.report(
                "material.texture-missing", resolved.explain(found.text), found.span
            )
        return resolved.path
    return None
