"""C++ of ROS 2 in launches, with ros2 run and after colcon build."""

from __future__ import annotations

import os
import subprocess

import pytest
from tests.cpp.launch.conftest import Gazelle, Workspace
from tests.cpp.launch.ros2_package import FILES, LAUNCH
from tests.patience import stretched

pytestmark = pytest.mark.skipif(os.name == "nt", reason="node files are ELF")

_GOOD = {name: text for name, text in FILES.items() if name.startswith("replies/")}
_BROKEN = {name: text for name, text in FILES.items() if name.startswith("broken/")}
_SHORT = _GOOD | {
    "replies/src/replier.cpp": "#include <rclcpp/rclcpp.hpp>\n#include <cstdio>\n"
    "int main(int argc, char** argv) {\n  auto rest = rclcpp::init_and_remove_ros_arguments(argc,"
    ' argv);\n  rclcpp::shutdown();\n  printf("it is %zu\\n", rest.size());\n}\n'
}


def test_launch_compiles_nodes_and_components_and_goes_on_without_what_fails(
    workspace: Workspace, gazelle: Gazelle
) -> None:
    top = workspace({**FILES, "replies/launch/all.launch.py": LAUNCH})
    ran = gazelle("ros2", "launch", "replies", "all.launch.py", folder=top)
    told = ran.stdout + ran.stderr
    assert ran.returncode == 1, told
    assert f"{top}/src/broken/src/bad.cpp:4" in told, told
    assert "no_such_name" in told
    assert "it does not compile; the others go on" in told
    assert "ready to reply" in told
    assert "Loaded node '/doubler' in container '/box'" in told
    assert "python heard who!who!" in told
    assert "replier ends" in told


def test_ros2_run_compiles_and_passes_arguments(workspace: Workspace, gazelle: Gazelle) -> None:
    top = workspace(_SHORT)
    words = ("ros2", "run", "replies", "replier", "one", "--ros-args", "-p", "sign:=x")
    ran = gazelle(*words, folder=top)
    assert (ran.returncode, ran.stdout) == (0, "it is 2\n"), ran.stderr


def test_colcon_build_installs_programs_that_run_by_themselves(
    workspace: Workspace, gazelle: Gazelle
) -> None:
    top = workspace(_SHORT)
    built = gazelle("colcon", "build", folder=top)
    assert built.returncode == 0, built.stdout + built.stderr
    program = top / "install/replies/lib/replies/replier"
    ran = subprocess.run(
        [program, "a"], capture_output=True, text=True, timeout=stretched(), check=False
    )
    assert ran.stdout == "it is 2\n", ran.stderr
    assert (top / "install/replies/lib/libdoubler.so").is_file()
    assert (top / "build/replies/compile_commands.json").is_file()
    found = gazelle(
        "ros2",
        "pkg",
        "executables",
        "replies",
        folder=top,
        AMENT_PREFIX_PATH=str(top / "install/replies"),
    )
    assert found.stdout.splitlines() == ["replies asker.py", "replies replier"]


def test_mistake_fails_colcon_build_and_ros2_run(workspace: Workspace, gazelle: Gazelle) -> None:
    top = workspace(_BROKEN)
    built = gazelle("colcon", "build", folder=top)
    assert built.returncode != 0
    assert "Failed   <<< broken" in built.stderr
    assert f"{top}/src/broken/src/bad.cpp:4" in built.stderr
    ran = gazelle("ros2", "run", "broken", "bad", folder=top)
    assert ran.returncode == 1
    assert "no_such_name" in ran.stderr and "'bad' does not compile" in ran.stderr
