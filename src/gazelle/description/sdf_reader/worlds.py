"""SDF ``<world>``: its models, lights, physics, scene and saved ``<state>``."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from gazelle.description.model import (
    Frame,
    Joint,
    Light,
    Link,
    Model,
    Physics,
    Scene,
    SphericalCoordinates,
    World,
)
from gazelle.description.model.plugin import read_plugins
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.child_values import (
    child_bool,
    child_float,
    child_int,
    child_rgba,
    child_vector3,
    name_of,
    vector3_from,
)
from gazelle.description.sdf_reader.frame_graph import WORLD_FRAME, FrameGraph, FramePoint
from gazelle.description.sdf_reader.includes import included_file, share_findings
from gazelle.description.sdf_reader.joints import JointEnds
from gazelle.description.sdf_reader.lights import read_light
from gazelle.description.sdf_reader.models import ModelParts, included_model, read_model
from gazelle.description.sdf_reader.populations import populated
from gazelle.description.sdf_reader.poses import (
    PoseResolver,
    named_children,
    pose_of,
    read_pose,
    relative_to_of,
)
from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics, Severity, did_you_mean
from gazelle.geometry import IDENTITY_POSE, Pose, Vector3

__all__ = [
    "read_world",
    "report_actor",
]

_ENGINES = ("ode", "bullet", "simbody", "dart", "tpe", "ignored")
_TRUE = ("1", "true")
_PHYSICS_DEFAULTS = Physics()
_GRAVITY: Vector3 = (0.0, 0.0, -9.8)
_SCENE_DEFAULTS = Scene()
_MAX_SHIFT_M = 1e-4
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
        gravity_m_s2=_read_gravity(tag, context),
        magnetic_field_t=child_vector3(tag, "magnetic_field", _DEFAULTS.magnetic_field_t, context),
        wind_m_s=vector3_from(tag.find("wind", "linear_velocity"), (0.0, 0.0, 0.0), context),
        physics=_read_physics(tag, context),
        scene=_read_scene(tag, context),
        spherical_coordinates=_read_spherical_coordinates(tag, context),
        span=tag.span,
    )
    state = tag.find("state")
    return _with_state(world, state, context) if state is not None else world


def report_actor(tag: Tag, context: ReadContext) -> None:
    """Say that an ``<actor>`` is left out."""
    name = tag.attributes.get("name", "")
    message = f"actor '{name}' is an animation; it is left out"
    context.diagnostics.report("sdf.actor", message, tag.span)


def _chosen_physics(world: Tag) -> Tag | None:
    """Return the ``<physics>`` with ``default="true"``, the first one when none says so."""
    profiles = world.find_all("physics")
    marked = (tag for tag in profiles if tag.attributes.get("default", "").lower() in _TRUE)
    return next(marked, profiles[0] if profiles else None)


def _read_gravity(world: Tag, context: ReadContext) -> Vector3:
    """Return gravity: a child of ``<world>`` since SDF 1.6, of ``<physics>`` before."""
    physics = _chosen_physics(world)
    inner = physics.find("gravity") if physics is not None else None
    return vector3_from(world.find("gravity") or inner, _GRAVITY, context)


def _read_physics(world: Tag, context: ReadContext) -> Physics:
    """Return a world's physics profile; the engine's name is kept as a word."""
    tag = _chosen_physics(world)
    if tag is None:
        return _PHYSICS_DEFAULTS
    engine = _engine(tag, context)
    settings = tag.find(engine) or tag
    solver, constraints = settings.find("solver") or tag, settings.find("constraints") or tag
    return Physics(
        name=tag.attributes.get("name", _PHYSICS_DEFAULTS.name),
        engine=engine,
        max_step_size_s=_step_size(tag, context),
        real_time_factor=child_float(tag, "real_time_factor", 1.0, context),
        real_time_update_rate_hz=child_float(tag, "real_time_update_rate", 1000.0, context),
        max_contacts=child_int(tag, "max_contacts", _PHYSICS_DEFAULTS.max_contacts, context),
        solver_type=solver.text_of("type", default=_PHYSICS_DEFAULTS.solver_type),
        solver_iters=child_int(solver, "iters", _PHYSICS_DEFAULTS.solver_iters, context),
        solver_precon_iters=child_int(solver, "precon_iters", 0, context),
        solver_sor=child_float(solver, "sor", _PHYSICS_DEFAULTS.solver_sor, context),
        cfm=child_float(constraints, "cfm", _PHYSICS_DEFAULTS.cfm, context),
        erp=child_float(constraints, "erp", _PHYSICS_DEFAULTS.erp, context),
        contact_max_correcting_vel_m_s=child_float(
            constraints, "contact_max_correcting_vel", 100.0, context
        ),
        contact_surface_layer_m=child_float(constraints, "contact_surface_layer", 0.001, context),
        span=tag.span,
    )


def _read_scene(world: Tag, context: ReadContext) -> Scene:
    """Return how the world looks where nothing stands in the way."""
    view = _view(world, context)
    tag = world.find("scene")
    if tag is None:
        return replace(_SCENE_DEFAULTS, T_world_view=view)
    return Scene(
        ambient=child_rgba(tag, "ambient", _SCENE_DEFAULTS.ambient, context),
        background=child_rgba(tag, "background", _SCENE_DEFAULTS.background, context),
        sky=tag.find("sky") is not None,
        shadows=child_bool(tag, "shadows", True, context),
        grid=child_bool(tag, "grid", True, context),
        T_world_view=view,
        span=tag.span,
    )


def _read_spherical_coordinates(world: Tag, context: ReadContext) -> SphericalCoordinates | None:
    """Return where the world lies on Earth; its axes are east, north and up."""
    tag = world.find("spherical_coordinates")
    if tag is None:
        return None
    orientation = tag.find("world_frame_orientation")
    if orientation is not None and orientation.text.upper() not in ("", "ENU"):
        message = f"world_frame_orientation '{orientation.text}' is not supported; ENU is used"
        context.diagnostics.report("sdf.bad-value", message, orientation.span, fix="write ENU")
    return SphericalCoordinates(
        latitude_deg=child_float(tag, "latitude_deg", 0.0, context),
        longitude_deg=child_float(tag, "longitude_deg", 0.0, context),
        elevation_m=child_float(tag, "elevation", 0.0, context),
        heading_deg=child_float(tag, "heading_deg", 0.0, context),
    )


def _with_state(world: World, tag: Tag, context: ReadContext) -> World:
    """Return the world with the poses that a ``<state>`` holds.

    As Gazebo Classic's World::Load, the first state counts. Poses of models and lights are taken
    over, those of links in models without joints too. Links held by joints keep their place: a
    saved joint position cannot be told from a changed description. Models that the state deletes
    are gone; those it inserts have been read already.
    """
    deleted = {item.text for item in tag.children if item.name == "deletions"}
    deleted |= {name.text for item in tag.find_all("deletions") for name in item.find_all("name")}
    models = {item.attributes.get("name", ""): item for item in tag.find_all("model")}
    lights = {item.attributes.get("name", ""): item for item in tag.find_all("light")}
    return replace(
        world,
        models=tuple(
            _pose_of_state(model, models[model.name], context) if model.name in models else model
            for model in world.models
            if model.name not in deleted
        ),
        lights=tuple(
            _light_of_state(light, lights[light.name], context) if light.name in lights else light
            for light in world.lights
            if light.name not in deleted
        ),
    )


def _engine(tag: Tag, context: ReadContext) -> str:
    word = tag.attributes.get("type", _PHYSICS_DEFAULTS.engine).strip().lower()
    if word in _ENGINES:
        return word
    message = f"physics type '{word}' is not known; 'ode' is used"
    fix = did_you_mean(word, _ENGINES) or "write one of: " + ", ".join(_ENGINES)
    context.diagnostics.report("sdf.bad-value", message, tag.span, fix=fix)
    return _PHYSICS_DEFAULTS.engine


def _step_size(tag: Tag, context: ReadContext) -> float:
    value = child_float(tag, "max_step_size", _PHYSICS_DEFAULTS.max_step_size_s, context)
    if value > 0.0:
        return value
    place = tag.find("max_step_size") or tag
    message = f"<max_step_size> is {value:g} s; it must be positive, 0.001 is used"
    context.diagnostics.report("sdf.bad-value", message, place.span)
    return _PHYSICS_DEFAULTS.max_step_size_s


def _view(world: Tag, context: ReadContext) -> Pose | None:
    """Return where a window's camera is: Gazebo Classic's, or that of a gz window's 3D view."""
    gui = world.find("gui")
    if gui is None:
        return None
    camera = gui.find("camera")
    if camera is not None and camera.find("pose") is not None:
        return pose_of(camera, context)
    for plugin in gui.find_all("plugin"):
        pose = plugin.find("camera_pose")
        if pose is not None:
            return read_pose(pose, context)
    return None


