"""The balancing example stays up: at rest, pushed, driving, and after it lay on its board."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterator
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any

import pytest

import gazelle
from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.workspace import Workspace

EXAMPLE = Path(__file__).parents[2] / "examples" / "balance_ws"
PACKAGE = EXAMPLE / "src" / "balancer_robot"
_WHEELS = ("left_wheel_joint", "right_wheel_joint")


class Upright:
    """The robot under its control law.

    Attributes:
        sim: the simulation.
        law: the law, of whom speed and turn rate can be asked.
        leans: how far it leaned at each reading, rad.
    """

    def __init__(self, sim: gazelle.Simulation, late: int) -> None:
        law: Any = _module("control_law")
        self.sim = sim
        self.law = law.Balancer(0.15, 0.44, 4.0)
        self.leans: list[float] = []
        self._lean_of = law.lean_of
        self._on_its_way: deque[Any] = deque(maxlen=late + 1)
        sim.subscribe("/imu", self._on_imu)
        sim.controller_manager().spawn("wheel_controller")

    @property
    def place_m(self) -> float:
        """How far ahead of the origin it is."""
        return float(self.sim.model("balancer").pose.position_m[0])

    def _on_imu(self, imu: Any) -> None:
        joints = [self.sim.joint(name) for name in _WHEELS]
        self.leans.append(self._lean_of(imu.orientation))
        torques = self.law.torques(
            self.leans[-1],
            imu.angular_velocity.y,
            [joint.position for joint in joints],
            [joint.velocity for joint in joints],
            0.01,
        )
        self._on_its_way.append(message_type("std_msgs/Float64MultiArray")(data=list(torques)))
        self.sim.publish("/wheel_controller/commands", self._on_its_way[0])


@pytest.fixture
def balancer() -> Iterator[Callable[..., Upright]]:
    """Makes robots whose torques come a number of readings late, as through topics."""
    opened: list[gazelle.Simulation] = []

    def make(late: int = 1, lean_rad: float = 0.0) -> Upright:
        sim = gazelle.Simulation.load(
            PACKAGE / "urdf" / "balancer.urdf.xacro",
            world=PACKAGE / "worlds" / "court.world",
            pose=Pose.from_xyz_rpy((0.0, 0.0, 0.1 * abs(lean_rad)), (0.0, lean_rad, 0.0)),
            workspace=Workspace.discover(extra=[EXAMPLE]),
        )
        opened.append(sim)
        return Upright(sim, late)

    yield make
    for sim in opened:
        sim.close()


def _module(name: str) -> Any:
    spec = spec_from_file_location(name, PACKAGE / "balancer_robot" / f"{name}.py")
    assert spec is not None and spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("late", [0, 4])
def test_it_stands_upright_where_it_is(balancer: Callable[..., Upright], late: int) -> None:
    robot = balancer(late)
    robot.sim.run(seconds=6.0)
    assert max(map(abs, robot.leans[-200:])) < 0.03
    assert abs(robot.place_m) < 0.1


@pytest.mark.parametrize("force_n", [50.0, -40.0])
def test_it_stays_up_when_it_is_pushed_and_comes_back(
    balancer: Callable[..., Upright], force_n: float
) -> None:
    robot = balancer(late=2)
    robot.sim.run(seconds=1.0)
    robot.sim.link("balancer::base_footprint").apply_wrench(force_n=(force_n, 0, 0), seconds=0.2)
    robot.sim.run(seconds=1.0)
    assert max(map(abs, robot.leans)) > 0.05
    robot.sim.run(seconds=9.0)
    assert max(map(abs, robot.leans)) < 0.43
    assert max(map(abs, robot.leans[-100:])) < 0.03
    assert abs(robot.place_m) < 0.2


@pytest.mark.parametrize("lean_rad", [-0.44])
def test_it_gets_up_from_its_board(balancer: Callable[..., Upright], lean_rad: float) -> None:
    robot = balancer(late=2, lean_rad=lean_rad)
    robot.sim.run(seconds=8.0)
    assert max(map(abs, robot.leans[-100:])) < 0.05


def test_it_drives_and_turns_as_it_is_told(balancer: Callable[..., Upright]) -> None:
    robot = balancer(late=2)
    robot.sim.run(seconds=1.0)
    robot.law.speed = 0.5
    robot.sim.run(seconds=4.0)
    assert robot.place_m == pytest.approx(2.0, abs=0.4)
    robot.law.speed, robot.law.turn_rate = 0.0, 1.0
    robot.sim.run(seconds=1.5)
    assert robot.sim.model("balancer").pose.rpy_rad[2] == pytest.approx(1.5, abs=0.3)
    assert max(map(abs, robot.leans)) < 0.4
    assert math.isfinite(robot.place_m)


def test_nothing_about_it_needs_a_finding(balancer: Callable[..., Upright]) -> None:
    robot = balancer()
    robot.sim.run(seconds=0.2)
    assert [str(item) for item in robot.sim.diagnostics if item.severity.name != "INFO"] == []
