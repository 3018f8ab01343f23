"""Methods, streams and paths of the world, and what they work on."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass

from gazelle.studio.lazy_parts import Lazy, closed_with
from gazelle.studio.routing import Method, Route, methods_of, methods_without, streams_of
from gazelle.studio.scenes.assets import Assets
from gazelle.studio.streams import StreamKind
from gazelle.studio.subscriptions import Subscriptions
from gazelle.studio.workers import Workers
from gazelle.studio.world.edit import (
    apply_wrench,
    command_joint,
    delete_model,
    get_properties,
    set_light,
    set_pose,
    set_property,
)
from gazelle.studio.world.insert import insert
from gazelle.studio.world.models import list_models, thumbnail
from gazelle.studio.world.streams import (
    Scene,
    open_contacts,
    open_joints,
    open_poses,
    open_scene,
    open_stats,
)
from gazelle.studio.world.world_control import WorldLink, pause, play, reset, set_factor, step

__all__ = ["METHODS", "ROUTES", "STREAMS", "WorldParts", "world_parts"]

_CALLS: dict[str, Method[WorldLink]] = {
    "world.delete": delete_model,
    "world.factor": set_factor,
    "world.insert": insert,
    "world.joint": command_joint,
    "world.light": set_light,
    "world.pause": pause,
    "world.play": play,
    "world.properties": get_properties,
    "world.reset": reset,
    "world.set_pose": set_pose,
    "world.set_property": set_property,
    "world.step": step,
    "world.wrench": apply_wrench,
}
_TOPICS: dict[str, StreamKind[Subscriptions]] = {
    "world.contacts": StreamKind(latest=True, open=open_contacts),
    "world.poses": StreamKind(latest=True, open=open_poses),
    "world.stats": StreamKind(latest=True, open=open_stats),
}
_SCENE: dict[str, StreamKind[Scene]] = {
    "world.joints": StreamKind(latest=True, open=open_joints),
    "world.scene": StreamKind(latest=False, open=open_scene),
}
METHODS: dict[str, Method[WorldParts]] = {
    **methods_of(lambda parts: parts.link, _CALLS),
    **methods_without({"world.models": list_models}),
}
STREAMS: dict[str, StreamKind[WorldParts]] = {
    **streams_of(lambda parts: parts.subscriptions, _TOPICS),
    **streams_of(lambda parts: parts.scene(), _SCENE),
}
ROUTES: dict[str, Route[object]] = {"thumbnail": thumbnail}


@dataclass(frozen=True)
class WorldParts:
    """The world of a graph, if one is running.

    Attributes:
        link: calls it.
        subscriptions: its topics.
        scene: what is in it; followed from the first look on.
    """

    link: WorldLink
    subscriptions: Subscriptions
    scene: Lazy[Scene]


def world_parts(
    subscriptions: Subscriptions, workers: Workers, assets: Assets, ending: ExitStack
) -> WorldParts:
    """Return the parts that end with others."""
    scene = Lazy(lambda: closed_with(ending, Scene(subscriptions, workers, assets)))
    return WorldParts(WorldLink(subscriptions.node), subscriptions, scene)
