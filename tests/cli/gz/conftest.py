"""A world without a server process: its services on a real graph."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

from gazelle.cli.main import main
from gazelle.geometry import Pose
from gazelle.graph import Graph
from gazelle.simulator import Simulation
from gazelle.simulator.gazebo_ros.api import offer_gazebo_ros
from gazelle.workspace import Workspace

ARM = """<robot name="arm"><link name="base"><inertial><mass value="1"/>
  <inertia ixx="0.5" ixy="0" ixz="0" iyy="0.5" iyz="0" izz="0.5"/></inertial></link>
  <joint name="swing" type="revolute"><parent link="base"/><child link="bob"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="50" velocity="9"/></joint>
  <link name="bob"><inertial><mass value="1"/>
    <inertia ixx="0.5" ixy="0" ixz="0" iyy="0.5" iyz="0" izz="0.5"/></inertial></link></robot>"""


class Said(NamedTuple):
    """What a command left."""

    code: int
    out: str
    err: str


@pytest.fixture
def graph(monkeypatch: pytest.MonkeyPatch, free_port: int) -> Iterator[Graph]:
    """The graph of a world."""
    monkeypatch.setenv("GAZELLE_PORT", str(free_port))
    with Graph.open(port=free_port, environ={}) as opened:
        yield opened


@pytest.fixture
def world(graph: Graph) -> Iterator[Simulation]:
    """A paused world with one arm, whose loop runs in a thread."""
    workspace = Workspace.discover(environ={}, cwd=Path("/"))
    node = graph.create_node("gazebo", rosout=False)
    with Simulation.load(world="empty", workspace=workspace, node=node) as sim:
        offer_gazebo_ros(sim.server)
        sim.spawn(ARM, pose=Pose.from_xyz_rpy((1.0, -0.5, 0.15), (0.0, 0.0, 0.25)))
        sim.server.pause()
        loop = threading.Thread(target=sim.server.run)
        loop.start()
        yield sim
        sim.server.stop()
        loop.join()


@pytest.fixture
def gz(capsys: pytest.CaptureFixture[str]) -> Callable[..., Said]:
    """Runs ``gz``: ``gz("model", "-m", "arm", "-p")``."""

    def call(*words: str) -> Said:
        capsys.readouterr()
        code = main(["gz", *words])
        return Said(code, *capsys.readouterr())

    return call
