"""Which command a (package, type) means, and what is said when there is none."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.launch.launch_config import LaunchConfig, NodeTag
from gazelle.launch.node_commands import Executable, executables_of, find_executable
from gazelle.launch.roslaunch import LaunchOptions, find_executables
from gazelle.node_specs.registry import node_specs
from gazelle.node_specs.unavailable_packages import missing_node
from gazelle.workspace import Workspace

_SPAN = SourceSpan("a.launch", 3, 5)


def _find(
    package: str, type_name: str, folder: Path, **environ: str
) -> tuple[Executable | None, Diagnostics]:
    diagnostics = Diagnostics()
    workspace = Workspace.discover(environ={}, cwd=folder)
    found = find_executable(
        package, type_name, workspace=workspace, diagnostics=diagnostics, span=_SPAN,
        environ=environ,
    )  # fmt: skip
    return found, diagnostics


def test_python_script_runs_through_the_runner(package: Path) -> None:
    found, diagnostics = _find("tests_pkg", "does", package)
    assert found is not None and not list(diagnostics)
    script = package / "scripts" / "does"
    assert found.command == (sys.executable, "-m", "gazelle.compat.script_runner", str(script))
    assert found.folder == script.parent


def test_other_scripts_run_as_they_are(package: Path) -> None:
    script = package / "scripts" / "greet.sh"
    script.write_text("#!/bin/sh\necho hi\n", encoding="utf-8")
    script.chmod(0o755)
    found, _ = _find("tests_pkg", "greet.sh", package)
    assert found is not None and found.command == (str(script),)


def test_file_of_the_workspace_wins_over_a_built_in_node(package: Path) -> None:
    own = package.parent / "robot_state_publisher"
    package.rename(own)
    manifest = own / "package.xml"
    text = manifest.read_text(encoding="utf-8").replace("tests_pkg", "robot_state_publisher")
    manifest.write_text(text, encoding="utf-8")
    (own / "scripts" / "does").rename(own / "scripts" / "robot_state_publisher")
    found, _ = _find("robot_state_publisher", "robot_state_publisher", own)
    assert found is not None and found.builtin is None


@pytest.mark.parametrize(
    ("package_name", "type_name", "command"),
    [
        ("rostopic", "rostopic", "rostopic"),
        ("rosservice", "rosservice", "rosservice"),
        ("tf", "tf_echo", "tf_echo"),
    ],
)
def test_commands_are_nodes_too(
    tmp_path: Path, package_name: str, type_name: str, command: str
) -> None:
    found, _ = _find(package_name, type_name, tmp_path)
    assert found is not None
    assert found.command == (sys.executable, "-m", "gazelle.cli", command)


def test_executable_of_an_installed_ros_is_the_last_resort(tmp_path: Path) -> None:
    native = tmp_path / "prefix" / "lib" / "some_pkg" / "some_node"
    native.parent.mkdir(parents=True)
    native.write_bytes(b"\x7fELF")
    native.chmod(0o755)
    found, _ = _find("some_pkg", "some_node", tmp_path, AMENT_PREFIX_PATH=str(tmp_path / "prefix"))
    assert found is not None and found.command == (str(native),)


def test_built_in_node_stands_for_the_users_own_compiled_one(package: Path) -> None:
    folder = package.parent / "turtlebot3_gazebo"
    (folder / "src").mkdir(parents=True)
    (folder / "src" / "turtlebot3_drive.cpp").write_text("int main() {}\n", encoding="utf-8")
    (folder / "CMakeLists.txt").write_text(
        "add_executable(turtlebot3_drive src/turtlebot3_drive.cpp)\n", encoding="utf-8"
    )
    manifest = "<package><name>turtlebot3_gazebo</name><version>1.0.0</version></package>"
    (folder / "package.xml").write_text(manifest, encoding="utf-8")
    found, diagnostics = _find("turtlebot3_gazebo", "turtlebot3_drive", folder)
    assert found is not None and found.builtin is not None
    assert found.builtin.entry == "gazelle.nodes.turtlebot3.drive:run"
    (told,) = diagnostics
    assert told.code == "launch.builtin-instead"
    script = folder / "scripts" / "turtlebot3_drive"
    script.parent.mkdir()
    script.write_text("#!/usr/bin/env python3\n", encoding="utf-8")
    script.chmod(0o755)
    found, _ = _find("turtlebot3_gazebo", "turtlebot3_drive", folder)
    assert found is not None and found.command[-1] == str(script)


def test_misspelled_built_in_node_is_corrected_without_its_package(tmp_path: Path) -> None:
    _, diagnostics = _find("turtlebot3_fake", "turtlebot3_fake_nod", tmp_path)
    (error,) = diagnostics
    assert error.code == "launch.executable-missing"
    assert error.message.endswith("the package has: turtlebot3_fake_node")
    assert error.fix == "did you mean 'turtlebot3_fake_node'?"


def test_missing_package_is_named_with_its_place(package: Path) -> None:
    found, diagnostics = _find("tests_pgk", "does", package)
    (error,) = diagnostics
    assert found is None
    assert (error.code, error.span) == ("launch.package-missing", _SPAN)
    assert "package 'tests_pgk' not found; did you mean 'tests_pkg'?" in error.message


@pytest.mark.parametrize(
    ("package_name", "fix"),
    [
        ("velodyne_driver", "velodyne_driver is the driver of a real laser scanner"),
        ("plotjuggler", "plotjuggler is a window that is not here; `rviz` opens Studio"),
        ("image_transport", "image_transport is the way of compressed pictures; cameras send"),
        ("diagnostic_aggregator", "diagnostic_aggregator is the summary of /diagnostics"),
        ("yocs_velocity_smoother", "yocs_velocity_smoother is compiled code that smooths"),
    ],
)
def test_missing_package_of_ros_is_told_with_what_does_its_work(
    package: Path, package_name: str, fix: str
) -> None:
    _, diagnostics = _find(package_name, "node", package)
    (error,) = diagnostics
    assert error.message == f"package '{package_name}' not found"
    assert error.fix.startswith(fix)


@pytest.mark.parametrize(
    ("node", "fix"),
    [
        (("joy", "game_controller_node"), "game_controller_node is SDL's layout of game contr"),
        (("robot_localization", "ukf_node"), "ukf_node is the unscented filter; `ekf_node` fuses"),
    ],
)
def test_a_program_that_its_package_lacks_here_is_told_with_what_does_its_work(
    package: Path, node: tuple[str, str], fix: str
) -> None:
    _, diagnostics = _find(*node, package)
    (error,) = diagnostics
    assert error.code == "launch.executable-missing"
    assert error.fix.startswith(fix)


def test_none_of_the_programs_that_are_told_as_missing_is_there() -> None:
    there = [
        (node.package, node.executable)
        for node in node_specs()
        if missing_node(node.package, node.executable)
    ]
    assert there == []


def test_missing_executable_lists_what_there_is(package: Path) -> None:
    (package / "scripts" / "drive.py").write_text("print()\n", encoding="utf-8")
    _, diagnostics = _find("tests_pkg", "driver.py", package)
    (error,) = diagnostics
    assert error.code == "launch.executable-missing"
    assert error.message == (
        "Cannot locate node of type [driver.py] in package [tests_pkg]; "
        "the package has: does, drive.py"
    )
    assert error.fix == "did you mean 'drive.py'?"


def test_compiled_node_is_called_so(package: Path) -> None:
    (package / "src").mkdir()
    source = package / "src" / "planner.cpp"
    source.write_text("int main() {}\n", encoding="utf-8")
    _, diagnostics = _find("tests_pkg", "planner", package)
    (error,) = diagnostics
    assert error.code == "launch.compiled-node"
    assert f"it is compiled code ('{source}') that no add_executable() makes" in error.message


@pytest.mark.parametrize(
    "lists",
    [
        "add_executable(robot_node src/main.cpp)",
        'set(EXECUTABLE_NAME "robot_node")\nadd_executable(${EXECUTABLE_NAME} src/main.cpp)',
        "project(robot)\nadd_executable(${PROJECT_NAME}_node src/main.cpp)",
        'rclcpp_components_register_node(robot PLUGIN "robot::Node" EXECUTABLE robot_node)',
        "add_executable(robot src/main.cpp)\n"
        "set_target_properties(robot PROPERTIES OUTPUT_NAME robot_node PREFIX x)",
        "rosbuild_add_executable(robot_node src/main.cpp)",
        "macro(my_node name)\nadd_executable(${name}_node src/${name}.cpp)\nendmacro()\n"
        "my_node(robot)",
        "function(my_node folder)\nadd_executable(${ARGN} src/a.cpp)\nendfunction()\n"
        "my_node(src robot_node)",
    ],
)
def test_node_that_a_cmake_file_makes_is_compiled_before_it_starts(
    package: Path, lists: str
) -> None:
    file = package / "CMakeLists.txt"
    file.write_text(f"{lists}\n", encoding="utf-8")
    found, diagnostics = _find("tests_pkg", "robot_node", package)
    assert found is not None and not list(diagnostics)
    assert found.cpp is not None and found.cpp.name == "tests_pkg/robot_node"
    assert found.is_of_cpp and found.command[-3:] == (str(package), "tests_pkg", "robot_node")


def test_script_wins_over_cpp_of_the_same_name(package: Path) -> None:
    (package / "CMakeLists.txt").write_text("add_executable(does a.cpp)\n", encoding="utf-8")
    found, _ = _find("tests_pkg", "does", package)
    assert found is not None and found.script == package / "scripts" / "does"


def _with_cpp_of_turtlesim(package: Path) -> Path:
    own = package.parent / "turtlesim"
    package.rename(own)
    manifest = own / "package.xml"
    text = manifest.read_text(encoding="utf-8").replace("tests_pkg", "turtlesim")
    manifest.write_text(text, encoding="utf-8")
    (own / "CMakeLists.txt").write_text("add_executable(draw_square d.cpp)\n", encoding="utf-8")
    return own


def test_cpp_is_taken_where_it_is_asked_for(package: Path) -> None:
    own = _with_cpp_of_turtlesim(package)
    found, diagnostics = _find("turtlesim", "draw_square", own, GAZELLE_CPP="1")
    assert found is not None and found.cpp is not None and not list(diagnostics)
    found, _ = _find("turtlesim", "draw_square", own, GAZELLE_CPP="0")
    assert found is not None and found.cpp is None


def test_names_of_cpp_are_offered(package: Path) -> None:
    (package / "CMakeLists.txt").write_text(
        "add_executable(talker a.cpp)\nadd_executable(${unknown} b.cpp)\n", encoding="utf-8"
    )
    workspace = Workspace.discover(environ={}, cwd=package)
    assert executables_of("tests_pkg", workspace) == ("does", "talker")
    assert "talker" in workspace.package("tests_pkg").executable_names


def test_script_without_execute_permission_runs_with_a_warning(package: Path) -> None:
    script = package / "scripts" / "drive.py"
    script.write_text("print('hi')\n", encoding="utf-8")
    found, diagnostics = _find("tests_pkg", "drive.py", package)
    (warning,) = diagnostics
    assert found is not None
    assert warning.code == "launch.not-executable"
    assert warning.fix == f"chmod +x {script}"


def test_node_for_another_machine_runs_here_and_that_is_said(package: Path) -> None:
    spec = NodeTag("tests_pkg", "does", "one", machine="robot1", span=_SPAN)
    config, diagnostics = LaunchConfig(nodes=[spec]), Diagnostics()
    nodes, missing = find_executables(
        config, Workspace.discover(environ={}, cwd=package), diagnostics, LaunchOptions()
    )
    assert (len(nodes), missing) == (1, 0)
    (told,) = diagnostics
    assert told.code == "launch.remote-machine"
    assert "node 'one' asks for machine 'robot1'; it runs here" in told.message


def test_console_script_needs_no_executable_file(tmp_path: Path) -> None:
    folder = tmp_path / "demo"
    (folder / "demo").mkdir(parents=True)
    (folder / "package.xml").write_text(
        "<package format='3'><name>demo</name><version>0.0.1</version><description/>"
        "<maintainer email='a@b.c'>a</maintainer><license>MIT</license></package>",
        encoding="utf-8",
    )
    (folder / "setup.py").write_text(
        "setup(entry_points={'console_scripts': ['talk = demo.talker:main']})", encoding="utf-8"
    )
    (folder / "demo" / "talker.py").write_text("def main(): ...\n", encoding="utf-8")
    found, diagnostics = _find("demo", "talk", folder)
    assert found is not None and not list(diagnostics)
    assert found.command[-1] == str(folder / "demo" / "talker.py")


def test_console_scripts_of_one_file_call_their_own_functions(tmp_path: Path) -> None:
    folder = tmp_path / "src" / "pair"
    (folder / "pair").mkdir(parents=True)
    (folder / "package.xml").write_text("<package format='3'><name>pair</name></package>")
    (folder / "pair" / "__init__.py").write_text("")
    (folder / "pair" / "nodes.py").write_text(
        "def main():\n    print('main')\n\ndef talk():\n    print('talking')\n"
    )
    (folder / "setup.py").write_text(
        "from setuptools import setup\nsetup(name='pair', entry_points={'console_scripts': "
        "['talker = pair.nodes:talk', 'listener = pair.nodes:main']})\n"
    )
    said = {}
    for name in ("talker", "listener"):
        found, _ = _find("pair", name, tmp_path)
        assert found is not None
        ran = subprocess.run(found.command, capture_output=True, text=True, check=True)
        said[name] = ran.stdout.strip()
    assert said == {"talker": "talking", "listener": "main"}
