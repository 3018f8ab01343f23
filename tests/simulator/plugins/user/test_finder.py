"""Where plug-ins of the user's own are looked for."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from gazelle.simulator.plugins.user.finder import (
    compiled_plugin,
    python_plugin,
    remembering_folders,
    stems,
)
from gazelle.workspace import Workspace


@pytest.mark.parametrize(
    ("filename", "wanted"),
    [
        ("libmy_plugin.so", ("my_plugin", "libmy_plugin")),
        ("my_plugin", ("my_plugin",)),
        ("/opt/lib/libMy.dylib", ("My", "libMy")),
        ("library.py", ("library",)),
    ],
)
def test_a_librarys_name_is_its_files(filename: str, wanted: tuple[str, ...]) -> None:
    assert stems(filename) == wanted


@pytest.mark.parametrize(
    "variable",
    ["GAZEBO_PLUGIN_PATH", "GZ_SIM_SYSTEM_PLUGIN_PATH", "IGN_GAZEBO_SYSTEM_PLUGIN_PATH"],
)
def test_gazebos_plug_in_paths_are_searched(tmp_path: Path, variable: str) -> None:
    (tmp_path / "mine.py").write_text("")
    environ = {variable: os.pathsep.join(["/nowhere", str(tmp_path)])}
    found = python_plugin("libmine.so", None, None, environ)
    assert found is not None
    assert found.path == tmp_path / "mine.py"
    assert python_plugin("libother.so", None, None, environ) is None


def test_the_models_folder_comes_before_packages(tmp_path: Path) -> None:
    package = tmp_path / "src" / "pkg"
    (package / "scripts").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>pkg</name></package>")
    (package / "scripts" / "mine.py").write_text("")
    workspace = Workspace.discover(environ={"ROS_PACKAGE_PATH": str(tmp_path / "src")}, cwd="/")
    found = python_plugin("libmine.so", workspace, tmp_path / "model.sdf", {})
    assert found is not None
    assert found.path == package / "scripts" / "mine.py"
    (tmp_path / "mine.py").write_text("")
    beside = python_plugin("libmine.so", workspace, tmp_path / "model.sdf", {})
    assert beside is not None
    assert beside.path == tmp_path / "mine.py"


def test_built_folders_are_not_searched(tmp_path: Path) -> None:
    package = tmp_path / "src" / "pkg"
    (package / "build").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>pkg</name></package>")
    (package / "build" / "mine.py").write_text("")
    workspace = Workspace.discover(environ={"ROS_PACKAGE_PATH": str(tmp_path / "src")}, cwd="/")
    assert python_plugin("libmine.so", workspace, None, {}) is None


def test_the_line_and_source_of_a_library_are_found(tmp_path: Path) -> None:
    package = tmp_path / "src" / "pkg"
    package.mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>pkg</name></package>")
    (package / "CMakeLists.txt").write_text(
        "add_library(\n  lamp\n  SHARED\n  lamp.cc)\nadd_library(lamp_tools tools.cc)\n"
    )
    (package / "lamp.cc").write_text("")
    workspace = Workspace.discover(environ={"ROS_PACKAGE_PATH": str(tmp_path / "src")}, cwd="/")
    found = compiled_plugin("liblamp.so", workspace)
    assert found is not None
    assert (found.line, found.source) == (1, package / "lamp.cc")
    tools = compiled_plugin("lamp_tools", workspace)
    assert tools is not None
    assert (tools.line, tools.source) == (5, None)
    assert compiled_plugin("liblam.so", workspace) is None
    (package / "CMakeLists.txt").write_text("project(lamp)\nadd_library(${PROJECT_NAME} lamp.cc)\n")
    named = compiled_plugin("liblamp.so", workspace)
    assert named is not None
    assert (named.line, named.source) == (2, package / "lamp.cc")


def test_folders_are_walked_through_once_while_they_are_remembered(tmp_path: Path) -> None:
    package = tmp_path / "bot"
    package.mkdir()
    manifest = '<package format="2"><name>bot</name><version>1.0.0</version></package>'
    (package / "package.xml").write_text(manifest, encoding="utf-8")
    workspace = Workspace.discover(environ={"HOME": str(tmp_path)}, cwd=tmp_path, extra=[tmp_path])
    with remembering_folders():
        assert python_plugin("libmine.so", workspace, None, {}) is None
        (package / "mine.py").write_text("", encoding="utf-8")
        assert python_plugin("libmine.so", workspace, None, {}) is None
    assert python_plugin("libmine.so", workspace, None, {}) is not None
