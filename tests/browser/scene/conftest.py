"""Pages with RViz's and Gazebo's panels, on graphs and worlds of the test's own."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from typing import Any

import pytest
from tests.browser.scene.gazebo_page import GazeboPage
from tests.browser.scene.rviz_page import RvizPage
from tests.patience import eventually, stretched

from gazelle.graph import Graph
from gazelle.simulator import Simulation
from gazelle.simulator.gazebo_ros.api import offer_gazebo_ros
from gazelle.simulator.gui import offer_views
from gazelle.simulator.wall_clock import Mode
from gazelle.studio import Server, Studio


@pytest.fixture
def rviz(bench: Any, look: Any) -> RvizPage:
    """The page that `rviz` opens; frames map → odom → base_link are on tf."""
    transforms = [
        _transform("map", "odom", 0.5, 0.0),
        _transform("odom", "base_link", 1.0, 0.0),
    ]
    bench.keep_publishing(
        "/tf", "tf2_msgs/msg/TFMessage", lambda _: {"transforms": transforms}, hz=15
    )
    return RvizPage(look(bench.url, "rviz"), bench)


def _transform(parent: str, child: str, x: float, y: float) -> dict[str, Any]:
    return {
        "header": {"frame_id": parent},
        "child_frame_id": child,
        "transform": {
            "translation": {"x": x, "y": y, "z": 0.0},
            "rotation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0},
        },
    }


@pytest.fixture
def gazebo(free_port: int, look: Any) -> Iterator[GazeboPage]:
    """The page that `gzclient` opens, on a paused world with ground and sun."""
    graph = Graph.open(port=free_port, environ={}, role="hub")
    server = Simulation.load(None, node=graph.create_node("gazebo", rosout=False)).server
    server.mode = Mode.REAL_TIME
    server.pause()
    offer_gazebo_ros(server)
    offer_views(server)
    running = threading.Thread(target=server.run)
    running.start()
    with Server(Studio(graph), port=0) as studio:
        seen = look(studio.url, "gzclient", size=(1440, 900))
        # The world ends before its page does.
        seen.expect_problem("ERR_CONNECTION_REFUSED|ERR_EMPTY_RESPONSE|ERR_CONNECTION_RESET")
        yield GazeboPage(seen, server, eventually)
    server.close()
    running.join(stretched())
    graph.close()
