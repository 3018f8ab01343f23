"""Pictures of robots and worlds for people: framed, lit, with what is else not seen on top."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import CameraSpec, Light, LightType, Link, Model, Scene, World
from gazelle.diagnostics import Diagnostics, nearest_names
from gazelle.errors import NotFoundError
from gazelle.geometry import Pose
from gazelle.rich_display import shown_by
from gazelle.sensors.camera import render
from gazelle.sensors.ray_scene import RayScene
from gazelle.sensors.view_cameras import Shot, camera_spec, fitting_camera, view_direction
from gazelle.sensors.view_overlays import OVERLAYS, overlay_world, scene_points

__all__ = ["SHOWN", "Picture", "lit_world", "take_picture"]

SHOWN = ("visuals", *OVERLAYS)
"""What `take_picture` can show."""

MAX_PX = 8192
_MIN_PX = 16
_SAMPLES = 2
"""Rendered pixels per pixel of the picture, each way."""

_WEIGHTS = {
    "collisions": (0.5, 0.3),
    "inertia": (0.25, 0.2),
    "inertia_edges": (1.0, 0.6),
    "com": (1.0, 0.8),
    "joints": (1.0, 0.7),
    "frames": (1.0, 0.7),
}
"""How much of an overlay's colour is laid over the picture, in front of visuals and inside."""

_PAINTED = {"inertia": ("inertia", "inertia_edges")}
"""Overlays of several layers; boxes far too large must not hide the robot they belong to."""

_BACKGROUND = (0.93, 0.94, 0.96, 1.0)
_STUDIO = (
    Light(
        "key",
        LightType.DIRECTIONAL,
        diffuse=(0.6, 0.6, 0.6, 1.0),
        specular=(0.1, 0.1, 0.1, 1.0),
        direction=(-0.5, 0.35, -0.8),
        cast_shadows=True,
    ),
    Light(
        "fill",
        LightType.DIRECTIONAL,
        diffuse=(0.25, 0.25, 0.25, 1.0),
        specular=(0.0, 0.0, 0.0, 1.0),
        direction=(0.4, -0.6, 0.5),
    ),
)


@shown_by("cameras:picture_bundle")
class Picture(NamedTuple):
    """A picture, (H, W, 3) uint8, and the views it is made of."""

    rgb: NDArray[np.uint8]
    shots: tuple[Shot, ...]


@dataclass(frozen=True, slots=True)
class _Layer:
    kind: str
    scene: RayScene


def take_picture(
    world: World,
    *,
    show: Sequence[str] = ("visuals",),
    views: Sequence[str] = ("iso",),
    T_world_camera: Pose | None = None,
    size_px: tuple[int, int] = (800, 600),
    background: tuple[float, float, float] | None = None,
    diagnostics: Diagnostics | None = None,
) -> Picture:
    """Draw a world as it stands, all of it in the picture, the same every time.

    A world without lights (a robot, a model) gets two lamps and a light background; others are
    shown under their own. Overlays shine through visuals in a weaker colour.

    Args:
        world: with joints where they are to be shown, see `gazelle.description.forward_kinematics`.
        show: of `SHOWN`.
        views: of `gazelle.sensors.view_cameras.VIEWS`; several share the picture in a grid.
        T_world_camera: in place of views, looks along +x.
        size_px: width and height of the whole picture.
        background: red, green, blue, 0…1, in place of the world's own.
        diagnostics: receives what was found about meshes and inertias.

    Raises:
        EmbreeError: Embree cannot be loaded.
        NotFoundError: a word of `show` or `views` is unknown.
        ValueError: the size is out of range for so many views, or there is nothing to show.
    """
    found = Diagnostics() if diagnostics is None else diagnostics
    _check(show, views)
    scenery = lit_world(world, background)
    layers, points = _layers(scenery, show, found)
    names = views if T_world_camera is None else ("camera",)
    shots = []
    for name, left, top, spec in _grid(names, size_px):
        camera = T_world_camera or fitting_camera(points, view_direction(name), spec)
        shots.append(Shot(name, camera, _clipped(spec, camera, points), left, top))
    rgb = np.empty((size_px[1], size_px[0], 3), np.uint8)
    rgb[:] = [round(255 * value) for value in scenery.scene.background[:3]]
    for shot in shots:
        rows = slice(shot.top_px, shot.top_px + shot.spec.height_px)
        columns = slice(shot.left_px, shot.left_px + shot.spec.width_px)
        rgb[rows, columns] = _exposed(shot, layers)
    return Picture(rgb, tuple(shots))


def lit_world(world: World, background: tuple[float, float, float] | None = None) -> World:
    """Return a world to look at: one without lights (a robot, a model) gets two lamps.

    Args:
        world: what is shown.
        background: red, green, blue, 0…1, in place of the world's own.
    """
    scene, lights = world.scene, world.lights
    if not lights:
        lights = _STUDIO
        scene = Scene(ambient=(0.4, 0.4, 0.4, 1.0), background=_BACKGROUND)
    if background is not None:
        scene = replace(scene, background=(*background, 1.0), sky=False)
    return replace(world, lights=lights, scene=scene)


