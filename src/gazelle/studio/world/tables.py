"""Methods, streams and paths of the world."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.studio.files import Route
from gazelle.studio.params import Params
from gazelle.studio.session import Studio
from gazelle.studio.streams import StreamKind
from gazelle.studio.world.editing import (
    apply_wrench,
    command_joint,
    delete_model,
    get_properties,
    set_light,
    set_pose,
    set_property,
)
from gazelle.studio.world.inserting import insert
from gazelle.studio.world.models import list_models, thumbnail
from gazelle.studio.world.time import pause, play, reset, set_factor, step
from gazelle.studio.world.watching import (
    open_contacts,
    open_joints,
    open_poses,
    open_scene,
    open_stats,
)

__all__ = ["METHODS", "ROUTES", "STREAMS"]

METHODS: dict[str, Callable[[Studio, Params], Any]] = {
    "world.delete": delete_model,
    "world.factor": set_factor,
    "world.insert": insert,
    "world.joint": command_joint,
    "world.light": set_light,
    "world.models": list_models,
    "world.pause": pause,
    "world.play": play,
    "world.properties": get_properties,
    "world.reset": reset,
    "world.set_pose": set_pose,
    "world.set_property": set_property,
    "world.step": step,
    "world.wrench": apply_wrench,
}
STREAMS: dict[str, StreamKind] = {
    "world.contacts": StreamKind(latest=True, open=open_contacts),
    "world.joints": StreamKind(latest=True, open=open_joints),
    "world.poses": StreamKind(latest=True, open=open_poses),
    "world.scene": StreamKind(latest=False, open=open_scene),
    "world.stats": StreamKind(latest=True, open=open_stats),
}
ROUTES: dict[str, Route] = {"thumbnail": thumbnail}
