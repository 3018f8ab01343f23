"""Recording a simulation of this process."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.recording import record, snapshot
from gazelle.simulator import Simulation

_BALL = """<sdf version="1.6"><model name="ball"><link name="link">
  <inertial><mass>1</mass></inertial>
  <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
  <visual name="v"><geometry><sphere><radius>0.1</radius></sphere></geometry></visual>
</link></model></sdf>"""


@pytest.fixture
def sim() -> Iterator[Simulation]:
    """A ball ten metres above the ground."""
    with Simulation.load(_BALL, pose=Pose((0.0, 0.0, 10.0))) as made:
        yield made


def test_moments_are_at_exact_times_and_the_ball_falls(sim: Simulation) -> None:
    with record(sim, rate_hz=100) as recorder:
        sim.run(seconds=0.505)
    recording = recorder.recording
    (stretch,) = recording.stretches
    assert recording.duration_s == pytest.approx(0.505)
    assert stretch.times_ns.tolist() == [*range(0, 510_000_000, 10_000_000), 505_000_000]
    row = stretch.link_names.index("ball::link")
    heights = stretch.poses[:, row, 2]
    assert heights[0] == pytest.approx(10.0)
    assert heights[50] == pytest.approx(10.0 - 9.8 * 0.125, abs=0.01)


def test_equal_runs_give_equal_recordings(sim: Simulation) -> None:
    with record(sim) as first:
        sim.run(seconds=0.3)
    sim.reset()
    with record(sim) as second:
        sim.run(seconds=0.3)
    once, again = (one.recording.stretches[0].poses for one in (first, second))
    assert once.tobytes() == again.tobytes()


def test_models_that_come_and_go_are_stretches_of_their_own(sim: Simulation) -> None:
    with record(sim) as recorder:
        sim.run(seconds=0.1)
        sim.spawn(_BALL, name="second")
        sim.run(seconds=0.1)
        sim.delete("ball")
        sim.run(seconds=0.1)
    names = [set(one.link_names) for one in recorder.recording.stretches]
    assert [("ball::link" in one, "second::link" in one) for one in names] == [
        (True, False),
        (True, True),
        (False, True),
    ]


def test_topics_are_recorded_with_the_time_of_the_world(sim: Simulation) -> None:
    kind = message_type("std_msgs/String")
    publisher = sim.server.node.create_publisher("/word", kind, latch=True)
    publisher.publish(kind(data="first"))
    with record(sim) as recorder:
        sim.run(seconds=0.1)
        publisher.publish(kind(data="second"))
        sim.run(seconds=0.1)
    (topic,) = (one for one in recorder.recording.topics if one.name == "/word")
    assert [one.data for one in topic.messages] == ["first", "second"]
    assert topic.times_ns.tolist() == [0, 100_000_000]
    with record(sim, topics=[]) as recorder:
        sim.run(seconds=0.1)
    assert recorder.recording.topics == ()


def test_after_the_block_nothing_is_recorded_and_stopping_twice_is_fine(sim: Simulation) -> None:
    with record(sim) as recorder:
        sim.run(seconds=0.1)
    sim.run(seconds=0.1)
    assert recorder.stop().duration_s == pytest.approx(0.1)


def test_a_snapshot_is_one_moment(sim: Simulation) -> None:
    sim.run(seconds=0.2)
    recording = snapshot(sim)
    assert (recording.start_s, recording.duration_s) == (pytest.approx(0.2), 0.0)
