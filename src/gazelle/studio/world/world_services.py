"""What methods and streams of the world work on."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass

from gazelle.studio.lazy import Once, closed_with
from gazelle.studio.scenes.assets import Assets
from gazelle.studio.subscriptions import Taps
from gazelle.studio.workers import Workers
from gazelle.studio.world.streams import Scene
from gazelle.studio.world.world_control import WorldLink

__all__ = ["WorldParts", "world_parts"]


@dataclass(frozen=True)
class WorldParts:
    """The world of a graph, if one is running.

    Attributes:
        link: calls it.
        taps: its topics.
        scene: what is in it; followed from the first look on.
    """

    link: WorldLink
    taps: Taps
    scene: Once[Scene]


def world_parts(taps: Taps, workers: Workers, assets: Assets, ending: ExitStack) -> WorldParts:
    """Return the parts that end with others."""
    scene = Once(lambda: closed_with(ending, Scene(taps, workers, assets)))
    return WorldParts(WorldLink(taps.node), taps, scene)
