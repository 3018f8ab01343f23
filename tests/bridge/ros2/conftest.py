"""A graph, bridges to ROS 2, and real nodes of rclpy where they are installed."""

from __future__ import annotations

import os
import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from tests.bridge.ros2.real import Ros2

from gazelle.bridge.ros2 import Bridge, Interpreter
from gazelle.graph import Graph

_PATIENCE_S = 20.0
_VARIABLE = "GAZELLE_TEST_ROS2_PYTHON"


class Inbox:
    """Collects what a callback gets and lets a test wait for it."""

    def __init__(self) -> None:
        self.items: list[Any] = []
        self._changed = threading.Condition()

    def __call__(self, item: Any) -> None:
        with self._changed:
            self.items.append(item)
            self._changed.notify_all()

    def wait_for(self, count: int) -> list[Any]:
        with self._changed:
            assert self._changed.wait_for(lambda: len(self.items) >= count, _PATIENCE_S), self.items
            return list(self.items)


@pytest.fixture
def inbox() -> Inbox:
    return Inbox()


@pytest.fixture
def eventually() -> Callable[[Callable[[], Any]], Any]:
    """Waits until a condition gives something true, and returns it."""

    def wait(condition: Callable[[], Any]) -> Any:
        deadline = time.monotonic() + _PATIENCE_S
        pause = threading.Event()
        while not (found := condition()):
            assert time.monotonic() < deadline, "did not happen in time"
            pause.wait(0.005)
        return found

    return wait


@pytest.fixture
def graph(free_port: int) -> Iterator[Graph]:
    """What the robot's side has joined; carries the hub."""
    with Graph.open(port=free_port, environ={}) as opened:
        yield opened


@pytest.fixture(scope="session")
def ros2_python() -> str:
    """A Python with the real rclpy; skips where none is named."""
    python = os.environ.get(_VARIABLE, "")
    if not python:
        pytest.skip(f"{_VARIABLE} does not name a Python with rclpy (ROS 2, or pip: ros-rclpy …)")
    done = subprocess.run([python, "-c", "import rclpy, std_srvs"], check=False, timeout=60)
    if done.returncode:
        pytest.skip(f"{_VARIABLE}={python} cannot import rclpy and std_srvs")
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
