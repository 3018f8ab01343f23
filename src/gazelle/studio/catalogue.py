"""All methods, streams and HTTP routes of the protocol, each with what does it.

A part of Studio that adds some keeps them in tables of its own and is named here; nothing is
registered by being imported.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.studio.bags import tables as bags
from gazelle.studio.displays import tables as displays
from gazelle.studio.downloads import download, save_file
from gazelle.studio.files import Route
from gazelle.studio.graph_view import tables as graph_view
from gazelle.studio.motion import tables as motion
from gazelle.studio.params import Params
from gazelle.studio.plugins import tables as plugins
from gazelle.studio.scenes.assets import mesh_answer, texture_answer
from gazelle.studio.scenes.robot import get_robot
from gazelle.studio.session import Studio
from gazelle.studio.settings import tables as settings
from gazelle.studio.streams import StreamKind
from gazelle.studio.world import tables as world

__all__ = ["METHODS", "ROUTES", "STREAMS", "Method"]

Method = Callable[[Studio, Params], Any]
"""Runs in a thread of its own and may wait; returns a JSON value."""

METHODS: dict[str, Method] = {
    **graph_view.METHODS,
    **world.METHODS,
    **bags.METHODS,
    **settings.METHODS,
    **plugins.METHODS,
    **motion.METHODS,
    **displays.METHODS,
    "file.save": save_file,
    "robot.get": get_robot,
}
STREAMS: dict[str, StreamKind] = {
    **graph_view.STREAMS,
    **displays.STREAMS,
    **world.STREAMS,
    **bags.STREAMS,
    **plugins.STREAMS,
    **motion.STREAMS,
}
ROUTES: dict[str, Route] = {
    **world.ROUTES,
    **plugins.ROUTES,
    "file": download,
    "mesh": mesh_answer,
    "texture": texture_answer,
}
"""First part of a path → what answers the rest of it; None is 404."""
