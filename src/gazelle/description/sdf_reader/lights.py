"""SDF ``<light>``."""

from __future__ import annotations

from gazelle.description.model import Light, LightType
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.child_values import (
    child_bool,
    child_float,
    child_rgba,
    child_vector3,
    name_of,
)
from gazelle.description.sdf_reader.poses import pose_of
from gazelle.description.xml import Tag
from gazelle.diagnostics import did_you_mean
from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = ["read_light"]

_TYPES = tuple(item.value for item in LightType)


def read_light(
    tag: Tag, context: ReadContext, *, T_parent_base: Pose = IDENTITY_POSE
) -> Light | None:
    """Return the light of a ``<light>`` element; None (reported) when it has no name.

    Args:
        tag: the element.
        context: where problems are reported.
        T_parent_base: the frame that the light's ``<pose>`` is relative to.
    """
    name = name_of(tag, context)
    if not name:
        return None
    attenuation, spot = tag.find("attenuation") or tag, tag.find("spot") or tag
    return Light(
        name=name,
        type=_type_of(tag, name, context),
        T_parent_light=T_parent_base @ pose_of(tag, context),
        diffuse=child_rgba(tag, "diffuse", (1.0, 1.0, 1.0, 1.0), context),
        specular=child_rgba(tag, "specular", (0.1, 0.1, 0.1, 1.0), context),
        direction=child_vector3(tag, "direction", (0.0, 0.0, -1.0), context),
        intensity=child_float(tag, "intensity", 1.0, context),
        cast_shadows=child_bool(tag, "cast_shadows", False, context),
        range_m=child_float(attenuation, "range", 10.0, context),
        attenuation_constant=child_float(attenuation, "constant", 1.0, context),
        attenuation_linear=child_float(attenuation, "linear", 1.0, context)
        if tag.find("attenuation")
        else 0.0,
        attenuation_quadratic=child_float(attenuation, "quadratic", 0.0, context),
        spot_inner_angle_rad=child_float(spot, "inner_angle", 0.0, context),
        spot_outer_angle_rad=child_float(spot, "outer_angle", 0.0, context),
        spot_falloff=child_float(spot, "falloff", 0.0, context),
        span=tag.span,
    )


def _type_of(tag: Tag, name: str, context: ReadContext) -> LightType:
    word = tag.attributes.get("type", "point").strip()
    if word in _TYPES:
        return LightType(word)
    message = f"light '{name}' has the unknown type '{word}'; it shines as a point light"
    context.diagnostics.report(
        "sdf.unknown-light-type", message, tag.span, fix=did_you_mean(word, _TYPES)
    )
    return LightType.POINT
