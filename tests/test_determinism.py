"""The same inputs give the same states and the same messages, every time."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

from tests.sets import few

import gazelle
from gazelle.interfaces import message_type, to_cdr
from gazelle.workspace import Workspace

EXAMPLE = Path(__file__).parents[1] / "examples" / "scout_ws"
PACKAGE = EXAMPLE / "src" / "scout_robot"
RUNS = few(6, 100)


def _run(workspace: Workspace) -> tuple[str, str]:
    """Drive the scout for 0.3 s in its workshop; return the state's hash and the messages'."""
    digest = hashlib.sha256()

    def listen(sim: gazelle.Simulation, topic: str) -> None:
        def take(message: Any) -> None:
            digest.update(topic.encode() + to_cdr(message))

        sim.subscribe(topic, take)

    with gazelle.Simulation.load(
        PACKAGE / "urdf" / "scout.urdf.xacro",
        world=PACKAGE / "worlds" / "workshop.world",
        workspace=workspace,
        seed=7,
    ) as sim:
        for topic in ("/clock", "/scan", "/odom", "/tf", "/imu", "/joint_states"):
            listen(sim, topic)
        twist: Any = message_type("geometry_msgs/msg/Twist")()
        twist.linear.x, twist.angular.z = 0.3, 0.4
        sim.publish("/cmd_vel", twist)
        sim.run(seconds=0.3)
        return sim.state_hash(), digest.hexdigest()


def test_all_runs_are_one() -> None:
    workspace = Workspace.discover(extra=[EXAMPLE])
    assert len({_run(workspace) for _ in range(RUNS)}) == 1
