"""Launched stacks with a mistake in them: one clear message, with place and fix."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from tests.launch.conftest import write_package

from gazelle.cli.main import main
from gazelle.graph import locators

Run = Callable[..., Any]

_ROBOT = """<robot name="r">
  <link name="base">
    <inertial><mass value="{mass}"/>
      <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><geometry><mesh filename="package://tests_pkg/meshes/none.dae"/></geometry></visual>
  </link>
  <link name="arm">
    <inertial><mass value="1"/><inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  {joint}
  <gazebo><plugin name="mine" filename="libmine.so"/></gazebo>
</robot>
"""
_JOINT = (
    '<joint name="j" type="continuous"><parent link="base"/><child link="arm"/>'
    '<axis xyz="0 0 1"/></joint>'
)
_WORLD = """<sdf version="1.6"><world name="w">
  <include><uri>model://tablet</uri></include>
  <include><uri>model://ground_plane</uri></include>
</world></sdf>
"""
_LAUNCH = """<launch>
  <include file="$(find gazebo_ros)/launch/empty_world.launch">
    <arg name="world_name" value="$(find tests_pkg)/some.world"/>
    <arg name="gui" value="false"/>
    <arg name="paused" value="true"/>
  </include>
  <param name="robot_description" textfile="$(find tests_pkg)/robot.urdf"/>
  <node pkg="robot_state_publisher" type="robot_state_publisher" name="rsp"/>
  <node pkg="gazebo_ros" type="spawn_model" name="spawn" output="screen"
        args="-urdf -param robot_description -model r"/>
