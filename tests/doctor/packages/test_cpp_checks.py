"""What the doctor says of a package's C++ before anybody builds it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.cpp.building import toolchain
from gazelle.diagnostics import Diagnostic, Diagnostics
from gazelle.doctor.report import Section

Check = Callable[[str, Path], tuple[Diagnostics, tuple[Section, ...]]]
Make = Callable[..., Path]
Said = Callable[..., list[Diagnostic]]

_LISTS = """cmake_minimum_required(VERSION 3.8)
project(bot)
find_package(ament_cmake REQUIRED)
find_package(rclcpp REQUIRED)
add_executable(drive src/drive.cpp)
ament_package()
"""


@pytest.fixture
def said(make: Make, check: Check) -> Said:
    """What is said of the C++ of package ``bot`` with these files."""

    def run(build_type: str = "ament_cmake", **files: str) -> list[Diagnostic]:
        diagnostics, _ = check("bot", make(build_type, **files))
        return [item for item in diagnostics if item.code.startswith("package.cpp-")]

    return run


def test_headers_of_ours_of_messages_and_of_the_package_are_here(said: Said) -> None:
    source = (
        '#include <memory>\n#include "rclcpp/rclcpp.hpp"\n#include <std_msgs/msg/string.hpp>\n'
        '#include <bot/motor.hpp>\n#include <bot/msg/level.hpp>\n#include "near.h"\n'
    )
    files = {
        "CMakeLists.txt": _LISTS,
        "src__drive.cpp": source,
        "src__near.h": "#pragma once\n#include <vector>\n",
        "include__bot__motor.hpp": "#pragma once\n",
        "msg__Level.msg": "float64 level\n",
    }
    assert said(**files) == []


def test_header_that_nothing_has_is_named_with_its_line_and_target(said: Said) -> None:
    header = "#ifndef BOT_H\n#define BOT_H\n#include <nowhere/to_be_found.hpp>\n#endif\n"
    files = {
        "CMakeLists.txt": _LISTS,
        "src__drive.cpp": '#include "bot.h"\n#ifdef HAVE_IT\n#include <other/gone.h>\n#endif\n',
        "src__bot.h": header,
    }
    (found,) = said(**files)
    assert found.code == "package.cpp-header"
    assert found.message == (
        "target 'drive' does not compile: there is no 'nowhere/to_be_found.hpp'"
    )
    assert found.span is not None and found.span.file.endswith("bot.h") and found.span.line == 3


def test_message_that_does_not_exist_is_a_header_that_does_not(said: Said) -> None:
    files = {"CMakeLists.txt": _LISTS, "src__drive.cpp": "#include <std_msgs/msg/strin.hpp>\n"}
    (found,) = said(**files)
    assert "there is no 'std_msgs/msg/strin.hpp'" in found.message


def test_package_that_is_required_and_nowhere_is_named(said: Said) -> None:
    lists = _LISTS.replace(
        "add_exec", "find_package(nowhere_at_all REQUIRED)\nfind_package(maybe QUIET)\nadd_exec"
    )
    (found,) = said(**{"CMakeLists.txt": lists, "src__drive.cpp": "int main() {}\n"})
    assert found.code == "package.cpp-package"
    assert "package 'nowhere_at_all', which CMakeLists.txt requires, is not here" in found.message


def test_components_of_catkin_are_required_too(said: Said) -> None:
    lists = (
        "cmake_minimum_required(VERSION 3.0)\nproject(bot)\n"
        "find_package(catkin REQUIRED COMPONENTS roscpp std_msgs nowhere_at_all)\n"
        "catkin_package()\nadd_executable(drive src/drive.cpp)\n"
    )
    source = "#include <ros/ros.h>\n#include <std_msgs/String.h>\n#include <bot/DriveConfig.h>\n"
    files = {"CMakeLists.txt": lists, "src__drive.cpp": source, "cfg__Drive.cfg": ""}
    found = said("catkin", **files)
    assert ["nowhere_at_all" in item.message for item in found] == [True]


def test_plug_in_of_gazebo_is_left_out_and_nodes_beside_it_are_not(said: Said) -> None:
    lists = _LISTS.replace("ament_package", "add_library(wind src/wind.cpp)\nament_package")
    files = {
        "CMakeLists.txt": lists,
        "src__drive.cpp": "#include <rclcpp/rclcpp.hpp>\n",
        "src__wind.cpp": "#include <gazebo/gazebo.hh>\n#include <nowhere/x.hpp>\n",
    }
    (found,) = said(**files)
    assert found.code == "package.cpp-left-out"
    assert found.message.startswith("target 'wind' is left out, for it needs 'gazebo': plug-ins of")


def test_without_a_compiler_the_extra_is_named(said: Said, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "/nowhere")
    monkeypatch.delenv("CXX", raising=False)
    monkeypatch.setattr(toolchain, "_zig", lambda: None)
    files = {"CMakeLists.txt": _LISTS, "src__drive.cpp": "#include <rclcpp/rclcpp.hpp>\n"}
    (found,) = said(**files)
    assert found.code == "package.cpp-compiler"
    assert "there is no C++ compiler here" in found.message
    assert found.fix == "pip install 'gazelle-sim[cpp]'"
