"""A world on a graph with a controller manager in it, for nodes and commands that talk to one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import pytest
from tests.control.fake_robot import RECORDER, Recorder, fake_robot

from gazelle.control.controller_manager import ControllerManager
from gazelle.control.controllers import registry
from gazelle.control.parameter_sources.ros1_parameter_server import StoreSource
from gazelle.control.parameter_sources.ros2_controller_parameters import FileSource
from gazelle.description.model import World
from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph
from gazelle.simulator.controller_node import make_ports, offer_manager
from gazelle.simulator.plugins.context import Resources
from gazelle.simulator.world_server import ServerSettings, WorldServer


@contextmanager
def manager_world(
    graph: Graph,
    monkeypatch: pytest.MonkeyPatch,
    ros_version: int = 1,
    controllers: Mapping[str, Mapping[str, Any]] | None = None,
    *,
    namespace: str = "/mira",
) -> Iterator[ControllerManager]:
    """Run a paused world with a manager; controllers ``left`` and ``right`` are configured."""
    monkeypatch.setattr(registry, "_by_type", lambda: {RECORDER: Recorder})
    wanted = controllers or {"left": {"joint": "left"}, "right": {"joint": "right"}}
    node = graph.create_node("gazebo")
    server = WorldServer(World(), node=node, settings=ServerSettings(paused=True))
    resources = Resources(server)
    source: Any
    if ros_version == 1:
        for name, values in wanted.items():
            node.parameters.set(f"{namespace}/{name}", {"type": RECORDER, **values})
        source = StoreSource(node.parameters, namespace)
    else:
        overrides = {name: {"type": RECORDER, **values} for name, values in wanted.items()}
        source = FileSource([], namespace, Diagnostics(), overrides=overrides)
    manager = ControllerManager(
        fake_robot(ros_version)[0],
        namespace=namespace,
        make_ports=lambda name: make_ports(server, resources, namespace, name, ros_version),
        source=source,
        diagnostics=Diagnostics(),
        update_rate_hz=100.0,
    )
    offer_manager(manager, server, resources)
    try:
        yield manager
    finally:
        resources.close()
        server.close()
