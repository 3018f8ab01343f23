"""Streams of the world: the scene, and what moves in it."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable
from typing import Any, TypedDict

from gazelle.graph import Entity, Kind
from gazelle.sensors.scene_json_types import SceneValue, WorldGeometry
from gazelle.studio.errors import unknown
from gazelle.studio.request_params import Params
from gazelle.studio.scenes.assets import Assets
from gazelle.studio.scenes.shapes import PageGeometry, page_scene
from gazelle.studio.streams import Channel, Frame, OpenStream
from gazelle.studio.subscriptions import Sample, Subscriptions
from gazelle.studio.workers import Workers

__all__ = [
    "Scene",
    "WorldJoint",
    "open_contacts",
    "open_joints",
    "open_poses",
    "open_scene",
    "open_stats",
]

_SCENE = "/_gazelle/scene"
_POSES, _CONTACTS = 1, 3

PageScene = SceneValue[PageGeometry]


class WorldJoint(TypedDict):
    """A joint of the stream `world.joints`; rad or m.

    Attributes:
        lower: null where there is no limit.
    """

    name: str
    type: str
    position: float
    velocity: float
    effort: float
    lower: float | None
    upper: float | None


class Scene:
    """The world's scene value as it is now, for all pages; None while there is no world.

    Attributes:
        subscriptions: topics; what moves in the scene is on some of them.
        close: follows the world no more.
    """

    def __init__(self, subscriptions: Subscriptions, workers: Workers, assets: Assets) -> None:
        """Follow the world of a graph; workers read meshes, `assets` keeps them."""
        self.subscriptions = subscriptions
        self._workers = workers
        self._assets = assets
        self._lock = threading.Lock()
        self._followers: list[Channel] = []
        self._value: PageScene | None = None
        self._count = self._shown = 0
        subscriptions.node.graph.discovery.listen(self._on_entity)
        self.close: Callable[[], None] = subscriptions.listen(_SCENE, self._take)

    @property
    def value(self) -> PageScene | None:
        """The newest scene value."""
        return self._value

    def follow(self, channel: Channel) -> Callable[[], None]:
        """Send a channel the scene now and at every change."""
        with self._lock:
            self._followers.append(channel)
            channel.add(self._value)

        def leave() -> None:
            with self._lock:
                self._followers.remove(channel)

        return leave

    def _take(self, sample: Sample) -> None:
        # Meshes are read for it, which takes its time: not in the transport's thread.
        self._later(lambda: json.loads(sample.message().data))

    def _on_entity(self, entity: Entity, is_there: bool) -> None:
        if entity.name == _SCENE and entity.kind is Kind.PUBLISHER and not is_there:
            self._later(lambda: None)

    def _later(self, make: Callable[[], SceneValue[WorldGeometry] | None]) -> None:
        with self._lock:
            self._count += 1
            number = self._count
        self._workers.submit(lambda: self._show(number, make()))

    def _show(self, number: int, value: SceneValue[WorldGeometry] | None) -> None:
        finished = None if value is None else page_scene(value, self._assets)
        with self._lock:
            # Workers do not finish in order.
            if number <= self._shown:
                return
            self._shown, self._value = number, finished
            for channel in self._followers:
                channel.add(finished)


def open_scene(scene: Scene, channel: Channel, _params: Params) -> OpenStream:
    """Stream ``world.scene``."""
    return OpenStream(scene.follow(channel))


def open_poses(subscriptions: Subscriptions, channel: Channel, _params: Params) -> OpenStream:
    """Stream ``world.poses``."""
    return _frames(subscriptions, channel, "/_gazelle/poses", _POSES)


def open_contacts(subscriptions: Subscriptions, channel: Channel, _params: Params) -> OpenStream:
    """Stream ``world.contacts``."""
    return _frames(subscriptions, channel, "/_gazelle/contacts", _CONTACTS)


def open_stats(subscriptions: Subscriptions, channel: Channel, _params: Params) -> OpenStream:
    """Stream ``world.stats``."""

    def take(sample: Sample) -> None:
        channel.offer(lambda: json.loads(sample.message().data))

    return OpenStream(subscriptions.listen("/_gazelle/stats", take))


def open_joints(scene: Scene, channel: Channel, params: Params) -> OpenStream:
    """Stream ``world.joints`` of one model."""
    model, value = params.text("model"), scene.value
    names = [one["name"] for one in value["models"]] if value is not None else []
    if model not in names:
        raise unknown("model", model, names)

    def take(sample: Sample) -> None:
        channel.offer(lambda: _joint_rows(scene.value, model, sample.message()))

    return OpenStream(scene.subscriptions.listen("/_gazelle/joints", take))


def _frames(subscriptions: Subscriptions, channel: Channel, topic: str, kind: int) -> OpenStream:
    def make(sample: Sample) -> Frame:
        message = sample.message()
        count = len(message.values) // message.width
        return Frame(kind, count, message.stamp, (message.values.tobytes(),))

    def take(sample: Sample) -> None:
        channel.offer(lambda: make(sample))

    return OpenStream(subscriptions.listen(topic, take))


def _joint_rows(scene: PageScene | None, model: str, frames: Any) -> list[WorldJoint] | None:
    if scene is None or scene["version"] != frames.version:
        return None
    rows = frames.values.reshape(-1, frames.width).tolist()
    described = {
        f"{one['name']}::{scene['joints'][index]['name']}": scene["joints"][index]
        for one in scene["models"]
        for index in one["joints"]
    }
    return [
        {
            "name": joint["name"],
            "type": joint["type"],
            "position": position,
            "velocity": velocity,
            "effort": effort,
            "lower": joint["lower"],
            "upper": joint["upper"],
        }
        for name, (position, velocity, effort) in zip(scene["moving"], rows, strict=True)
        if name.startswith(f"{model}::") and (joint := described.get(name)) is not None
    ]
