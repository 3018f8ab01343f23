"""Trajectories: the quintic from rest to rest, commanded exactly or tracked closely."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
from tests.control.controllers.type_bench import Scenario, TypeBench
from tests.control.plant import PlantJoint
from tests.control.trajectory_messages import goal, point, trajectory

__all__ = ["ROWS"]

WORDS = ("position", "velocity", "acceleration")
# In the trajectory's order, which is not that of the parameters.
ENDS = {"elbow": -1.0, "shoulder": 0.5}
DURATION_S = 1.0
INERTIA, P = 2.0, 4000.0
JOINTS = [PlantJoint(name, INERTIA, commands=(*WORDS, "effort")) for name in ("shoulder", "elbow")]
# What a PD must leave, I·a/p at the quintic's largest acceleration, and one step's way.
ERROR = INERTIA * 5.78 / P + 1.875e-3
_STIFF = {name: {"p": P, "d": 200.0} for name in ENDS}
_LOOSE = {name: {"p": 20.0} for name in ENDS}


def quintic(time_s: float) -> dict[str, float]:
    """Position, velocity and acceleration of the way from 0 to 1 at rest, in 1 s."""
    x = min(time_s / DURATION_S, 1.0)
    return {
        "position": 10 * x**3 - 15 * x**4 + 6 * x**5,
        "velocity": 30 * x**2 - 60 * x**3 + 30 * x**4,
        "acceleration": 60 * x - 180 * x**2 + 120 * x**3,
    }


def follows(bench: TypeBench, words: Sequence[str]) -> None:
    """The spline is commanded, or the joint is near it at all times; the goal ends well."""
    exact = [word for word in words if word in WORDS and words[0] == "position"]
    rest = [0.0, 0.0]
    wanted = trajectory(list(ENDS), point(DURATION_S, list(ENDS.values()), rest, rest))
    sent = bench.ports.send_goal("~/follow_joint_trajectory", goal(wanted))
    for step in range(round(DURATION_S * 1000) + 100):
        bench.run(0.001)
        now = quintic(step * 1e-3)
        for name, end in ENDS.items():
            for word in exact:
                found = bench.command(f"{name}/{word}")
                assert found == pytest.approx(end * now[word], abs=1e-9), (name, word, step)
        if not exact:
            ends = np.array([ENDS["shoulder"], ENDS["elbow"]])
            after = quintic((step + 1) * 1e-3)["position"]
            assert bench.plant.position == pytest.approx(ends * after, abs=ERROR), step
    assert sent.state == "succeeded"
    assert sent.result["error_code"] == 0
    commanded = {name.rpartition("/")[2] for name in bench.record.commands}
    assert commanded == set(words)
    idle = {"position", "velocity", "acceleration", "effort"} - commanded
    assert np.isnan([bench.command(f"elbow/{word}") for word in idle]).all()


def _ros1(family: str, words: Sequence[str], **more: Any) -> Scenario:
    parameters = {"joints": ["shoulder", "elbow"], **more}
    type_name = f"{family}_controllers/JointTrajectoryController"
    return Scenario(type_name, follows, parameters, JOINTS, about=words)


def _ros2(*words: str, **more: Any) -> Scenario:
    parameters = {
        "joints": ["shoulder", "elbow"],
        "command_interfaces": list(words),
        "state_interfaces": ["position", "velocity"],
        **more,
    }
    type_name = "joint_trajectory_controller/JointTrajectoryController"
    return Scenario(type_name, follows, parameters, JOINTS, 2, words)


_FEED_FORWARD = dict.fromkeys(ENDS, 1.0)
ROWS = (
    _ros1("position", WORDS[:1]),
    _ros1("pos_vel", WORDS[:2]),
    _ros1("pos_vel_acc", WORDS),
    _ros1("velocity", ["velocity"], gains=_LOOSE, velocity_ff=_FEED_FORWARD),
    # ROS 1 wants the joints to rest on time unless it is given some.
    _ros1("effort", ["effort"], gains=_STIFF, constraints={"goal_time": 0.09}),
    _ros2("position"),
    _ros2("position", "velocity", "acceleration"),
    _ros2(
        "velocity",
        gains={name: {**row, "ff_velocity_scale": 1.0} for name, row in _LOOSE.items()},
    ),
    _ros2("effort", gains=_STIFF),
)
