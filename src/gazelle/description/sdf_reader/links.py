"""SDF ``<link>``: mass, collisions, visuals, sensors, lights."""

from __future__ import annotations

from dataclasses import replace

from gazelle.description.model import Collision, Light, Link, Sensor, Visual
from gazelle.description.sdf_reader.child_values import child_bool, child_float, optional_int
from gazelle.description.sdf_reader.inertials import read_inertial
from gazelle.description.sdf_reader.lights import read_light
from gazelle.description.sdf_reader.materials import read_material
from gazelle.description.sdf_reader.poses import PoseResolver
from gazelle.description.sdf_reader.sensors import read_sensor
from gazelle.description.sdf_reader.shapes import read_shape
from gazelle.description.sdf_reader.surface_friction import read_surface
from gazelle.description.xml import Tag, bool_from
from gazelle.geometry import Pose

__all__ = ["read_link"]

_ALL_VISIBLE = 0xFFFFFFFF


def read_link(tag: Tag, T_model_link: Pose, resolver: PoseResolver, *, static: bool) -> Link:
    """Return the link of a ``<link>`` element.

    Args:
        tag: the element; its name has been checked.
        T_model_link: its place in the model, from the graph of frames.
        resolver: places the poses of what the link carries.
        static: the model never moves, so that its mass does not matter.
    """
    context, name = resolver.context, tag.attributes["name"].strip()
    collisions = _collisions(tag, name, resolver)
    decay = tag.find("velocity_decay") or tag
    self_collide = tag.find("self_collide")
    return Link(
        name=name,
        T_model_link=T_model_link,
        inertial=read_inertial(tag, collisions, context, static=static),
        collisions=collisions,
        visuals=_visuals(tag, name, resolver),
        sensors=_sensors(tag, name, resolver),
        lights=_lights(tag, name, resolver),
        gravity=child_bool(tag, "gravity", True, context),
        self_collide=bool_from(self_collide, False, context.diagnostics) if self_collide else None,
        kinematic=child_bool(tag, "kinematic", False, context),
        linear_damping=child_float(decay, "linear", 0.0, context),
        angular_damping=child_float(decay, "angular", 0.0, context),
        span=tag.span,
        inertial_tag=tag.find("inertial"),
    )


def _collisions(tag: Tag, link: str, resolver: PoseResolver) -> tuple[Collision, ...]:
    found = [_collision(child, link, resolver) for child in resolver.named(tag, "collision")]
    return tuple(item for item in found if item is not None)


def _collision(tag: Tag, link: str, resolver: PoseResolver) -> Collision | None:
    context = resolver.context
    shape = read_shape(tag.find("geometry"), context, owner=tag)
    if shape is None:
        return None
    surface = read_surface(tag.find("surface"), context)
    return Collision(
        name=tag.attributes["name"].strip(),
        shape=shape,
        T_link_collision=resolver.in_link(tag, link),
        surface=replace(surface, max_contacts=optional_int(tag, "max_contacts", context)),
        laser_retro=child_float(tag, "laser_retro", 0.0, context),
        span=tag.span,
    )


def _visuals(tag: Tag, link: str, resolver: PoseResolver) -> tuple[Visual, ...]:
    found = [_visual(child, link, resolver) for child in resolver.named(tag, "visual")]
    return tuple(item for item in found if item is not None)


def _visual(tag: Tag, link: str, resolver: PoseResolver) -> Visual | None:
    context = resolver.context
    shape = read_shape(tag.find("geometry"), context, owner=tag)
    if shape is None:
        return None
    flags = optional_int(tag, "visibility_flags", context)
    return Visual(
        name=tag.attributes["name"].strip(),
        shape=shape,
        T_link_visual=resolver.in_link(tag, link),
        material=read_material(tag.find("material"), context),
        transparency=min(1.0, max(0.0, child_float(tag, "transparency", 0.0, context))),
        cast_shadows=child_bool(tag, "cast_shadows", True, context),
        laser_retro=child_float(tag, "laser_retro", 0.0, context),
        visibility_flags=_ALL_VISIBLE if flags is None else flags & _ALL_VISIBLE,
        span=tag.span,
    )


def _sensors(tag: Tag, link: str, resolver: PoseResolver) -> tuple[Sensor, ...]:
    found = [_sensor(child, link, resolver) for child in resolver.named(tag, "sensor")]
    return tuple(item for item in found if item is not None)


def _sensor(tag: Tag, link: str, resolver: PoseResolver) -> Sensor | None:
    sensor = read_sensor(tag, resolver.context)
    return replace(sensor, T_link_sensor=resolver.in_link(tag, link)) if sensor else None


def _lights(tag: Tag, link: str, resolver: PoseResolver) -> tuple[Light, ...]:
    found = [(child, read_light(child, resolver.context)) for child in tag.find_all("light")]
    return tuple(
        replace(light, T_parent_light=resolver.in_link(child, link))
        for child, light in found
        if light is not None
    )
