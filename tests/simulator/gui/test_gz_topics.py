"""What a world of the new Gazebo tells under ``/world/NAME``."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from typing import Any

import pytest

from gazelle.geometry import Pose
from gazelle.simulator import Simulation
from gazelle.simulator.gui import offer_views

_WAIT_S = 30.0
_BOX = """<robot name="box"><link name="base"><inertial><mass value="1"/>
  <inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="lid"><inertial><mass value="1"/>
  <inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="hinge" type="revolute"><parent link="base"/><child link="lid"/>
  <origin xyz="0 0 0.5"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint></robot>"""


@pytest.fixture
def sim() -> Iterator[Simulation]:
    sim = Simulation.load(_BOX, pose=Pose((1.0, 2.0, 0.1)))
    offer_views(sim.server, is_gz=True)
    yield sim
    sim.server.close()


def _first(sim: Simulation, topic: str, *, steps: int = 0) -> Any:
    got: list[Any] = []
    arrived = threading.Event()

    def take(message: Any) -> None:
        got.append(message)
        arrived.set()

    listening = sim.server.node.create_subscription(topic, None, take)
    if steps:
        sim.server.step(steps)
    assert arrived.wait(_WAIT_S), topic
    listening.unregister()
    return got[0]


def test_poses_are_those_of_models_in_the_world_and_links_in_models(sim: Simulation) -> None:
    rows = _first(sim, f"/world/{sim.server.engine.world.name}/pose/info").transforms
    frames = [(row.header.frame_id, row.child_frame_id) for row in rows]
    world = sim.server.engine.world.name
    assert (world, "ground_plane") in frames
    assert frames[-3:] == [(world, "box"), ("box", "box/base"), ("box", "box/lid")]
    assert rows[-3].transform.translation.x == pytest.approx(1.0)
    assert rows[-1].transform.translation.z == pytest.approx(0.5)


def test_dynamic_poses_leave_out_what_is_static(sim: Simulation) -> None:
    rows = _first(sim, f"/world/{sim.server.engine.world.name}/dynamic_pose/info").transforms
    assert [row.child_frame_id for row in rows] == ["box", "box/base", "box/lid"]


def test_clock_and_statistics_have_the_time_of_the_world(sim: Simulation) -> None:
    world = sim.server.engine.world.name
    assert _first(sim, f"/world/{world}/clock", steps=100).clock.nanosec > 0
    for topic in ("/stats", f"/world/{world}/stats"):
        told = _first(sim, topic)
        assert (told.iterations, told.sim_time.nanosec) == (100, 100_000_000)
