"""Completion, and the shell functions of ``gazelle env``."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

from gazelle.cli.commands import COMMANDS
from gazelle.cli.completion import candidates, subcommands
from gazelle.cli.main import main
from gazelle.graph import Node
from gazelle.sensors.view_cameras import VIEWS

_MANIFEST = """<package format="2"><name>demo_pkg</name><version>0.1.0</version>
<description>d</description><maintainer email="a@b.example">A</maintainer><license>MIT</license>
</package>"""


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The package demo_pkg with a launch file and a node."""
    folder = tmp_path / "src" / "demo_pkg"
    (folder / "launch").mkdir(parents=True)
    (folder / "package.xml").write_text(_MANIFEST, encoding="utf-8")
    (folder / "launch" / "demo.launch").write_text("<launch/>", encoding="utf-8")
    (folder / "talk.py").write_text("#!/usr/bin/env python3\n", encoding="utf-8")
    (folder / "talk.py").chmod(0o755)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    monkeypatch.chdir(tmp_path)
    return folder


def test_commands_and_subcommands() -> None:
    assert candidates("gazelle", ["rostop"]) == ["rostopic"]
    assert candidates("gazelle", ["rostopic", "ec"]) == ["echo"]
    assert candidates("rosnode", ["k"]) == ["kill"]
    assert candidates("rosmsg", ["pack"]) == ["package", "packages"]
    assert candidates("rosclean", [""]) == ["check", "purge"]
    assert candidates("gz", ["w"]) == ["world"]
    assert candidates("ros2", ["lif"]) == ["lifecycle"]
    assert candidates("ros2", ["lifecycle", "se"]) == ["set"]
    assert candidates("nonsense", [""]) == []


def test_options_of_record_whose_values_are_words() -> None:
    assert candidates("record", ["--camera", "f"]) == ["fixed", "follow"]
    assert candidates("record", ["--view", ""]) == sorted(VIEWS)
    assert candidates("record", ["-o", ""]) == []


@pytest.mark.parametrize(
    "name", ["rostopic", "rosservice", "rosparam", "ros2", "controller_manager"]
)
def test_tables_of_commands_are_found(name: str) -> None:
    assert name in COMMANDS
    assert "list" in subcommands(name) or "param" in subcommands(name)


def test_packages_and_what_is_in_them(package: Path) -> None:
    assert candidates("roscd", ["demo"]) == ["demo_pkg"]
    assert candidates("roslaunch", ["demo_pkg", ""]) == ["demo.launch"]
    assert candidates("record", ["-o", "a.html", "demo_p"]) == ["demo_pkg"]
    assert candidates("record", ["--fast", "demo_pkg", ""]) == ["demo.launch"]
    assert candidates("rosrun", ["demo_pkg", "t"]) == ["talk.py"]
    assert candidates("ros2", ["run", "topic_tools", "m"]) == ["mux"]
    assert candidates("rosrun", ["no_such_pkg", ""]) == []


@pytest.mark.usefixtures("package")
def test_built_in_nodes_are_those_of_the_commands_ros() -> None:
    keyboard = "teleop_twist_keyboard"
    assert candidates("rosrun", [keyboard, "teleop"]) == ["teleop_twist_keyboard.py"]
    assert candidates("ros2", ["run", keyboard, "teleop"]) == ["teleop_twist_keyboard"]
    assert candidates("roslaunch", ["turtlebot3_fa"]) == ["turtlebot3_fake"]
    assert candidates("ros2", ["launch", "turtlebot3_fa"]) == ["turtlebot3_fake_node"]


def test_names_of_the_graph(robot: Node, capsys: Any) -> None:
    robot.create_publisher("/cmd_vel", "geometry_msgs/Twist")
    assert main(["complete", "rostopic", "echo", "/cmd"]) == 0
    assert capsys.readouterr().out == "/cmd_vel\n"
    assert candidates("rosnode", ["info", "/ro"]) == ["/robot"]
    assert candidates("ros2", ["topic", "hz", "/cmd"]) == ["/cmd_vel"]


