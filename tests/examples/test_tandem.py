"""The example in PR2's manner: its own controller runs in the control loop."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

import gazelle
from gazelle.geometry import Pose
from gazelle.interfaces import message_type, service_type
from gazelle.workspace import Workspace

EXAMPLE = Path(__file__).parents[2] / "examples" / "pr2_style_ws"
PACKAGE = EXAMPLE / "src" / "tandem_controller"
RADIUS_M = 0.12


@pytest.fixture
def sim() -> Iterator[gazelle.Simulation]:
    """The robot on the ground, with its controller's parameters."""
    with gazelle.Simulation.load(
        PACKAGE / "urdf" / "robot.xml",
        pose=Pose((0.0, 0.0, RADIUS_M), (0.0, 0.0, 0.0, 1.0)),
        workspace=Workspace.discover(extra=[EXAMPLE / "src"], environ={}),
        parameters=PACKAGE / "config" / "controller.yaml",
    ) as sim:
        yield sim


@pytest.mark.tutorial
def test_the_controller_is_found_by_its_type_and_claims_both_wheels(sim):
    record = sim.controller_manager().spawn("tandem_controller")
    assert record.type == "MyControllerPlugin"
    assert record.commands == ("joint_front/effort", "joint_rear/effort")


@pytest.mark.tutorial
def test_a_commanded_angle_rolls_the_robot_by_its_wheels(sim):
    sim.controller_manager().spawn("tandem_controller")
    sim.run(seconds=0.2)
    start = sim.model("tandem").pose.position_m[0]
    sim.publish("/tandem_controller/command", message_type("std_msgs/Float64")(data=3.0))
    sim.run(seconds=3.0)
    for joint in ("joint_front", "joint_rear"):
        assert sim.joint(joint).position == pytest.approx(3.0, abs=0.01)
    rolled = sim.model("tandem").pose.position_m[0] - start
    assert rolled == pytest.approx(3.0 * RADIUS_M, rel=0.02)


@pytest.mark.tutorial
def test_without_its_controller_the_robot_does_not_answer(sim):
    controllers = sim.controller_manager()
    controllers.spawn("tandem_controller")
    controllers.stop("tandem_controller")
    sim.publish("/tandem_controller/command", message_type("std_msgs/Float64")(data=3.0))
    sim.run(seconds=1.0)
    assert sim.joint("joint_front").position == pytest.approx(0.0, abs=0.01)


def test_its_gains_are_live(sim):
    sim.controller_manager().spawn("tandem_controller")
    kind = service_type("dynamic_reconfigure/Reconfigure")
    request = kind.Request()
    double = message_type("dynamic_reconfigure/DoubleParameter")
    request.config.doubles = [double(name="p", value=20.0)]
    sim.server.node.call("/tandem_controller/pid_steer/set_parameters", request)
    sim.run(seconds=0.01)
    found = sim.controller_manager().controllers["tandem_controller"].controller
    assert [pid.gains.p for pid in found.user.pids] == [20.0, 20.0]


@pytest.mark.tutorial
def test_the_launch_file_starts_the_controller(gazelle):
    launched = gazelle(
        "roslaunch", "--lockstep", "--iters", "500", "tandem_controller", "robot.launch",
        cwd=EXAMPLE,
    )  # fmt: skip
    launched.wait_for_line("Started controllers: tandem_controller")
    launched.wait_for_line("state hash")
    assert launched.wait() == 0
