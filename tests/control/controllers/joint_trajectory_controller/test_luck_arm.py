"""Document LUCK's arm, unmodified, follows trajectories in the simulator."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import BPoly
from tests.control.trajectory_messages import goal, point, trajectory
from tests.shared_files import skip_module_without_shared

from gazelle.control.trajectory.waypoints import ErrorCode
from gazelle.description.xacro import expand_xacro
from gazelle.diagnostics import Diagnostics
from gazelle.graph.actions import LocalGoal
from gazelle.simulator import Simulation
from gazelle.workspace import Workspace

skip_module_without_shared()

pytestmark = pytest.mark.tutorial

JOINTS = tuple(f"joint_{number}" for number in range(1, 7))
ACTION = "/test_group_controller/follow_joint_trajectory"
TARGET = [0.5, -0.4, 0.6, 0.3, -0.2, 0.4]
REST = [0.0] * 6
PERIOD_S = 0.01


class Arm:
    """The arm with its controllers running.

    Attributes:
        states: messages of ``~/controller_state``.
    """

    def __init__(self, sim: Simulation) -> None:
        self.sim = sim
        manager = sim.controller_manager()
        for name in ("joint_state_broadcaster", "test_group_controller"):
            manager.load(name)
            manager.start(name)
        self.states: list[Any] = []
        sim.subscribe("/test_group_controller/controller_state", self.states.append)
        sim.run(seconds=0.1)

    @property
    def position(self) -> np.ndarray:
        return np.array([self.sim.joint(name).position for name in JOINTS])

    def send(self, *points: Any, **tolerances: Any) -> LocalGoal:
        return self.sim.send_goal(ACTION, goal(trajectory(JOINTS, *points), **tolerances))

    def measured(self) -> np.ndarray:
        """Return positions and velocities (2, 6) as the controller read them last."""
        interface_values = self.sim.server.controls.manager().robot.interface_values
        names = [f"{name}/{word}" for word in ("position", "velocity") for name in JOINTS]
        values: np.ndarray = interface_values.states[interface_values.state_indices(names)].reshape(
            2, -1
        )
        return values


@pytest.fixture
def arm(workspaces_dir: Path) -> Iterator[Arm]:
    """The arm as its launch file makes it: xacro, then the parameter file put in."""
    source = workspaces_dir / "ros2_ws" / "src"
    workspace = Workspace.discover(environ={}, cwd=Path("/"), extra=[source])
    config = source / "luck_robot" / "config"
    expanded = expand_xacro(
        config / "luck_description.urdf.xacro",
        mappings={
            "initial_positions_file": str(config / "initial_positions.yaml"),
            "use_sim": "true",
        },
        workspace=workspace,
        diagnostics=Diagnostics(),
    )
    assert expanded is not None
    begin = '<plugin filename="libgazebo_ros2_control.so" name="gazebo_ros2_control">'
    yaml = source / "luck_gazebo" / "config" / "controllers.yaml"
    text = expanded.text.replace(begin, f"{begin}<parameters>{yaml}</parameters>")
    assert text != expanded.text
    with Simulation.load(text, workspace=workspace) as sim:
        yield Arm(sim)


def spline(
    times_s: Sequence[float], rows: Sequence[Sequence[np.ndarray]]
) -> Callable[[float], Any]:
    """Return the polynomials with these positions, velocities … at these times."""
    return BPoly.from_derivatives(times_s, rows)


@pytest.mark.parametrize("orders", [1, 2, 3])
def test_the_reference_is_the_published_spline(arm: Arm, orders: int) -> None:
    rng = np.random.default_rng(orders)
    way = rng.uniform(-0.5, 0.5, (3, 3, 6))
    way[2, 1:] = 0.0
    points = [point(t, *row[:orders]) for t, row in zip((0.5, 1.1, 2.0), way, strict=True)]
    sent = arm.send(*points)
    arm.sim.run(seconds=PERIOD_S)
    start = [*arm.measured(), np.zeros(6)]
    arm.states.clear()
    arm.sim.run(seconds=1.98)
    rows = [
        start[:orders],
        *(list(row[:orders]) for row in way),
    ]
    wanted = spline([0.0, 0.5, 1.1, 2.0], rows)
    assert len(arm.states) >= 98
    for state in arm.states:
        np.testing.assert_allclose(state.reference.positions, wanted(_time_s(state)), atol=1e-9)
    arm.sim.run(seconds=0.1)
    assert sent.status.name == "SUCCEEDED"


def test_the_arm_follows_within_one_period_and_does_not_fall(arm: Arm) -> None:
    np.testing.assert_allclose(arm.position, 0.0, atol=1e-5)
    sent = arm.send(point(2.0, TARGET, REST, REST))
    fastest = 1.875 * np.abs(TARGET) / 2.0
    arm.states.clear()
    for _ in range(220):
        arm.sim.run(seconds=PERIOD_S)
        if arm.states:
            late = np.abs(arm.states[-1].reference.positions - arm.position)
            assert (late <= 2.1 * PERIOD_S * fastest + 1e-5).all()
    assert sent.status.name == "SUCCEEDED"
    assert sent.result.error_code == ErrorCode.SUCCESSFUL
    np.testing.assert_allclose(arm.position, TARGET, atol=1e-5)
    arm.sim.run(seconds=2.0)
    np.testing.assert_allclose(arm.position, TARGET, atol=1e-5)


def test_tolerances_abort_with_their_codes(arm: Arm) -> None:
    sent = arm.send(point(1.0, TARGET, REST, REST), path={"joint_1": (1e-5,)})
    arm.sim.run(seconds=0.5)
    assert sent.status.name == "ABORTED"
    assert sent.result.error_code == ErrorCode.PATH_TOLERANCE_VIOLATED
    assert sent.result.error_string == "Aborted due to path tolerance violation"
    held = arm.position
    arm.sim.run(seconds=0.5)
    np.testing.assert_allclose(arm.position, held, atol=1e-3)

    tight = dict.fromkeys(JOINTS, (1e-14,))
    sent = arm.send(point(0.5, TARGET, REST, REST), end=tight, goal_time_s=0.2)
    arm.sim.run(seconds=1.0)
    assert sent.status.name == "ABORTED"
    assert sent.result.error_code == ErrorCode.GOAL_TOLERANCE_VIOLATED
    assert "goal_time_tolerance exceeding by 0.2" in sent.result.error_string


def test_goals_are_preempted_and_cancelled(arm: Arm) -> None:
    feedback: list[Any] = []
    message = goal(trajectory(JOINTS, point(1.0, TARGET, REST, REST)))
    first = arm.sim.send_goal(ACTION, message, on_feedback=feedback.append)
    arm.sim.run(seconds=0.5)
    assert len(feedback) == 10
    before = arm.position
    second = arm.send(point(1.0, REST, REST, REST))
    assert first.status.name == "ABORTED"
    assert first.result.error_string == "Current goal preempted by new incoming action."
    arm.sim.run(seconds=PERIOD_S)
    assert np.abs(arm.position - before).max() < 0.03
    arm.sim.run(seconds=0.3)
    second.cancel()
    arm.sim.run(seconds=0.05)
    assert second.status.name == "CANCELED"
    held = arm.position
    arm.sim.run(seconds=1.0)
    np.testing.assert_allclose(arm.position, held, atol=1e-3)
    assert held[0] > 0.05


def test_a_reset_ends_the_goal_and_the_next_one_runs(arm: Arm) -> None:
    first = arm.send(point(1.0, TARGET, REST, REST))
    arm.sim.run(seconds=0.5)
    arm.sim.reset()
    assert first.status.name == "ABORTED"
    arm.sim.run(seconds=0.1)
    np.testing.assert_allclose(arm.position, 0.0, atol=1e-5)
    second = arm.send(point(0.5, TARGET, REST, REST))
    arm.sim.run(seconds=0.6)
    assert second.status.name == "SUCCEEDED"


def test_bad_goals_are_rejected_with_their_reason(arm: Arm) -> None:
    for message, code in (
        (trajectory(JOINTS[:5], point(1.0, REST[:5])), ErrorCode.INVALID_JOINTS),
        (trajectory(JOINTS, point(1.0, REST[:5])), ErrorCode.INVALID_GOAL),
        (trajectory(JOINTS, point(0.01, REST), stamp_s=0.01), ErrorCode.OLD_HEADER_TIMESTAMP),
    ):
        sent = arm.sim.send_goal(ACTION, goal(message))
        assert sent.status.name == "REJECTED"
        assert sent.result.error_code == code


def test_the_gains_have_no_effect_and_that_is_said(arm: Arm) -> None:
    (found,) = [one for one in arm.sim.diagnostics if one.code == "control.idle-gains"]
    assert "'gains' has no effect: with the position interface" in found.message
    assert found.span is not None
    assert found.span.file.endswith("controllers.yaml")


def _time_s(state: Any) -> float:
    time = state.reference.time_from_start
    return float(time.sec + time.nanosec * 1e-9)
