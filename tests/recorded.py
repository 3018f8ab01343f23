"""Recordings that are made by hand: a cart that rolls along +x, with topics of any name."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gazelle.description.model import (
    Box,
    CameraSpec,
    Light,
    LightType,
    Link,
    Material,
    Model,
    Plane,
    Sensor,
    Sphere,
    Visual,
    World,
)
from gazelle.geometry import Pose
from gazelle.interfaces import fill, message_type
from gazelle.recording import Recording, Stretch, TopicTrack

__all__ = ["cart_world", "messages", "rolling"]

_RED = Material(diffuse=(0.9, 0.1, 0.1, 1.0), ambient=(0.9, 0.1, 0.1, 1.0))
_GREY = Material(diffuse=(0.6, 0.6, 0.6, 1.0), ambient=(0.6, 0.6, 0.6, 1.0))
_EYE = Sensor("eye", "camera", CameraSpec(horizontal_fov_rad=1.2), Pose((0.25, 0.0, 0.1)))


def cart_world(name: str = "cart") -> World:
    """A ground, a sun, and a cart of two links with a camera."""
    body = Link(
        "body",
        Pose((0.0, 0.0, 0.15)),
        visuals=(Visual("box", Box((0.4, 0.3, 0.2)), material=_RED),),
        sensors=(_EYE,),
    )
    ball = Link("ball", Pose((0.0, 0.0, 0.3)), visuals=(Visual("ball", Sphere(0.06)),))
    ground = Link("link", visuals=(Visual("ground", Plane(size_m=(50.0, 50.0)), material=_GREY),))
    sun = Light("sun", LightType.DIRECTIONAL, direction=(-0.4, 0.3, -0.9), cast_shadows=True)
    models = (Model("ground", static=True, links=(ground,)), Model(name, links=(body, ball)))
    return World(name="yard", models=models, lights=(sun,))


def rolling(
    seconds: float = 2.0,
    *,
    name: str = "cart",
    speed_m_s: float = 1.0,
    topics: tuple[TopicTrack, ...] = (),
    rate_hz: int = 50,
) -> Recording:
    """The cart rolls; its ball turns about z."""
    times = np.arange(round(seconds * rate_hz) + 1) * (1_000_000_000 // rate_hz)
    poses = np.zeros((len(times), 3, 7), np.float32)
    poses[:, :, 6] = 1.0
    poses[:, 1:, 0] = speed_m_s * times[:, None] * 1e-9
    poses[:, 1, 2], poses[:, 2, 2] = 0.15, 0.3
    angles = times * 1e-9
    poses[:, 2, 5], poses[:, 2, 6] = np.sin(angles / 2), np.cos(angles / 2)
    names = ("ground::link", f"{name}::body", f"{name}::ball")
    return Recording((Stretch(cart_world(name), names, times, poses),), topics)


def messages(name: str, type_name: str, seconds: float, rate_hz: float, fields: Any) -> TopicTrack:
    """A topic whose messages have the fields that a function gives for a time (s)."""
    times = np.arange(math.floor(seconds * rate_hz)) / rate_hz
    kind = message_type(type_name)
    made = []
    for time_s in times.tolist():
        message = kind()
        fill(message, fields(time_s))
        made.append(message)
    return TopicTrack(name, kind.TYPE_NAME, np.round(times * 1e9).astype(np.int64), tuple(made))