def test_parameters_of_the_graph(robot: Node) -> None:
    robot.graph.parameters.set("/robot/rate", 5)
    assert candidates("rosparam", ["get", "/robot/r"]) == ["/robot/rate"]
    assert candidates("rosparam", ["set", "/robot/rate", ""]) == []


def test_types_in_the_words_of_each_generation(port: int) -> None:
    assert "geometry_msgs/TwistStamped" in candidates("rosmsg", ["show", "geometry_msgs/Tw"])
    assert candidates("rostopic", ["pub", "/cmd_vel", "geometry_msgs/PointS"]) == [
        "geometry_msgs/PointStamped"
    ]
    assert candidates("ros2", ["interface", "show", "std_srvs/srv/Tr"]) == ["std_srvs/srv/Trigger"]
    assert candidates("rossrv", ["package", "std_s"]) == ["std_srvs"]
    assert candidates("ros2", ["topic", "ec"]) == ["echo"]


def test_arguments_of_a_launch_file(package: Path) -> None:
    text = '<launch><arg name="model" default="m"/><arg name="fixed" value="1"/></launch>'
    (package / "launch" / "demo.launch").write_text(text, encoding="utf-8")
    assert candidates("roslaunch", ["demo_pkg", "demo.launch", "m"]) == ["model:="]
    assert candidates("record", ["demo_pkg", "demo.launch", "m"]) == ["model:="]
    assert candidates("roslaunch", ["demo_pkg", "demo.launch", "f"]) == []
    assert candidates("roslaunch", ["demo_pkg", "no.launch", ""]) == []


def test_without_a_graph_nothing_is_offered(port: int) -> None:
    assert candidates("rostopic", ["echo", "/"]) == []


def _env(capsys: Any, shell: str) -> str:
    capsys.readouterr()
    assert main(["env", "--shell", shell]) == 0
    return str(capsys.readouterr().out)


@pytest.mark.parametrize("shell", ["dash", "bash", "zsh"])
def test_functions_work_in_a_shell(package: Path, capsys: Any, shell: str) -> None:
    if shutil.which(shell) is None:
        pytest.skip(f"{shell} is not installed")
    script = f"""{_env(capsys, "sh")}
roscd demo_pkg/launch && pwd; rosls demo_pkg; roscp demo_pkg demo.launch /dev/stdout; echo
EDITOR=echo rosed demo_pkg talk.py; roscd; pwd; roscd no_such_pkg; echo $?"""
    done = subprocess.run([shell, "-c", script], capture_output=True, text=True, check=False)
    folder = package
    assert done.stdout.splitlines() == [
        f"{folder}/launch", "launch", "package.xml", "talk.py", "<launch/>",
        f"{folder}/talk.py", str(folder.parent), "1",
    ]  # fmt: skip
    assert "roscd: No such package/stack 'no_such_pkg'" in done.stderr


def test_bash_completes(package: Path, capsys: Any) -> None:
    if shutil.which("bash") is None:
        pytest.skip("bash is not installed")
    script = f"""{_env(capsys, "bash")}
COMP_WORDS=(rosrun demo_pkg ta); COMP_CWORD=2; _gazelle_complete; echo "${{COMPREPLY[@]}}"
complete -p rostopic roscd"""
    done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines() == [
        "talk.py",
        "complete -o default -F _gazelle_complete rostopic",
        "complete -o default -F _gazelle_complete roscd",
    ]


def test_fish_gets_its_own_words(package: Path, capsys: Any) -> None:
    text = _env(capsys, "fish")
    assert "set -gx ROS_MASTER_URI http://localhost:11311\n" in text
    assert "function roscd; _gazelle_path roscd $argv[1]; and cd $_gazelle_found; end\n" in text
    assert "export" not in text
    assert main(["env", "--shell", "tcsh"]) == 2