</launch>
"""


def _write(package: Path, mass: str = "1", joint: str = _JOINT) -> None:
    """Write a launch file with a world and a robot in it."""
    robot = _ROBOT.format(mass=mass, joint=joint)
    texts = {"robot.urdf": robot, "robot.launch": _LAUNCH, "some.world": _WORLD}
    for name, text in texts.items():
        (package / name).write_text(text, encoding="utf-8")


@dataclass
class _Mistaken:
    """A launch that goes on in spite of all the mistakes in its world and its robot.

    Attributes:
        run: the launch, when its robot is spawned.
        package: with the files.
        models: the folder of models it was told of.
    """

    run: Any
    package: Path
    models: Path


@pytest.fixture(scope="module")
def mistaken(module_gazelle: Run, tmp_path_factory: pytest.TempPathFactory) -> _Mistaken:
    """One launch for all that only look at what it says."""
    folder = tmp_path_factory.mktemp("mistaken")
    package, models = write_package(folder), folder / "models"
    models.mkdir()
    _write(package, mass="1kg")
    run = module_gazelle(
        "roslaunch", "tests_pkg", "robot.launch", cwd=folder, GAZEBO_MODEL_PATH=str(models)
    )
    run.wait_for_line("Spawn status: SpawnModel: Successfully spawned entity")
    return _Mistaken(run, package, models)


def _only(lines: list[str], code: str) -> str:
    """Return the first line of the one finding with a code."""
    # The code ends the message; lines of the log start with their level.
    ends = [i for i, line in enumerate(lines) if re.match(rf"[^\[].* \[{code}\]$", line)]
    assert len(ends) == 1, "\n".join(lines)
    heads = [line for line in lines[: ends[0] + 1] if re.match(r"\S+:\d+:\d+: \w+: ", line)]
    return heads[-1]


def test_missing_mesh_zero_inertia_and_unknown_plugin_are_told_and_the_robot_is_spawned(
    mistaken: _Mistaken,
) -> None:
    run, package = mistaken.run, mistaken.package
    urdf = package / "robot.urdf"
    mesh = _only(run.lines, "urdf.mesh-missing")
    assert mesh.startswith(f"{urdf}:5:23: warning: the visual mesh of link 'base' cannot be seen")
    assert f"    {package / 'meshes' / 'none.dae'}" in run.text
    inertia = _only(run.lines, "urdf.zero-inertia")
    assert inertia.startswith(
        f"{urdf}:8:5: warning: link 'arm' moves with 1 kg and an inertia of 0"
    )
    plugin = _only(run.lines, "plugin.unknown")
    assert plugin.startswith(f"{urdf}:11:11: warning: plug-in 'libmine.so'")
    assert run.popen.poll() is None


def test_bad_number_is_named_and_the_link_goes_without_inertial(mistaken: _Mistaken) -> None:
    """urdfdom: "Could not parse inertial element for Link [base]", and the robot is taken."""
    run, urdf = mistaken.run, mistaken.package / "robot.urdf"
    line = _only(run.lines, "xml.bad-number")
    assert line.startswith(f"{urdf}:3:28: warning: <mass value>: '1kg' is not a finite number")
    assert '    <inertial><mass value="1kg"/>\n' in run.text


def test_two_roots_are_named_by_the_simulator_and_in_one_line_by_other_nodes(
    gazelle: Run, package: Path, tmp_path: Path
) -> None:
    _write(package, joint="")
    run = gazelle("roslaunch", "tests_pkg", "robot.launch", cwd=tmp_path)
    run.wait_for_line(r"\[spawn-\d\] process has died")
    line = _only(run.lines, "urdf.two-roots")
    assert line.startswith(f"{package / 'robot.urdf'}:7:3: error: two root links found: 'base' and")
    run.wait_for_line(r"\[FATAL\].*robot_description is no robot: two root links found")
    run.wait_for_line(r"\[rsp-\d\] process has died")


def test_missing_model_lists_where_it_was_looked_for_and_the_world_goes_on(
    mistaken: _Mistaken,
) -> None:
    run, world = mistaken.run, mistaken.package / "some.world"
    line = _only(run.lines, "sdf.missing-model")
    assert line.startswith(f"{world}:2:12: warning: included model 'model://tablet' not found")
    assert f"    {mistaken.models / 'tablet'}" in run.lines
    answer = run.call("/gazebo/get_world_properties", "gazebo_msgs/srv/GetWorldProperties")
    assert answer.model_names == ["ground_plane", "r"]


def test_all_mistakes_of_a_launch_file_are_told_at_once_and_nothing_starts(
    gazelle: Run, package: Path, tmp_path: Path
) -> None:
    file = package / "bad.launch"
    file.write_text(
        '<launch>\n<include file="$(find no_such_pkg)/x.launch"/>\n'
        '<include file="$(find tests_pkg)/bda.launch"/>\n'
        '<include file="$(find tests_pkg)/bad.launch"/>\n'
        '<param name="p" textfile="/no/such/file"/>\n</launch>',
        encoding="utf-8",
    )
    run = gazelle("roslaunch", "tests_pkg", "bad.launch", cwd=tmp_path)
    assert run.wait() == 1
    expected = [
        ("launch.package-missing", 2, "$(find no_such_pkg): package 'no_such_pkg' not found"),
        ("launch.include-missing", 3, "No such file or directory"),
        ("launch.include-cycle", 4, f"include cycle: {file} → {file}"),
        ("xml.unreadable", 5, "textfile '/no/such/file': No such file or directory"),
    ]
    for code, line, text in expected:
        found = _only(run.lines, code)
        assert found.startswith(f"{file}:{line}:1: error: ")
        assert text in found
    assert "did you mean 'bad.launch'?" in run.text
    assert "started with pid" not in run.text


def test_launch_whose_nodes_all_miss_ends_with_an_error(
    gazelle: Run, package: Path, tmp_path: Path
) -> None:
    file = package / "none.launch"
    file.write_text(
        '<launch><node pkg="tests_pkg" type="dose" name="a"/></launch>', encoding="utf-8"
    )
    run = gazelle("roslaunch", "tests_pkg", "none.launch", cwd=tmp_path)
    assert run.wait() == 1
    assert "Cannot locate node of type [dose] in package [tests_pkg]" in run.text
    assert "fix: did you mean 'does'?" in run.text
    assert run.lines[-1] == "none of the nodes can be started, roslaunch will exit"


def test_taken_port_is_named_with_two_ways_out(
    node: Run,
    stranger: int,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    # A busy hub is given ten seconds to answer; this one never will.
    monkeypatch.setattr("gazelle.graph.graph._HUB_S", 0.2)
    monkeypatch.setenv("GAZELLE_PORT", str(stranger))
    file = tmp_path / "taken.launch"
    file.write_text(f"<launch>{node('one', 'say=hi')}</launch>", encoding="utf-8")
    assert main(["roslaunch", str(file)]) == 1
    told = capsys.readouterr()
    assert f"the graph on port {stranger} does not answer: who listens at" in told.err
    assert f"fuser {locators.name_of_hub(stranger)}" in told.err
    assert f"export GAZELLE_PORT={stranger + 1}" in told.err
    assert "started with pid" not in told.out + told.err


def test_unreadable_and_missing_files_are_told(gazelle: Run, package: Path, tmp_path: Path) -> None:
    broken = tmp_path / "broken.launch"
    broken.write_bytes(b"\xff\xfe\x00bad")
    run = gazelle("roslaunch", str(broken))
    assert run.wait() == 1
    assert run.lines[0].startswith(f"{broken}:1:2: error: not well-formed XML")
    run = gazelle("roslaunch", "tests_pkg", "nothing.launch", cwd=tmp_path)
    assert run.wait() == 1
    assert "launch file 'nothing.launch' not found" in run.text
    run = gazelle("roslaunch", str(tmp_path / "gone.launch"))
    assert run.wait() == 1
    assert f"launch file '{tmp_path / 'gone.launch'}' not found" in run.text
