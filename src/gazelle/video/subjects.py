"""What a film is about: the robots of a recording, where they are, and what hides them."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import CameraSpec, Model, World
from gazelle.diagnostics import Diagnostics, nearest_names
from gazelle.errors import NotFoundError
from gazelle.geometry import Vector3
from gazelle.recording import Recording, Stretch
from gazelle.recording.recording import robot_names
from gazelle.sensors.camera import render
from gazelle.sensors.ray_scene import RayScene
from gazelle.sensors.view_cameras import looking_at
from gazelle.sensors.view_overlays import scene_points

__all__ = ["Subject", "free_direction", "subject_of"]

_LOOKS = 12
"""Moments at which a recording is looked at to place a camera."""

_SIDES = 8
_STEEP = 1.8
_PROBE_PX = 12
# What stands in for a robot that has no visuals at all.
_BARE_M = 0.3


class Subject(NamedTuple):
    """One or more models over the time of a recording.

    Attributes:
        models: their names.
        times_ns: (L,) when they were looked at.
        clouds: for each time points whose hull holds all that is seen of them, world frame, m.
    """

    models: tuple[str, ...]
    times_ns: tuple[int, ...]
    clouds: tuple[NDArray[np.float64], ...]

    @property
    def middles(self) -> NDArray[np.float64]:
        """(L, 3): the middle of the box around the points of each time."""
        return np.array([(one.min(axis=0) + one.max(axis=0)) / 2.0 for one in self.clouds])

    @property
    def radius_m(self) -> float:
        """Of a ball around the middle that holds the points of any time."""
        return max(
            float(np.linalg.norm(cloud - middle, axis=1).max())
            for cloud, middle in zip(self.clouds, self.middles, strict=True)
        )

    @property
    def travel_m(self) -> float:
        """How far apart the middles are."""
        return float(np.linalg.norm(np.ptp(self.middles, axis=0)))


def subject_of(recording: Recording, model: str | None = None) -> Subject:
    """Return what to look at.

    Args:
        recording: what happened.
        model: its name; the robots when None: models of several links that are not static,
            otherwise whatever is not static, otherwise everything.

    Raises:
        NotFoundError: the recording has no such model.
    """
    last = recording.stretches[-1]
    names = _robots(last.world) if model is None else (_named(recording, model),)
    begin_ns = min(one.times_ns[0] for one in recording.stretches if _has(one.world, names))
    times = np.linspace(begin_ns, recording.end_ns, _LOOKS).astype(np.int64)
    unique = tuple(dict.fromkeys(times.tolist()))
    scenes: dict[int, RayScene] = {}
    clouds, seen = [], []
    for time_ns in unique:
        stretch = recording.stretch_at(time_ns)
        scene = scenes.get(id(stretch))
        if scene is None:
            scene = scenes[id(stretch)] = RayScene(_only(stretch.world, names),
                                                   diagnostics=Diagnostics())  # fmt: skip
        cloud = _cloud(stretch, scene, names, time_ns)
        if len(cloud):
            clouds.append(cloud)
            seen.append(time_ns)
    return Subject(names, tuple(seen), tuple(clouds))


def free_direction(
    recording: Recording, subject: Subject, direction: Vector3, distance_m: float
) -> Vector3:
    """Return the direction nearest to one from which nothing hides the subject.

    It is looked at from eight sides, then from higher up, at a few times; where all sides are
    hidden at times, the one that is hidden least.

    Args:
        recording: what happened.
        subject: what is to be seen.
        direction: from it to the camera.
        distance_m: between both.
    """
    stretch = recording.stretches[-1]
    others = _without(stretch.world, subject.models)
    scene = RayScene(others, diagnostics=Diagnostics())
    if not scene.instances:
        return direction
    middles = subject.middles[:: max(1, len(subject.times_ns) // 4)]
    times = subject.times_ns[:: max(1, len(subject.times_ns) // 4)]
    best, least = direction, math.inf
    for candidate in _candidates(direction):
        hidden = 0.0
        for middle, time_ns in zip(middles, times, strict=True):
            scene.update(recording.stretch_at(time_ns).moment(time_ns))
            hidden += _hidden_share(scene, middle, candidate, distance_m, subject.radius_m)
        if hidden < least - 0.02:
            best, least = candidate, hidden
        if least < 0.02:
            break
    return best


def _candidates(direction: Vector3) -> list[Vector3]:
    x, y, z = direction
    turns = [math.ceil(k / 2) * (1 if k % 2 else -1) * 2 * math.pi / _SIDES for k in range(_SIDES)]
    return [
        (x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn), height)
        for height in (z, z * _STEEP + 0.4)
        for turn in turns
    ]


def _hidden_share(
    scene: RayScene,
    middle: NDArray[np.float64],
    direction: Vector3,
    distance_m: float,
    radius_m: float,
) -> float:
    away = np.array(direction) / np.linalg.norm(direction)
    eye = middle + distance_m * away
    camera = looking_at((eye[0], eye[1], eye[2]), (middle[0], middle[1], middle[2]))
    angle = 2.0 * math.atan2(0.7 * radius_m, distance_m)
    probe = CameraSpec("probe", horizontal_fov_rad=angle, width_px=_PROBE_PX, height_px=_PROBE_PX,
                       near_m=1e-3, far_m=2.0 * distance_m)  # fmt: skip
    depth = render(scene, probe, camera, want_rgb=False, want_depth=True, threads=1).depth_m
    assert depth is not None
    return float((depth < distance_m - 0.5 * radius_m).mean())


def _cloud(
    stretch: Stretch, scene: RayScene, names: tuple[str, ...], time_ns: int
) -> NDArray[np.float64]:
    moment = stretch.moment(time_ns)
    scene.update(moment)
    points = [cloud for name, cloud in scene_points(scene).items() if name in names]
    if points:
        return np.concatenate(points)
    rows = [
        moment.T[row, :3]
        for row, name in enumerate(moment.link_names)
        if name.partition("::")[0] in names
    ]
    if not rows:
        return np.zeros((0, 3))
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    return np.concatenate([row + _BARE_M * corners for row in rows])


def _robots(world: World) -> tuple[str, ...]:
    free = [model for model in world.models if not model.static]
    return robot_names(world) or tuple(model.name for model in free or world.models)


def _named(recording: Recording, model: str) -> str:
    names = dict.fromkeys(one.name for two in recording.stretches for one in two.world.models)
    if model not in names:
        hint = f"models there: {', '.join(names) or 'none'}"
        raise NotFoundError("model", model, nearest=nearest_names(model, names), hint=hint)
    return model


def _has(world: World, names: tuple[str, ...]) -> bool:
    return any(model.name in names for model in world.models) or not names


def _only(world: World, names: tuple[str, ...]) -> World:
    return replace(world, models=tuple(one for one in world.models if one.name in names))


def _without(world: World, names: tuple[str, ...]) -> World:
    """Return what may hide them: the rest of the world, but no endless grounds."""

    def bare(model: Model) -> bool:
        return model.name in names

    return replace(world, models=tuple(one for one in world.models if not bare(one)))
