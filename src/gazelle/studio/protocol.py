"""All methods, streams and HTTP routes of the protocol, each with what does it.

A part of Studio that adds some keeps them in tables of its own and is named here; nothing is
registered by being imported.
"""

from __future__ import annotations

from gazelle.studio.bags import methods as bags
from gazelle.studio.displays import methods as displays
from gazelle.studio.downloads import download, save_file
from gazelle.studio.graph_view import methods as graph_view
from gazelle.studio.launches import methods as launches
from gazelle.studio.motion import methods as motion
from gazelle.studio.plugins import methods as plugins
from gazelle.studio.robot_files import methods as robot_files
from gazelle.studio.routing import Method, Route, methods_of, methods_without, routes_of, streams_of
from gazelle.studio.scenes.assets import mesh_answer, texture_answer
from gazelle.studio.scenes.robot import get_robot
from gazelle.studio.settings.layouts import (
    delete_layout,
    list_layouts,
    load_layout,
    save_layout,
)
from gazelle.studio.settings.rqt_perspectives import open_perspective
from gazelle.studio.settings.rviz_files import open_rviz
from gazelle.studio.setup_assistant import methods as setup_assistant
from gazelle.studio.streams import StreamKind
from gazelle.studio.studio import Studio
from gazelle.studio.world import methods as world

__all__ = ["METHODS", "ROUTES", "STREAMS"]

_SETTINGS = {
    "layout.delete": delete_layout,
    "layout.list": list_layouts,
    "layout.load": load_layout,
    "layout.save": save_layout,
    "perspective.open": open_perspective,
    "rviz.open": open_rviz,
}

METHODS: dict[str, Method[Studio]] = {
    **methods_of(lambda studio: studio.graph_view, graph_view.METHODS),
    **methods_of(lambda studio: studio.world, world.METHODS),
    **methods_of(lambda studio: studio.bags, bags.METHODS),
    **methods_without(_SETTINGS),
    **methods_without(launches.METHODS),
    **methods_of(lambda studio: studio.demos, launches.DEMO_METHODS),
    **methods_of(lambda studio: studio.shown_panels, plugins.METHODS),
    **methods_of(lambda studio: studio.robots, {**motion.METHODS, "robot.get": get_robot}),
    **methods_of(lambda studio: studio.robot_files, robot_files.METHODS),
    **methods_of(lambda studio: studio.setup_assistant, setup_assistant.METHODS),
    **displays.METHODS,
    **methods_of(lambda studio: studio.downloads, {"file.save": save_file}),
}
STREAMS: dict[str, StreamKind[Studio]] = {
    **streams_of(lambda studio: studio.graph_view, graph_view.STREAMS),
    **streams_of(lambda studio: studio.displays, displays.STREAMS),
    **streams_of(lambda studio: studio.world, world.STREAMS),
    **streams_of(lambda studio: studio.bags, bags.STREAMS),
    **streams_of(lambda studio: studio.node.graph.port, launches.STREAMS),
    **streams_of(lambda studio: studio.shown_panels, plugins.STREAMS),
    **streams_of(lambda studio: studio.subscriptions, motion.STREAMS),
}
ROUTES: dict[str, Route[Studio]] = {
    **world.ROUTES,
    **launches.ROUTES,
    **routes_of(lambda studio: studio.shown_panels, plugins.ROUTES),
    **routes_of(lambda studio: studio.downloads, {"file": download}),
    **routes_of(lambda studio: studio.assets, {"mesh": mesh_answer, "texture": texture_answer}),
}
"""First part of a path → what answers the rest of it; None is 404."""
