"""The four-wheeled example under ros_control: limits, odometry and truth, with its own controller
file and with the tutorial's."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from tests.conftest import SHARED

import gazelle
from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.workspace import Workspace

EXAMPLE = Path(__file__).parents[2] / "examples" / "four_wheel_ws"
PACKAGE = EXAMPLE / "src" / "courier_robot"


TUTORIAL = SHARED / "workspaces/catkin_ws/src/urdf_tutorial/config/diffdrive.yaml"
FILES = {"own": PACKAGE / "config" / "diffdrive.yaml"}
if TUTORIAL.exists():
    FILES["tutorial"] = TUTORIAL


@pytest.fixture(params=FILES)
def config(request: pytest.FixtureRequest) -> dict[str, Any]:
    """The controller file of the example, and the unmodified one of the tutorial."""
    values: dict[str, Any] = yaml.safe_load(FILES[request.param].read_text())
    return values


class Courier:
    """The robot with a running drive."""

    def __init__(self, sim: gazelle.Simulation) -> None:
        self.sim = sim
        self.odometry: list[Any] = []
        sim.subscribe("/base/odom", self.odometry.append)

    def drive(self, linear_m_s: float, angular_rad_s: float, seconds: float) -> np.ndarray:
        """Command a twist; return time, odometry's speed and yaw rate, true speed and yaw rate."""
        twist: Any = message_type("geometry_msgs/Twist")()
        twist.linear.x, twist.angular.z = linear_m_s, angular_rad_s
        rows = []
        for _ in range(round(seconds / 0.02)):
            self.sim.publish("/base/cmd_vel", twist)
            before = self.sim.model("courier").pose
            self.sim.run(seconds=0.02)
            after = self.sim.model("courier").pose
            path = np.subtract(after.position_m, before.position_m)[:2]
            turn = math.remainder(after.rpy_rad[2] - before.rpy_rad[2], 2 * math.pi)
            measured = self.odometry[-1].twist.twist
            rows.append(
                (
                    self.sim.time_s,
                    measured.linear.x,
                    measured.angular.z,
                    np.linalg.norm(path) / 0.02,
                    turn / 0.02,
                )
            )
        return np.array(rows).T


@pytest.fixture
def courier(config: dict[str, Any]) -> Iterator[Courier]:
    with gazelle.Simulation.load(
        PACKAGE / "urdf" / "courier.urdf.xacro",
        world="empty",
        pose=Pose((0.0, 0.0, 0.08)),
        workspace=Workspace.discover(extra=[EXAMPLE]),
    ) as sim:
        sim.controller_manager().spawn("base", parameters=config)
        robot = Courier(sim)
        sim.run(seconds=0.5)
        yield robot


@pytest.mark.tutorial
def test_a_metre_per_second_is_cut_to_the_limits(courier: Courier, config: dict[str, Any]) -> None:
    limits = config["linear"]["x"]
    top, rate = limits["max_velocity"], limits["max_acceleration"]
    start = courier.sim.model("courier").pose.position_m[0]
    _, measured, _, true, _ = courier.drive(1.0, 0.0, 5.0)
    end = courier.sim.model("courier").pose.position_m[0]
    assert true[-50:].mean() == pytest.approx(top, rel=5e-3)
    assert measured.max() == pytest.approx(top, rel=1e-3)
    assert end - start == pytest.approx(top * 5 - top**2 / (2 * rate), rel=0.01)
    assert np.diff(true).max() / 0.02 < rate * 1.05
    ramp = measured[(measured > 0.2 * top) & (measured < 0.8 * top)]
    assert np.diff(ramp).mean() / 0.02 == pytest.approx(rate, rel=0.03)


