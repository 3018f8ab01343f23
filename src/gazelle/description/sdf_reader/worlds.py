"""SDF ``<world>``."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from gazelle.description.model import Frame, Joint, Light, Model, World
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.child_values import child_vector3, name_of, vector3_from
from gazelle.description.sdf_reader.frame_graph import WORLD_FRAME, FrameGraph, FramePoint
from gazelle.description.sdf_reader.includes import included_file, share_findings
from gazelle.description.sdf_reader.joints import JointEnds
from gazelle.description.sdf_reader.lights import read_light
from gazelle.description.sdf_reader.models import included_model, read_model
from gazelle.description.sdf_reader.parts import ModelParts
from gazelle.description.sdf_reader.physics import read_gravity, read_physics
from gazelle.description.sdf_reader.plugins import read_plugins
from gazelle.description.sdf_reader.populations import populated
from gazelle.description.sdf_reader.poses import (
    PoseResolver,
    named_children,
    pose_of,
    relative_to_of,
)
from gazelle.description.sdf_reader.scenes import read_scene, read_spherical_coordinates
from gazelle.description.sdf_reader.states import with_state
from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics, Severity
from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = ["read_world", "report_actor"]

_DEFAULTS = World()


def read_world(tag: Tag, context: ReadContext) -> World:
    """Return the world of a ``<world>`` element, with all it includes.

    What cannot be loaded is reported and left out; the rest of the world is returned.
    """
    context = replace(context, in_world=True)
    reader = _WorldReader(tag, context)
    world = World(
        name=name_of(tag, context, default="default"),
        models=reader.models(),
        lights=reader.lights(),
        joints=reader.joints(),
        frames=reader.frames(),
        plugins=read_plugins(tag),
        gravity_m_s2=read_gravity(tag, context),
        magnetic_field_t=child_vector3(tag, "magnetic_field", _DEFAULTS.magnetic_field_t, context),
        wind_m_s=vector3_from(tag.find("wind", "linear_velocity"), (0.0, 0.0, 0.0), context),
        physics=read_physics(tag, context),
        scene=read_scene(tag, context),
        spherical_coordinates=read_spherical_coordinates(tag, context),
        span=tag.span,
    )
    state = tag.find("state")
    return with_state(world, state, context) if state is not None else world


class _WorldReader:
    """Reads the things of one world and places them."""

    def __init__(self, tag: Tag, context: ReadContext) -> None:
        self._tag = tag
        self._context = context
        self._lights: list[Light] = []
        self._parts = _unique_names(self._read_parts(), context)
        self._frames = named_children(tag, "frame", context)
        self._joints = named_children(tag, "joint", context)
        self._points = self._all_points()
        self._graph = FrameGraph(
            self._points,
            context,
            scope="the world",
            root=WORLD_FRAME,
            default_attached=WORLD_FRAME,
        )

    def models(self) -> tuple[Model, ...]:
        return tuple(
            replace(item.model, T_world_model=self._graph.pose(item.model.name))
            for item in self._parts
        )

    def lights(self) -> tuple[Light, ...]:
        """Return the lights of the file and of included lights; the first of a name counts."""
        own = (
            read_light(item, self._context, T_parent_base=self._base(item))
            for item in named_children(self._tag, "light", self._context)
        )
        named: dict[str, Light] = {}
        for light in (*(item for item in own if item is not None), *self._lights):
            named.setdefault(light.name, light)
        return tuple(named.values())

    def frames(self) -> tuple[Frame, ...]:
        names = [tag.attributes["name"].strip() for tag in self._frames]
        graph = self._graph
        return tuple(Frame(name, graph.attached_link(name), graph.pose(name)) for name in names)

    def joints(self) -> tuple[Joint, ...]:
        ends = JointEnds(PoseResolver(self._context, self._graph), "the world")
        found = (
            ends.joint(tag, self._points[tag.attributes["name"].strip()]) for tag in self._joints
        )
        return tuple(joint for joint in found if joint is not None)

    def _base(self, tag: Tag) -> Pose:
        relative_to = relative_to_of(tag)
        user = FramePoint(tag.name, tag.attributes.get("name", ""), "", IDENTITY_POSE, "", tag.span)
        return self._graph.placed(IDENTITY_POSE, relative_to, default=WORLD_FRAME, user=user)

    def _read_parts(self) -> Iterable[ModelParts]:
        for child in self._tag.children:
            if child.name == "model":
                parts = read_model(child, self._context)
                yield from () if parts is None else (parts,)
            elif child.name == "include":
                yield from self._included(child)
            elif child.name == "population":
                yield from populated(child, self._context)
            elif child.name == "actor":
                report_actor(child, self._context)
        inserted = self._tag.find("state", "insertions")
        for child in inserted.find_all("model") if inserted is not None else ():
            parts = read_model(child, self._context)
            yield from () if parts is None else (parts,)

    def _included(self, tag: Tag) -> Iterable[ModelParts]:
        """Yield the model that an include brings; keep the lights it brings instead."""
        file = included_file(tag, self._context)
        if file is None:
            return
        lights = _lights_of_file(file, tag, self._context)
        if lights:
            self._lights += lights
            return
        parts = included_model(tag, self._context, file=file)
        if parts is not None:
            yield replace(parts, merged=False)  # a world has no links to merge into

    def _all_points(self) -> dict[str, FramePoint]:
        points: dict[str, FramePoint] = {}
        for item in self._parts:
            points |= item.points()
        for kind, tags in (("frame", self._frames), ("joint", self._joints)):
            for tag in tags:
                point = self._point(kind, tag, points)
                points.setdefault(point.name, point)
        return points

    def _point(self, kind: str, tag: Tag, known: Mapping[str, FramePoint]) -> FramePoint:
        name, relative_to = tag.attributes["name"].strip(), relative_to_of(tag)
        attached_to = tag.attributes.get("attached_to", "").strip()
        if kind == "joint":
            attached_to = tag.text_of("child")
            attached_to = attached_to if attached_to in known else ""
        pose = pose_of(tag, self._context)
        return FramePoint(kind, name, relative_to or attached_to, pose, attached_to, tag.span)


def _unique_names(parts: Iterable[ModelParts], context: ReadContext) -> tuple[ModelParts, ...]:
    """Rename models whose name is taken, as Gazebo does with models inserted twice."""
    found: dict[str, ModelParts] = {}
    for item in parts:
        name, number = item.model.name, 0
        while name in found:
            name, number = f"{item.model.name}_{number}", number + 1
        if name != item.model.name:
            message = f"there are two models named '{item.model.name}'; this one becomes '{name}'"
            context.diagnostics.report(
                "sdf.duplicate-name", message, item.span, severity=Severity.WARNING
            )
        found[name] = replace(item, model=replace(item.model, name=name))
    return tuple(found.values())


def report_actor(tag: Tag, context: ReadContext) -> None:
    """Say that an ``<actor>`` is left out."""
    name = tag.attributes.get("name", "")
    message = f"actor '{name}' is an animation; it is left out"
    context.diagnostics.report("sdf.actor", message, tag.span)


def _lights_of_file(file: Path, tag: Tag, context: ReadContext) -> Sequence[Light]:
    """Return the lights of a file that holds lights and no model, such as the model ``sun``."""
    key = ("sdf lights", file)
    if key not in context.cache:
        found = Diagnostics()
        inner = replace(context.for_file(file), diagnostics=found)
        root = read_xml(file, found)
        lights = root.find_all("light") if root is not None and root.find("model") is None else ()
        read = [light for item in lights if (light := read_light(item, inner)) is not None]
        if read:
            share_findings(found, tag, context)
        context.cache[key] = tuple(read)
    kept: tuple[Light, ...] = context.cache[key]
    return tuple(_placed_light(light, tag, context) for light in kept)


def _placed_light(light: Light, tag: Tag, context: ReadContext) -> Light:
    pose = pose_of(tag, context) if tag.find("pose") is not None else light.T_parent_light
    return replace(light, name=tag.text_of("name", default=light.name), T_parent_light=pose)
