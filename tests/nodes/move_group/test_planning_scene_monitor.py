"""Who plans right after the start waits for the first joint states."""

from __future__ import annotations

import threading

from tests.nodes.conftest import Bench
from tests.nodes.move_group.fake_robot import FakeRobot

from gazelle.nodes.move_group.planning_scene_monitor import CurrentStateMonitor


def test_first_joint_state_is_waited_for(bench: Bench) -> None:
    monitor = CurrentStateMonitor(bench.node, "/joint_states")
    assert not monitor.wait_for_any(0.0) and monitor.positions == {}
    robot = FakeRobot(bench.node, {"hinge": 0.3})
    stop = threading.Event()

    def publish() -> None:
        while not stop.wait(0.01):
            robot.publish()

    thread = threading.Thread(target=publish)
    thread.start()
    try:
        assert monitor.wait_for_any(20.0)
    finally:
        stop.set()
        thread.join()
    assert monitor.positions == {"hinge": 0.3}
