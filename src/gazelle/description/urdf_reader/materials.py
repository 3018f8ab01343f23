"""URDF materials: named for the whole robot, named inside a visual, or without a name."""

from __future__ import annotations

from gazelle.description.model import Material
from gazelle.description.read_context import ReadContext
from gazelle.description.urdf_reader.attributes import check_vocabulary, find_file
from gazelle.description.xml import Tag, floats_from
from gazelle.diagnostics import did_you_mean

__all__ = ["global_materials", "visual_material"]


def global_materials(robot: Tag, context: ReadContext) -> dict[str, Material]:
    """Return the materials defined directly under ``<robot>`` by name."""
    table: dict[str, Material] = {}
    for tag in robot.find_all("material"):
        material = _read(tag, context)
        name = tag.attributes.get("name", "").strip()
        if not name:
            message = 'a <material> of the robot needs name="…"; this one cannot be used'
            context.diagnostics.report("urdf.material-no-name", message, tag.span)
        elif name in table:
            message = f"material '{name}' is not unique; the first definition counts"
            context.diagnostics.report("urdf.duplicate-material", message, tag.span)
        elif material is None:
            message = f"material '{name}' has neither <color> nor <texture>"
            context.diagnostics.report("urdf.material-empty", message, tag.span)
        else:
            table[name] = material
    return table


def visual_material(
    visual: Tag, link: str, table: dict[str, Material], context: ReadContext
) -> Material | None:
    """Return a visual's material; None for the shape's own look.

    As in urdfdom, a name that is known already wins over colours given beside it, and a named
    material with colours is known to the links that follow.

    Args:
        visual: the ``<visual>``.
        link: the link's name, for the message.
        table: materials known so far; grows.
        context: workspace for textures and where to report.
    """
    tag = visual.find("material")
    if tag is None:
        return None
    name = tag.attributes.get("name", "").strip()
    own = _read(tag, context)
    if name in table:
        return table[name]
    if own is None:
        if name:
            hint = did_you_mean(name, table)
            message = f"link '{link}' material '{name}' undefined; the shape keeps its own look"
            context.diagnostics.report("urdf.material-undefined", message, tag.span, fix=hint)
        return None
    if name:
        table[name] = own
    return own


def _read(tag: Tag, context: ReadContext) -> Material | None:
    check_vocabulary(
        tag,
        context.diagnostics,
        attributes=("name",),
        children=("color", "texture"),
        once=("color", "texture"),
    )
    name = tag.attributes.get("name", "").strip()
    colour, texture = tag.find("color"), tag.find("texture")
    rgba = _rgba(colour, name, context) if colour is not None else None
    if colour is None and texture is None:
        return None
    rgba = rgba or (1.0, 1.0, 1.0, 1.0)
    image = None
    if texture is not None and (uri := texture.attributes.get("filename", "").strip()):
        found = find_file(uri, texture.span, context)
        image = found.path
        if image is None:
            message = f"material '{name}' shows its plain colour: texture {found.explain(uri)}"
            context.diagnostics.report("urdf.texture-missing", message, texture.span)
    return Material(name, ambient=rgba, diffuse=rgba, texture=image)


def _rgba(tag: Tag, name: str, context: ReadContext) -> tuple[float, float, float, float] | None:
    check_vocabulary(tag, context.diagnostics, attributes=("rgba",))
    text = tag.attributes.get("rgba")
    if text is None:
        message = f"<color> of material '{name}' has no rgba"
        context.diagnostics.report("urdf.bad-rgba", message, tag.span)
        return None
    tokens = text.split()
    if len(tokens) != 4:
        message = f"material '{name}' has malformed color rgba values: 4 needed, found '{text}'"
        context.diagnostics.report("urdf.bad-rgba", message, tag.span)
        return None
    found = floats_from(
        text, 4, (), what="<color rgba>", span=tag.span, diagnostics=context.diagnostics
    )
    if not found:
        return None
    if any(not 0.0 <= value <= 1.0 for value in found):
        message = f"material '{name}': rgba '{text}' leaves 0…1 and is clipped"
        context.diagnostics.report("urdf.rgba-range", message, tag.span)
    r, g, b, a = (min(1.0, max(0.0, value)) for value in found)
    return (r, g, b, a)