@pytest.mark.tutorial
def test_odometry_of_a_straight_line_is_the_truth_with_the_given_covariances(
    courier: Courier, config: dict[str, Any]
) -> None:
    courier.drive(1.0, 0.0, 5.0)
    message = courier.odometry[-1]
    pose = courier.sim.model("courier").pose
    assert message.pose.pose.position.x == pytest.approx(pose.position_m[0], rel=0.02)
    assert message.pose.pose.position.y == pytest.approx(pose.position_m[1], abs=1e-3)
    assert (message.header.frame_id, message.child_frame_id) == ("odom", "base_link")
    for field in ("pose", "twist"):
        covariance = np.reshape(getattr(message, field).covariance, (6, 6))
        assert covariance == pytest.approx(np.diag(config[f"{field}_covariance_diagonal"]))


@pytest.mark.tutorial
def test_odometry_comes_fifty_times_a_second(courier: Courier) -> None:
    before = len(courier.odometry)
    courier.sim.run(seconds=2.0)
    assert len(courier.odometry) - before == pytest.approx(100, abs=1)


@pytest.mark.tutorial
def test_turning_keeps_the_yaw_limits_and_slips(courier: Courier, config: dict[str, Any]) -> None:
    """Four wheels that do not steer scrub sideways: truth turns less than odometry believes."""
    limits = config["angular"]["z"]
    _, _, measured, _, true = courier.drive(0.0, 5.0, 4.0)
    assert measured.max() < limits["max_velocity"] * 1.02
    assert measured[-50:].mean() == pytest.approx(limits["max_velocity"], rel=0.1)
    assert np.diff(measured).max() / 0.02 < limits["max_acceleration"] * 1.05
    assert 0.4 < true[-50:].mean() / measured[-50:].mean() < 0.9
    pose = courier.sim.model("courier").pose
    # The head makes the front heavier, so the middle wanders.
    assert np.linalg.norm(pose.position_m[:2]) < 0.15


@pytest.mark.tutorial
def test_without_commands_it_stops_within_timeout_and_deceleration(
    courier: Courier, config: dict[str, Any]
) -> None:
    courier.drive(1.0, 0.0, 3.0)
    limits = config["linear"]["x"]
    courier.sim.run(seconds=0.5 + limits["max_velocity"] / limits["max_acceleration"] + 0.3)
    before = courier.sim.model("courier").pose.position_m
    courier.sim.run(seconds=1.0)
    after = courier.sim.model("courier").pose.position_m
    assert np.linalg.norm(np.subtract(after, before)) < 1e-3


@pytest.mark.tutorial
def test_a_reset_world_gives_the_same_drive_again(courier: Courier) -> None:
    ends = []
    for _ in range(2):
        courier.sim.reset()
        courier.drive(0.3, 0.4, 2.0)
        place = courier.odometry[-1].pose.pose.position
        ends.append((place.x, place.y, courier.sim.state_hash()))
    assert ends[0] == ends[1]
    assert ends[0][0] > 0.2


@pytest.mark.tutorial
def test_the_tutorials_file_is_driven_by_too(workspaces_dir: Path) -> None:
    assert TUTORIAL.is_relative_to(workspaces_dir)
    assert set(FILES) == {"own", "tutorial"}


def test_all_its_controllers_run_without_a_warning() -> None:
    workspace = Workspace.discover(extra=[EXAMPLE])
    urdf = PACKAGE / "urdf" / "courier.urdf.xacro"
    config = {
        "joint_state_controller": yaml.safe_load((PACKAGE / "config/joints.yaml").read_text()),
        "head_controller": yaml.safe_load((PACKAGE / "config/head.yaml").read_text()),
        "diff_drive_controller": yaml.safe_load((PACKAGE / "config/diffdrive.yaml").read_text()),
    }
    with gazelle.Simulation.load(
        urdf, world="empty", workspace=workspace, parameters=config
    ) as sim:
        for name in config:
            sim.controller_manager().spawn(name)
        head: Any = message_type("std_msgs/Float64")(data=0.7)
        sim.publish("/head_controller/command", head)
        sim.run(seconds=2.0)
        assert sim.model("courier").joint("head_swivel").position == pytest.approx(0.7, abs=0.01)
        loud = [str(item) for item in sim.diagnostics if item.severity.name != "INFO"]
    assert loud == []
