"""Pain 24: ``kill -9`` of the processes that carry a launch leaves nothing behind, no zombies."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from typing import Any

import psutil
import pytest
from tests.processes import is_gone

Run = Callable[..., Any]
_TF = '<node pkg="tf2_ros" type="static_transform_publisher" name="tf" args="0 0 0 0 0 0 a b"/>'
# What happens without the launcher, a node of the user and the simulator: test_supervisor.py.
_VICTIMS = {
    "host": "gazelle.nodes --host",
    "watchdog": "watchdog.py",
}


@pytest.mark.parametrize("victim", _VICTIMS)
def test_killing_a_process_of_the_launch_leaves_nothing(
    launch: Run, node: Run, victim: str
) -> None:
    run = launch(node("ros", "node=ros") + _TF)
    run.eventually(lambda: {"/ros", "/tf"} <= set(run.graph.node_names()))
    everything = run.processes()
    (pid,) = [pid for pid, line in everything.items() if _VICTIMS[victim] in line]
    os.kill(pid, signal.SIGKILL)
    run.eventually(lambda: is_gone(pid))
    assert run.stop() == 0
    run.eventually(lambda: run.processes() == {})
    # A zombie is whom nobody has asked how it ended.
    run.eventually(lambda: not [one for one in everything if psutil.pid_exists(one)])
