"""The same launch again, in lock-step: the same state and the same messages."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import pytest
from tests.patience import eventually

from gazelle.graph import Graph

pytestmark = [pytest.mark.tutorial, pytest.mark.slow(13)]

_EXPECTED = {
    "/clock": 600,
    "/scan": 3,
    "/odom": 60,
    "/tf_of_simulator": 60,
    "/gazebo/model_states": 600,
    "/camera/rgb/image_raw": 12,
    "/camera/depth_registered/image_raw": 12,
}
_STEPS = 600


class _Record:
    """Every message of the simulator's topics, by topic."""

    def __init__(self, graph: Graph) -> None:
        self.messages: dict[str, list[bytes]] = {topic: [] for topic in _EXPECTED}
        self._lock = threading.Lock()
        node = graph.create_node("record", rosout=False)
        for topic in _EXPECTED:
            name = "/tf" if topic == "/tf_of_simulator" else topic
            node.create_subscription(name, None, self._take(topic), raw=True)

    def counts(self) -> dict[str, int]:
        return {topic: len(items) for topic, items in self.messages.items()}

    def _take(self, topic: str) -> Callable[[Any], None]:
        def take(raw: Any) -> None:
            data = bytes(raw.data)
            # The simulator's transforms start with odometry, others are of the state publisher.
            if topic != "/tf_of_simulator" or b"odom" in data:
                with self._lock:
                    self.messages[topic].append(data)

        return take


def launch_in_lockstep(run: Callable, port: int) -> tuple[str, dict[str, list[bytes]]]:
    """Return the hash of the last state, and every message of the simulator's topics."""
    # The graph is there before the launch, so that nothing is missed.
    with Graph.open(port=port, role="hub", environ={}) as graph:
        record = _Record(graph)
        robot = run(
            "roslaunch", "--lockstep", "--iters", str(_STEPS),
            "slam_robot", "slam_robot_gazebo.launch",
        )  # fmt: skip
        state_hash = robot.wait_for_line("state hash").partition("state hash ")[2]
        assert robot.wait() == 0, robot.text
        eventually(lambda: record.counts() == _EXPECTED, why=lambda: str(record.counts()))
        return state_hash, record.messages


def test_launches_in_lockstep_are_one(in_workspace: Callable, free_port: int) -> None:
    """More than two are in benchmarks/soak/repeatable_launch.py."""
    first, second = (launch_in_lockstep(in_workspace, free_port) for _ in range(2))
    assert first[0].endswith("at 0.600000000 s")
    assert second[0] == first[0]
    for topic in _EXPECTED:
        assert second[1][topic] == first[1][topic], topic