def _light_of_state(light: Light, tag: Tag, context: ReadContext) -> Light:
    return replace(light, T_parent_light=pose_of(tag, context)) if tag.find("pose") else light


def _pose_of_state(model: Model, tag: Tag, context: ReadContext) -> Model:
    if tag.find("pose") is not None:
        model = replace(model, T_world_model=pose_of(tag, context))
    states = {item.attributes.get("name", ""): item for item in tag.find_all("link")}
    moved = tuple(
        _link_of_state(link, model, states.get(link.name), context) for link in model.links
    )
    if moved == model.links:
        return model
    if not model.joints:
        return replace(model, links=moved)
    message = (
        f"the saved state of model '{model.name}' moves links that joints hold; "
        "they start where the description puts them"
    )
    context.diagnostics.report("sdf.state", message, tag.span)
    return model


def _link_of_state(link: Link, model: Model, tag: Tag | None, context: ReadContext) -> Link:
    """Return the link at its saved pose, which is given in the world."""
    if tag is None or tag.find("pose") is None:
        return link
    T_model_link = model.T_world_model.inverse() @ pose_of(tag, context)
    shift = link.T_model_link.matrix() - T_model_link.matrix()
    if float(abs(shift).max()) < _MAX_SHIFT_M:
        return link
    return replace(link, T_model_link=T_model_link)


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
