"""PR2CTL's controller as printed, in C++ (P5): it does what the one in Python does (P4)."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.cpp.control.controller_package import (
    INIT,
    PYTHON_TWIN,
    init_of_document,
    write_controller_package,
)
from tests.shared_files import SHARED, shared_cases

import gazelle
from gazelle.control.errors import ControllerError
from gazelle.interfaces import message_type, service_type
from gazelle.workspace import Workspace

TANDEM = Path(__file__).parents[3] / "examples/pr2_style_ws/src/tandem_controller"
DOCUMENT = SHARED / "workspaces/catkin_ws/src/tutorial_controller"
SEED = SHARED / "seeds/003_4402cc28eab1af51.txt"
PYTHON_PACKAGE = """\
<package format="2"><name>my_python_pkg</name><version>1.0.0</version>
<description>d</description><maintainer email="a@b.c">m</maintainer><license>MIT</license>
<buildtool_depend>catkin</buildtool_depend></package>
"""
STEPS = 1000
CASES = [
    (TANDEM / "urdf/robot.xml", TANDEM / "config/controller.yaml", "tandem_controller", None),
    *shared_cases((DOCUMENT / "robot.xml", DOCUMENT / "controller.yaml", "my_controller_ns", SEED)),
]


@pytest.fixture(scope="module")
def python_twin(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The packages of a workspace whose controller is in Python."""
    folder = tmp_path_factory.mktemp("python") / "src"
    (folder / "my_python_pkg" / "scripts").mkdir(parents=True)
    (folder / "my_python_pkg" / "package.xml").write_text(PYTHON_PACKAGE)
    (folder / "my_python_pkg" / "scripts" / "controller.py").write_text(PYTHON_TWIN)
    return folder


@pytest.fixture(scope="module")
def compiled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The packages of a workspace whose controller is in C++, the tests' own."""
    folder = tmp_path_factory.mktemp("cpp") / "src"
    write_controller_package(folder)
    return folder


@pytest.fixture(scope="module")
def sources(tmp_path_factory: pytest.TempPathFactory, compiled: Path) -> dict[Path | None, Path]:
    """Workspaces by the document that their ``init`` is taken from."""
    if not SEED.is_file():
        return {None: compiled}
    folder = tmp_path_factory.mktemp("document") / "src"
    write_controller_package(folder, init_of_document(SEED.read_text(encoding="utf-8")))
    return {None: compiled, SEED: folder}


def world(folder: Path, robot: Path, parameters: Path | None) -> gazelle.Simulation:
    """Return a world with a robot, not started, with a folder of packages."""
    workspace = Workspace.discover(extra=[folder], environ={}, cwd=folder)
    return gazelle.Simulation.load(robot, world=None, workspace=workspace, parameters=parameters)


@pytest.fixture
def tandem(compiled: Path) -> Iterator[gazelle.Simulation]:
    """The example's robot with the controller in C++."""
    robot, parameters, _, _ = CASES[0]
    with world(compiled, robot, parameters) as sim:
        yield sim


def set_gain(sim: gazelle.Simulation, name: str, **gains: float) -> dict[str, float]:
    """Change gains by dynamic_reconfigure and return all of them."""
    request = service_type("dynamic_reconfigure/Reconfigure").Request()
    double = message_type("dynamic_reconfigure/DoubleParameter")
    request.config.doubles = [double(name=key, value=value) for key, value in gains.items()]
    answer = sim.server.node.call(f"/{name}/pid_steer/set_parameters", request)
    return {one.name: one.value for one in answer.config.doubles}


def states_over_time(
    folder: Path, case: tuple[Path, Path, str, Path | None]
) -> list[tuple[float, ...]]:
    """Return positions, velocities and efforts of both wheels, and the gain p changes halfway."""
    robot, parameters, name, _ = case
    found = []
    with world(folder, robot, parameters) as sim:
        joints = sim.controller_manager().spawn(name).commands
        handles = [sim.joint(joint.partition("/")[0]) for joint in joints]
        for step in range(STEPS):
            sim.step()
            if step == STEPS // 2:
                set_gain(sim, name, p=20.0)
            found.append(
                tuple(
                    value for one in handles for value in (one.position, one.velocity, one.effort)
                )
            )
    return found


