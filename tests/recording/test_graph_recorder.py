"""Recording a world over the graph."""

from __future__ import annotations

import threading
from collections.abc import Iterator

import pytest
from tests.patience import PATIENCE_S, eventually

from gazelle.geometry import Pose
from gazelle.graph import Graph
from gazelle.interfaces import message_type
from gazelle.recording import GraphRecorder, NoWorldError
from gazelle.simulator import Simulation
from gazelle.simulator.gui import offer_views

_BALL = """<sdf version="1.6"><model name="ball"><link name="link">
  <inertial><mass>1</mass></inertial>
  <visual name="v"><geometry><sphere><radius>0.1</radius></sphere></geometry></visual>
</link></model></sdf>"""


@pytest.fixture
def graph(free_port: int) -> Iterator[Graph]:
    """A graph of the test."""
    with Graph.open(port=free_port, role="hub", environ={}) as opened:
        yield opened


@pytest.fixture
def sim(graph: Graph) -> Iterator[Simulation]:
    """A ball in the air, with all that viewers are offered."""
    node = graph.create_node("gazebo", rosout=False)
    with Simulation.load(_BALL, pose=Pose((0.0, 0.0, 100.0)), node=node) as made:
        offer_views(made.server)
        yield made


def test_poses_come_at_exact_simulated_times_however_fast_it_runs(
    graph: Graph, sim: Simulation
) -> None:
    with GraphRecorder(graph) as recorder:
        eventually(lambda: (sim.step(20), recorder.has_begun)[1])
        begun = sim.time_ns
        sim.run(seconds=1.0)
        eventually(lambda: recorder.recording().end_ns >= begun + 1_000_000_000 - 20_000_000)
        recording = recorder.recording()
    (stretch,) = recording.stretches
    times = [one for one in stretch.times_ns.tolist() if one >= begun]
    assert {one % 20_000_000 for one in times} == {0}
    assert len(times) >= 50
    row = stretch.link_names.index("ball::link")
    fallen_m = 4.9 * (times[-1] * 1e-9) ** 2
    assert stretch.poses[-1, row, 2] == pytest.approx(100.0 - fallen_m, abs=0.02)
    assert stretch.world.models[-1].links[0].visuals[0].name == "v"


def test_a_world_that_stands_still_is_one_moment(graph: Graph, sim: Simulation) -> None:
    ended = threading.Event()
    # Views look at the world between steps: somebody has to own it.
    sim.server.pause()
    thread = threading.Thread(target=lambda: (sim.server.run(), ended.set()))
    thread.start()
    try:
        with GraphRecorder(graph) as recorder:
            assert recorder.wait_for_world(PATIENCE_S)
            eventually(lambda: recorder.recording().duration_s == 0.0)
    finally:
        sim.server.stop()
        thread.join()
    assert ended.is_set()


def test_topics_that_come_later_are_taken_up(graph: Graph, sim: Simulation) -> None:
    kind = message_type("std_msgs/String")
    talker = graph.create_node("talker", rosout=False)
    with GraphRecorder(graph) as recorder:
        eventually(lambda: (sim.step(20), recorder.has_begun)[1])
        publisher = talker.create_publisher("/word", kind, latch=True)
        publisher.publish(kind(data="hello"))

        def words() -> list[str]:
            recorder.poll()
            return [one.data for two in recorder.recording().topics
                    if two.name == "/word" for one in two.messages]  # fmt: skip

        assert eventually(words) == ["hello"]
        assert "/_gazelle/poses" not in recorder.topics


def test_a_graph_without_a_world_is_told_with_what_to_do(graph: Graph) -> None:
    with GraphRecorder(graph) as recorder:
        assert not recorder.wait_for_world(0.01)
        with pytest.raises(NoWorldError, match=r"nobody simulates a world on the graph of port"):
            recorder.recording()
        with pytest.raises(NoWorldError, match=r"fix: start one, e.g. gazelle roslaunch PACKAGE"):
            recorder.recording()
