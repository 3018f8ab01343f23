"""All methods, streams and HTTP routes of the protocol, each with what does it.

A part of Studio that adds some keeps them in tables of its own and is named here; nothing is
registered by being imported.
"""

from __future__ import annotations

from gazelle.studio.bags import methods as bags
from gazelle.studio.displays import tables as displays
from gazelle.studio.downloads import download, save_file
from gazelle.studio.graph_view import methods as graph_view
from gazelle.studio.motion import tables as motion
from gazelle.studio.plugins import tables as plugins
from gazelle.studio.routing import Method, Route, methods_of, routes_of, streams_of
from gazelle.studio.scenes.assets import mesh_answer, texture_answer
from gazelle.studio.scenes.robot import get_robot
from gazelle.studio.settings import tables as settings
from gazelle.studio.streams import StreamKind
from gazelle.studio.studio import Studio
from gazelle.studio.world import methods as world

__all__ = ["METHODS", "ROUTES", "STREAMS"]

METHODS: dict[str, Method[Studio]] = {
    **methods_of(lambda studio: studio.graph_view, graph_view.METHODS),
    **methods_of(lambda studio: studio.world, world.METHODS),
    **methods_of(lambda studio: studio.bags, bags.METHODS),
    **settings.METHODS,
    **methods_of(lambda studio: studio.desk, plugins.METHODS),
    **methods_of(lambda studio: studio.robots, {**motion.METHODS, "robot.get": get_robot}),
    **displays.METHODS,
    **methods_of(lambda studio: studio.downloads, {"file.save": save_file}),
}
STREAMS: dict[str, StreamKind[Studio]] = {
    **streams_of(lambda studio: studio.graph_view, graph_view.STREAMS),
    **streams_of(lambda studio: studio.displays, displays.STREAMS),
    **streams_of(lambda studio: studio.world, world.STREAMS),
    **streams_of(lambda studio: studio.bags, bags.STREAMS),
    **streams_of(lambda studio: studio.desk, plugins.STREAMS),
    **streams_of(lambda studio: studio.taps, motion.STREAMS),
}
ROUTES: dict[str, Route[Studio]] = {
    **world.ROUTES,
    **routes_of(lambda studio: studio.desk, plugins.ROUTES),
    **routes_of(lambda studio: studio.downloads, {"file": download}),
    **routes_of(lambda studio: studio.assets, {"mesh": mesh_answer, "texture": texture_answer}),
}
"""First part of a path → what answers the rest of it; None is 404."""
