"""The four-wheeled example with its own controller files, and with the tutorial's three (T15)."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytestmark = pytest.mark.tutorial

_EXAMPLE = Path(__file__).parents[2] / "examples" / "four_wheel_ws"


def test_launch_file_runs_its_own_controllers(gazelle: Callable) -> None:
    run = gazelle("roslaunch", "courier_robot", "courier.launch", cwd=_EXAMPLE)
    # One command holds for 0.5 s, in which 0.8 m/s² come to this.
    _check_drive(run, top_m_s=0.4, rel=0.05, covariance=[0.002] * 2 + [0.001] * 3 + [0.05])


def test_launch_file_runs_the_tutorials_controllers(
    gazelle: Callable, workspaces_dir: Path
) -> None:
    config = workspaces_dir / "catkin_ws/src/urdf_tutorial/config"
    words = ("courier_robot", "courier.launch", f"config:={config}", "head:=caster.yaml")
    run = gazelle("roslaunch", *words, cwd=_EXAMPLE)
    _check_drive(run, top_m_s=0.2, rel=0.02, covariance=[0.001] * 5 + [0.03])


def _check_drive(run: Any, *, top_m_s: float, rel: float, covariance: list[float]) -> None:
    names = "joint_state_controller, diff_drive_controller, head_controller"
    run.wait_for_line(f"Started controllers: {names}")

    joints = run.messages({"/joint_states": 5})["/joint_states"][-1]
    sides = [f"{side}_{end}_wheel_joint" for side in ("left", "right") for end in ("front", "back")]
    assert sorted(joints.name) == sorted([*sides, "head_swivel"])

    odometry: list[Any] = []
    topic = "/diff_drive_controller/odom"
    run.node.create_subscription(topic, "nav_msgs/msg/Odometry", odometry.append)
    run.eventually(lambda: odometry)
    run.publish("/head_controller/command", "std_msgs/Float64", data=0.5)
    twist = {"linear": {"x": 1.0, "y": 0.0, "z": 0.0}}
    run.publish("/diff_drive_controller/cmd_vel", "geometry_msgs/Twist", **twist)
    run.eventually(
        lambda: max((one.twist.twist.linear.x for one in odometry), default=0) > 0.95 * top_m_s
    )
    run.eventually(lambda: odometry[-1].twist.twist.linear.x == pytest.approx(0.0, abs=1e-3))
    assert max(one.twist.twist.linear.x for one in odometry) == pytest.approx(top_m_s, rel=rel)
    told = np.reshape(odometry[-1].pose.covariance, (6, 6))
    assert np.diag(told) == pytest.approx(covariance)
    head = run.messages({"/joint_states": 50})["/joint_states"][-1]
    assert head.position[list(head.name).index("head_swivel")] == pytest.approx(0.5, abs=0.01)
    assert "warning" not in run.text
