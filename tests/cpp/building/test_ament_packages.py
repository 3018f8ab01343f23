"""Packages of ROS 2 are built, exported and installed as ament_cmake would."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.cpp.building.conftest import Packages, manifest, needs_compiler

from gazelle.cpp.building.build import build_package, ensure_built, ensure_installed
from gazelle.cpp.elf_file import is_node_file
from gazelle.diagnostics import Diagnostics
from gazelle.workspace import Workspace
from gazelle.workspace.building.compile_step import CompileRequest
from gazelle.workspace.building.packages import find_packages, in_order

pytestmark = [needs_compiler, pytest.mark.usefixtures("stub_runtime"), pytest.mark.slow(20)]

SHAPES = {
    "shapes/package.xml": manifest("shapes", "ament_cmake", "std_msgs", "rclcpp"),
    "shapes/CMakeLists.txt": """
        cmake_minimum_required(VERSION 3.5)
        project(shapes)
        find_package(ament_cmake_ros REQUIRED)
        find_package(std_msgs REQUIRED)
        find_package(rclcpp REQUIRED)
        find_package(rosidl_default_generators REQUIRED)
        rosidl_generate_interfaces(${PROJECT_NAME}
          "msg/Side.msg" "srv/Turn.srv" DEPENDENCIES std_msgs)
        add_library(area src/area.cpp)
        target_include_directories(area PUBLIC
          $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
          $<INSTALL_INTERFACE:include>)
        ament_target_dependencies(area rclcpp std_msgs)
        rosidl_get_typesupport_target(typesupport ${PROJECT_NAME} rosidl_typesupport_cpp)
        target_link_libraries(area "${typesupport}")
        install(DIRECTORY include/ DESTINATION include)
        install(TARGETS area EXPORT export_shapes ARCHIVE DESTINATION lib
                LIBRARY DESTINATION lib RUNTIME DESTINATION bin)
        ament_export_targets(export_shapes HAS_LIBRARY_TARGET)
        ament_export_dependencies(rclcpp std_msgs)
        if(BUILD_TESTING)
          find_package(ament_lint_auto REQUIRED)
          ament_lint_auto_find_test_dependencies()
        endif()
        ament_package()
    """,
    "shapes/msg/Side.msg": "std_msgs/Header header\nfloat64 length\n",
    "shapes/srv/Turn.srv": "float64 angle\n---\nbool done\n",
    "shapes/include/shapes/area.hpp": "#pragma once\nnamespace shapes { int area(); }\n",
    "shapes/src/area.cpp": "#include <shapes/area.hpp>\nint shapes::area() { return 3; }\n",
}
DRAWER = {
    "drawer/package.xml": manifest(
        "drawer", "ament_cmake", "shapes", "rclcpp", "rclcpp_components"
    ),
    "drawer/CMakeLists.txt": """
        cmake_minimum_required(VERSION 3.8)
        project(drawer)
        find_package(ament_cmake REQUIRED)
        find_package(rclcpp REQUIRED)
        find_package(rclcpp_components REQUIRED)
        find_package(shapes REQUIRED)
        add_executable(draw src/draw.cpp)
        ament_target_dependencies(draw rclcpp shapes)
        add_executable(modern src/draw.cpp)
        target_link_libraries(modern PUBLIC shapes::area rclcpp::rclcpp ${std_msgs_TARGETS})
        add_library(component SHARED src/component.cpp)
        ament_target_dependencies(component rclcpp rclcpp_components)
        rclcpp_components_register_nodes(component "drawer::One" "drawer::Two")
        install(TARGETS component DESTINATION lib)
        install(TARGETS draw modern DESTINATION lib/${PROJECT_NAME})
        ament_package()
    """,
    "drawer/src/draw.cpp": (
        "#include <shapes/area.hpp>\nint main(int, char **) { return shapes::area(); }\n"
    ),
    "drawer/src/component.cpp": "int component() { return 1; }\n",
}


def opened(top: Path) -> Workspace:
    return Workspace.discover(environ={}, cwd=top, extra=[top])


@pytest.mark.parametrize("program", ["draw", "modern"])
def test_a_node_uses_what_another_package_exports(packages: Packages, program: str) -> None:
    workspace, found = opened(packages(SHAPES | DRAWER)), Diagnostics()
    file = ensure_built(
        workspace.package("drawer"), program, workspace=workspace, diagnostics=found
    )
    assert [item.message for item in found] == []
    assert file is not None
    assert is_node_file(file)


def test_messages_are_installed_for_others(packages: Packages) -> None:
    workspace, found = opened(packages(SHAPES)), Diagnostics()
    prefix = ensure_installed(workspace.package("shapes"), workspace=workspace, diagnostics=found)
    assert [item.message for item in found] == []
    assert prefix is not None
    headers = prefix / "include" / "shapes" / "shapes"
    assert (headers / "msg" / "side.hpp").is_file()
    assert (headers / "srv" / "turn.hpp").is_file()


def test_components_stand_in_the_index(packages: Packages) -> None:
    workspace, found = opened(packages(SHAPES | DRAWER)), Diagnostics()
    prefix = ensure_installed(workspace.package("drawer"), workspace=workspace, diagnostics=found)
    assert [item.message for item in found] == []
    assert prefix is not None
    index = prefix / "share" / "ament_index" / "resource_index" / "rclcpp_components" / "drawer"
    lines = index.read_text(encoding="utf-8").splitlines()
    assert lines == ["drawer::One;lib/libcomponent.so", "drawer::Two;lib/libcomponent.so"]


def test_a_workspace_is_installed_package_by_package(packages: Packages, tmp_path: Path) -> None:
    top = packages(SHAPES | DRAWER)
    prefixes: list[Path] = []
    for package in in_order(find_packages([top], Diagnostics())):
        prefix = tmp_path / "install" / package.name
        build = tmp_path / "build" / package.name
        request = CompileRequest(package, build, None, prefix, prefixes=tuple(prefixes))
        done = build_package(request)
        assert done.code == 0, (done.output, done.errors)
        assert (build / "compile_commands.json").is_file()
        prefixes.append(prefix)
    assert is_node_file(tmp_path / "install" / "drawer" / "lib" / "drawer" / "draw")
    assert (tmp_path / "install" / "shapes" / "lib" / "libarea.so").is_file()


def test_what_compiles_of_a_package_is_installed(packages: Packages) -> None:
    broken = {**DRAWER, "drawer/src/draw.cpp": "int main() { return nowhere; }\n"}
    workspace, found = opened(packages(SHAPES | broken)), Diagnostics()
    prefix = ensure_installed(workspace.package("drawer"), workspace=workspace, diagnostics=found)
    assert {item.code for item in found} == {"cpp.compile-error"}
    assert prefix is not None
    assert (prefix / "lib" / "libcomponent.so").is_file()
    assert not (prefix / "lib" / "drawer" / "draw").exists()
    assert (prefix / "share" / "ament_index" / "resource_index" / "rclcpp_components").is_dir()


AUTO = {
    "auto/package.xml": manifest("auto", "ament_cmake_auto", "rclcpp", "geometry_msgs"),
    "auto/CMakeLists.txt": """
        cmake_minimum_required(VERSION 3.14)
        project(auto)
        find_package(ament_cmake_auto REQUIRED)
        ament_auto_find_build_dependencies()
        ament_auto_add_library(part SHARED DIRECTORY src)
        ament_auto_add_executable(whole main.cpp)
        ament_auto_package(INSTALL_TO_SHARE config)
    """,
    "auto/include/auto/part.hpp": "#pragma once\nint part();\n",
    "auto/src/part.cpp": "#include <auto/part.hpp>\nint part() { return 1; }\n",
    "auto/main.cpp": "#include <auto/part.hpp>\nint main() { return part(); }\n",
    "auto/config/a.yaml": "a: 1\n",
}


def test_ament_auto_finds_links_and_installs(packages: Packages) -> None:
    workspace, found = opened(packages(AUTO)), Diagnostics()
    prefix = ensure_installed(workspace.package("auto"), workspace=workspace, diagnostics=found)
    assert [item.message for item in found] == []
    assert prefix is not None
    assert is_node_file(prefix / "lib" / "auto" / "whole")
    assert (prefix / "share" / "auto" / "config" / "a.yaml").is_file()


def test_a_package_that_was_not_found_is_named(packages: Packages) -> None:
    text = "cmake_minimum_required(VERSION 3.8)\nproject(one)\nfind_package(ament_cmake REQUIRED)\n"
    text += "add_executable(node node.cpp)\nament_target_dependencies(node nonsense)\n"
    files = {"one/package.xml": manifest("one", "ament_cmake"), "one/CMakeLists.txt": text}
    workspace = opened(packages(files | {"one/node.cpp": "int main() {}\n"}))
    found = Diagnostics()
    ensure_built(workspace.package("one"), "node", workspace=workspace, diagnostics=found)
    (error,) = found.errors
    assert "'nonsense' was not" in error.message
    assert error.span is not None
    assert error.span.line == 5