@pytest.mark.tutorial
@pytest.mark.parametrize("case", CASES)
def test_a_thousand_steps_are_those_of_the_controller_in_python(
    case: tuple[Path, Path, str, Path | None],
    sources: dict[Path | None, Path],
    python_twin: Path,
) -> None:
    in_cpp = states_over_time(sources[case[3]], case)
    assert in_cpp == states_over_time(python_twin, case)
    assert in_cpp[-1][1] == pytest.approx(0.5, abs=0.01)


@pytest.mark.tutorial
def test_it_claims_the_joints_that_it_asks_for(tandem: gazelle.Simulation) -> None:
    record = tandem.controller_manager().spawn("tandem_controller")
    assert record.type == "MyControllerPlugin"
    assert record.commands == ("joint_front/effort", "joint_rear/effort")


@pytest.mark.tutorial
def test_gains_are_live_and_kept_within_their_bounds(tandem: gazelle.Simulation) -> None:
    tandem.controller_manager().spawn("tandem_controller")
    gains = set_gain(tandem, "tandem_controller", p=20.0, d=5000.0)
    assert gains["p"] == pytest.approx(20.0)
    assert gains["d"] == pytest.approx(1000.0)
    assert gains["i"] == pytest.approx(2.0)


def test_bounds_of_the_integral_stay_on_their_sides_of_zero(tandem: gazelle.Simulation) -> None:
    tandem.controller_manager().spawn("tandem_controller")
    gains = set_gain(tandem, "tandem_controller", i_clamp_min=5.0, i_clamp_max=-5.0)
    assert (gains["i_clamp_min"], gains["i_clamp_max"]) == (0.0, 0.0)


def test_messages_reach_it_between_two_steps(tandem: gazelle.Simulation) -> None:
    tandem.controller_manager().spawn("tandem_controller")
    tandem.run(seconds=0.5)
    tandem.publish("/tandem_controller/command", message_type("std_msgs/Float64")(data=-0.5))
    tandem.run(seconds=1.0)
    assert tandem.joint("joint_front").velocity == pytest.approx(-0.5, abs=0.02)


def test_what_it_says_goes_where_the_world_speaks(
    compiled: Path, caplog: pytest.LogCaptureFixture, tmp_path: Path
) -> None:
    robot, parameters, name, _ = CASES[0]
    text = parameters.read_text(encoding="utf-8").replace("joint_rear", "joint_reer")
    wrong = tmp_path / "controller.yaml"
    wrong.write_text(text)
    with (
        world(compiled, robot, wrong) as sim,
        pytest.raises(ControllerError, match=r"init\(\) of class .*MyControllerClass.* false"),
    ):
        sim.controller_manager().spawn(name)
    assert "MyController could not find joint named 'joint_reer'" in caplog.text


def test_a_wrong_line_is_shown_with_the_compilers_words(tmp_path: Path) -> None:
    robot, parameters, name, _ = CASES[0]
    write_controller_package(tmp_path / "src", INIT.replace("n.getParam", "n.getParm"))
    with (
        world(tmp_path / "src", robot, parameters) as sim,
        pytest.raises(ControllerError, match="could not be compiled, see above"),
    ):
        sim.controller_manager().spawn(name)
    told = [item for item in sim.diagnostics if item.code == "cpp.compile-error"]
    assert len(told) == 1
    assert "getParm" in told[0].message


def test_what_update_throws_stops_it_and_nothing_else(tmp_path: Path) -> None:
    robot, parameters, name, _ = CASES[0]
    package = write_controller_package(tmp_path / "src")
    source = package / "src" / "my_controller_file.cpp"
    throwing = 'if (robot_->getTime().toSec() > 0.1) throw std::runtime_error("too late");'
    text = source.read_text().replace("ros::Duration dt =", f"{throwing}\n  ros::Duration dt =")
    source.write_text(text)
    with world(tmp_path / "src", robot, parameters) as sim:
        record = sim.controller_manager().spawn(name)
        sim.run(seconds=0.5)
        assert not record.is_active
        assert sim.time_s == pytest.approx(0.5)


def test_a_type_that_nobody_declares_is_told_with_what_was_looked_for(tmp_path: Path) -> None:
    robot, parameters, name, _ = CASES[0]
    (tmp_path / "src").mkdir()
    with (
        world(tmp_path / "src", robot, parameters) as sim,
        pytest.raises(ControllerError, match="nor does a plug-in description declare one"),
    ):
        sim.controller_manager().spawn(name)
