"""What ``<gazebo reference="link">`` changes about a link.

The meaning of every element is that of sdformat's URDF conversion (``parser_urdf.cc``), which
Gazebo Classic reads robots through; links are never lumped here, so every block acts on its own
link.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, cast

from gazelle.description.model import Collision, Link, Sensor, Surface
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.lights import read_light
from gazelle.description.sdf_reader.sensors import read_sensor
from gazelle.description.sdf_reader.surface_friction import read_surface
from gazelle.description.urdf_reader.gazebo_values import (
    bool_value,
    float_value,
    report_passed_over,
    report_unknown,
    value_of,
)
from gazelle.description.urdf_reader.gazebo_visuals import apply_visual_words
from gazelle.description.xml import Tag, floats_from

__all__ = ["apply_to_link"]

_SURFACE_WORDS = {
    "kd": "kd",
    "kp": "kp",
    "maxVel": "max_vel_m_s",
    "minDepth": "min_depth_m",
    "mu1": "mu1",
    "mu2": "mu2",
}
_COLLISION_WORDS = (*_SURFACE_WORDS, "collision", "fdir1", "laserRetro", "maxContacts")
_VISUAL_WORDS = ("material", "visual")
# Read elsewhere: plug-ins go to the model, canonicalBody does nothing in sdformat either.
_ELSEWHERE = ("canonicalBody", "plugin")


def apply_to_link(link: Link, blocks: list[Tag], context: ReadContext) -> Link:
    """Return the link with all its ``<gazebo reference>`` blocks applied, the later ones last.

    Args:
        link: the link as URDF describes it.
        blocks: the ``<gazebo>`` elements that refer to it.
        context: where to report, and look-up of files.
    """
    tags = [tag for block in blocks for tag in block.children]
    link = apply_visual_words(link, [tag for tag in tags if tag.name in _VISUAL_WORDS], context)
    link = _apply_collision_words(link, tags, context)
    for tag in tags:
        handler = _LINK_WORDS.get(tag.name)
        if handler is not None:
            link = handler(link, tag, context)
        elif tag.name not in _COLLISION_WORDS + _VISUAL_WORDS + _ELSEWHERE:
            known = (*_LINK_WORDS, *_COLLISION_WORDS, *_VISUAL_WORDS, *_ELSEWHERE)
            report_unknown(tag, f"link '{link.name}'", known, context)
    return link


def _apply_collision_words(link: Link, tags: list[Tag], context: ReadContext) -> Link:
    changes = _surface_changes(tags, context)
    base = next(
        (
            read_surface(tag.find("surface"), context)
            for tag in reversed(tags)
            if tag.name == "collision" and tag.find("surface") is not None
        ),
        None,
    )
    retro = _laser_retro(tags, context)
    if base is None and not changes and retro is None:
        return link
    first = next(tag for tag in tags if tag.name in _COLLISION_WORDS)
    if not link.collisions:
        message = f"<{first.name}> for link '{link.name}' has no effect: it has no <collision>"
        context.diagnostics.report("urdf.gazebo-no-collision", message, first.span)
    report_passed_over(link.name, link.collisions, first, context)
    return replace(
        link,
        collisions=tuple(
            _changed(collision, base, changes, retro) for collision in link.collisions
        ),
    )


def _changed(
    collision: Collision, base: Surface | None, changes: dict[str, Any], retro: float | None
) -> Collision:
    surface = replace(base if base is not None else collision.surface, **changes)
    laser_retro = collision.laser_retro if retro is None else retro
    return replace(collision, surface=surface, laser_retro=laser_retro)


def _surface_changes(tags: list[Tag], context: ReadContext) -> dict[str, Any]:
    changes: dict[str, Any] = {}
    for tag in tags:
        if tag.name in _SURFACE_WORDS:
            value = float_value(tag, context)
            if value is not None:
                changes[_SURFACE_WORDS[tag.name]] = value
        elif tag.name == "fdir1":
            changes["fdir1"] = _direction(tag, context)
        elif tag.name == "maxContacts":
            changes["max_contacts"] = _whole_number(tag, context)
        elif tag.name == "collision":
            changes.update(_collision_block(tag, context))
    return changes


def _collision_block(tag: Tag, context: ReadContext) -> dict[str, Any]:
    changes: dict[str, Any] = {}
    for child in tag.children:
        if child.name == "max_contacts":
            changes["max_contacts"] = _whole_number(child, context)
        elif child.name not in ("laser_retro", "surface"):
            known = ("laser_retro", "max_contacts", "surface")
            report_unknown(child, "a collision", known, context)
    return changes


def _laser_retro(tags: list[Tag], context: ReadContext) -> float | None:
    found = [tag for tag in tags if tag.name == "laserRetro"]
    found += [
        child for tag in tags if tag.name == "collision" for child in tag.find_all("laser_retro")
    ]
    values = [float_value(tag, context) for tag in found]
    return values[-1] if values else None


def _whole_number(tag: Tag, context: ReadContext) -> int | None:
    value = float_value(tag, context)
    return None if value is None else int(value)


def _direction(tag: Tag, context: ReadContext) -> tuple[float, float, float] | None:
    found = floats_from(
        value_of(tag), 3, (), what="<fdir1>", span=tag.span, diagnostics=context.diagnostics
    )
    length = sum(value * value for value in found) ** 0.5
    if not found or length == 0.0:
        return None
    return cast(tuple[float, float, float], tuple(value / length for value in found))


def _turn_gravity_off(link: Link, tag: Tag, context: ReadContext) -> Link:
    return replace(link, gravity=not bool_value(tag, True, context))


def _gravity(link: Link, tag: Tag, context: ReadContext) -> Link:
    return replace(link, gravity=bool_value(tag, True, context))


def _self_collide(link: Link, tag: Tag, context: ReadContext) -> Link:
    return replace(link, self_collide=bool_value(tag, False, context))


def _kinematic(link: Link, tag: Tag, context: ReadContext) -> Link:
    return replace(link, kinematic=bool_value(tag, False, context))


def _damping_factor(link: Link, tag: Tag, context: ReadContext) -> Link:
    value = float_value(tag, context)
    return link if value is None else replace(link, linear_damping=value, angular_damping=value)


def _velocity_decay(link: Link, tag: Tag, context: ReadContext) -> Link:
    linear, angular = tag.find("linear"), tag.find("angular")
    if linear is None and angular is None:
        return _damping_factor(link, tag, context)
    for child, name in ((linear, "linear_damping"), (angular, "angular_damping")):
        value = float_value(child, context) if child is not None else None
        changes: dict[str, Any] = {} if value is None else {name: value}
        link = replace(link, **changes)
    return link


def _sensor(link: Link, tag: Tag, context: ReadContext) -> Link:
    sensor: Sensor | None = read_sensor(tag, context)
    return link if sensor is None else replace(link, sensors=(*link.sensors, sensor))


def _light(link: Link, tag: Tag, context: ReadContext) -> Link:
    light = read_light(tag, context)
    return link if light is None else replace(link, lights=(*link.lights, light))


def _slip(link: Link, tag: Tag, context: ReadContext) -> Link:
    message = (
        f"<{tag.name}> directly in <gazebo> is not read by Gazebo and has no effect on "
        f"link '{link.name}'"
    )
    fix = (
        "write <collision><surface><friction><ode><slip1>…</slip1><slip2>…</slip2></ode>"
        "</friction></surface></collision>"
    )
    context.diagnostics.report("urdf.gazebo-no-effect", message, tag.span, fix=fix)
    return link


_LINK_WORDS: dict[str, Callable[[Link, Tag, ReadContext], Link]] = {
    "dampingFactor": _damping_factor,
    "gravity": _gravity,
    "kinematic": _kinematic,
    "light": _light,
    "selfCollide": _self_collide,
    "self_collide": _self_collide,
    "sensor": _sensor,
    "slip": _slip,
    "slip1": _slip,
    "slip2": _slip,
    "turnGravityOff": _turn_gravity_off,
    "velocity_decay": _velocity_decay,
}
