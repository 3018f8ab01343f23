"""A graph, bridges to ROS 2, and real nodes of rclpy where they are installed."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable, Iterator

import pytest
from tests.bridge.conftest import Inbox
from tests.bridge.ros2.real import VARIABLE, Ros2
from tests.patience import stretched

from gazelle.bridge.ros2 import Bridge, Interpreter
from gazelle.graph import Graph


@pytest.fixture(scope="session")
def ros2_python() -> str:
    """A Python with the real rclpy; see `skip_module_without_rclpy`."""
    python = os.environ[VARIABLE]
    done = subprocess.run(
        [python, "-c", "import rclpy, std_srvs"], check=False, timeout=stretched(60)
    )
    if done.returncode:
        pytest.skip(f"{VARIABLE}={python} cannot import rclpy and std_srvs")
    return python


@pytest.fixture
def domain(free_port: int) -> int:
    """Keeps the tests of one machine apart."""
    return 100 + free_port % 100


@pytest.fixture
def make_bridge(graph: Graph, ros2_python: str, domain: int) -> Iterator[Callable[..., Bridge]]:
    """Makes bridges that are on the graph as processes of their own would be."""
    made: list[tuple[Graph, Bridge]] = []

    def make(**environ: str) -> Bridge:
        own = Graph.open(port=graph.port, environ={})
        try:
            values = {**os.environ, "ROS_DOMAIN_ID": str(domain), **environ}
            bridge = Bridge(own, [Interpreter(ros2_python, "test")], values)
        except BaseException:
            own.close()
            raise
        made.append((own, bridge))
        return bridge

    yield make
    for own, bridge in reversed(made):
        bridge.close()
        own.close()


@pytest.fixture
def bridge(make_bridge: Callable[..., Bridge]) -> Bridge:
    return make_bridge()


@pytest.fixture
def ros2(ros2_python: str, domain: int) -> Iterator[Ros2]:
    """Runs real nodes."""
    runner = Ros2(ros2_python, domain)
    yield runner
    runner.close()


@pytest.fixture
def notices(graph: Graph) -> Inbox:
    """What the bridge tells the user."""
    heard = Inbox()
    node = graph.create_node("listener", rosout=False)
    node.create_subscription("/rosout", "rcl_interfaces/msg/Log", lambda log: heard(log.msg))
    return heard