def _check(show: Sequence[str], views: Sequence[str]) -> None:
    for word in show:
        if word not in SHOWN:
            hint = f"one can show: {', '.join(SHOWN)}"
            raise NotFoundError("overlay", word, nearest=nearest_names(word, SHOWN), hint=hint)
    if not show or not views:
        raise ValueError("a picture needs something to show and a view of it")
    for view in views:
        view_direction(view)


def _layers(
    world: World, show: Sequence[str], diagnostics: Diagnostics
) -> tuple[list[_Layer], NDArray[np.float64]]:
    """Return what is drawn, bottom first, and points that must be in the picture."""
    seen = RayScene(world, diagnostics=diagnostics)
    touched = RayScene(
        overlay_world(world, "collisions", {}, diagnostics), diagnostics=Diagnostics()
    )
    sizes = _sizes(scene_points(seen), scene_points(touched))
    bottom = seen if "visuals" in show else RayScene(_bare(world), diagnostics=diagnostics)
    layers = [_Layer("visuals", bottom)]
    for kind in OVERLAYS:
        if kind in show:
            for part in _PAINTED.get(kind, (kind,)):
                drawn = overlay_world(world, part, sizes, diagnostics)
                layers.append(_Layer(part, RayScene(drawn, diagnostics=Diagnostics())))
    clouds = [*scene_points(seen).values(), *scene_points(touched).values(), _origins(world)]
    points = np.concatenate(clouds)
    if not len(points):
        raise ValueError("there is nothing to show: the world has no links")
    return layers, points


def _bare(world: World) -> World:
    return replace(world, models=tuple(map(_bare_model, world.models)))


def _bare_model(model: Model) -> Model:
    def bare(link: Link) -> Link:
        return replace(link, visuals=())

    return replace(model, links=tuple(map(bare, model.links)))


def _sizes(*clouds: dict[str, NDArray[np.float64]]) -> dict[str, float]:
    """Return the diagonal of the box around each model's points."""
    merged: dict[str, list[NDArray[np.float64]]] = {}
    for cloud in clouds:
        for name, points in cloud.items():
            merged.setdefault(name, []).append(points)
    return {
        name: float(np.linalg.norm(np.ptp(np.concatenate(points), axis=0)))
        for name, points in merged.items()
    }


def _origins(world: World) -> NDArray[np.float64]:
    places = [
        (model.T_world_model @ link.T_model_link).position_m
        for model in world.models
        for link in model.links
    ]
    return np.array(places, np.float64).reshape(-1, 3)


def _grid(views: Sequence[str], size_px: tuple[int, int]) -> list[tuple[str, int, int, CameraSpec]]:
    columns = math.ceil(math.sqrt(len(views)))
    rows = math.ceil(len(views) / columns)
    width, height = size_px[0] // columns, size_px[1] // rows
    if min(width, height) < _MIN_PX or max(size_px) > MAX_PX:
        raise ValueError(
            f"{size_px[0]}x{size_px[1]} pixels do not do for {len(views)} view(s): each needs "
            f"{_MIN_PX} at least, and no side may exceed {MAX_PX}"
        )
    spec = camera_spec(width, height)
    return [
        (view, number % columns * width, number // columns * height, spec)
        for number, view in enumerate(views)
    ]


def _clipped(spec: CameraSpec, camera: Pose, points: NDArray[np.float64]) -> CameraSpec:
    """Set clip distances around everything, with room for grounds that are not framed."""
    farthest = float(np.linalg.norm(points - np.array(camera.position_m), axis=1).max())
    return replace(spec, near_m=max(1e-4 * farthest, 1e-6), far_m=50.0 * farthest + 1000.0)


def _exposed(shot: Shot, layers: Sequence[_Layer]) -> NDArray[np.uint8]:
    """Render all layers finely, lay them over each other, and average down."""
    width, height = shot.spec.width_px, shot.spec.height_px
    spec = replace(shot.spec, width_px=width * _SAMPLES, height_px=height * _SAMPLES)
    bottom = render(layers[0].scene, spec, shot.T_world_camera, want_depth=True)
    assert bottom.rgb is not None
    assert bottom.depth_m is not None
    colour = bottom.rgb.astype(np.float32)
    is_bare = not layers[0].scene.instances
    for layer in layers[1:]:
        record = render(layer.scene, spec, shot.T_world_camera, want_depth=True)
        assert record.rgb is not None
        assert record.depth_m is not None
        hit = np.isfinite(record.depth_m)
        front = hit & (record.depth_m <= bottom.depth_m * np.float32(1.0 + 1e-4))
        weights = np.zeros(hit.shape, np.float32)
        in_front, inside = _WEIGHTS[layer.kind]
        weights[hit] = inside
        weights[front] = 1.0 if is_bare and layer.kind == "collisions" else in_front
        colour += weights[:, :, None] * (record.rgb - colour)
    tiles = colour.reshape(height, _SAMPLES, width, _SAMPLES, 3)
    return np.asarray(tiles.mean(axis=(1, 3)) + np.float32(0.5)).astype(np.uint8)
