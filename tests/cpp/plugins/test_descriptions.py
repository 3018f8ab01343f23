"""What packages declare for pluginlib, in the ways of both ROSes, and what is wrong with it."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.cpp.plugins import (
    PluginDescriptionError,
    declared_plugins,
    library_name,
    read_description,
)
from gazelle.workspace import Package, Workspace

MANIFEST = """\
<package format="2"><name>{name}</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>MIT</license>
<buildtool_depend>{tool}</buildtool_depend><export>{export}</export></package>
"""
PLUGINS = """\
<?xml version="1.0"?>
<class_libraries>
  <library path="lib/libpolygons">
    <class name="shapes/Triangle" type="shapes::Triangle" base_class_type="shapes::Polygon">
      <description>Has
        three sides.</description>
    </class>
    <class type="shapes::Square" base_class="shapes::Polygon"/>
  </library>
  <library path="others"><class type="shapes::Ball" base_class_type="shapes::Solid"/></library>
</class_libraries>
"""


def package(folder: Path, *, tool: str = "catkin", export: str = "", cmake: str = "") -> Path:
    """Write a package with a plug-in description."""
    folder.mkdir(parents=True)
    manifest = MANIFEST.format(name=folder.name, tool=tool, export=export)
    (folder / "package.xml").write_text(manifest)
    (folder / "plugins.xml").write_text(PLUGINS)
    (folder / "CMakeLists.txt").write_text(cmake)
    return folder


def workspace(folder: Path) -> Workspace:
    """Return the packages below a folder."""
    return Workspace.discover(extra=[folder], environ={}, cwd=folder)


def test_exports_of_ros1_name_descriptions(tmp_path: Path) -> None:
    package(tmp_path / "mine", export='<shapes plugin="${prefix}/plugins.xml"/>')
    found = declared_plugins(workspace(tmp_path), "shapes", "shapes::Polygon")
    assert [(one.name, one.type, one.library) for one in found.classes] == [
        ("shapes/Triangle", "shapes::Triangle", "lib/libpolygons"),
        ("shapes::Square", "shapes::Square", "lib/libpolygons"),
    ]
    assert found.classes[0].description == "Has three sides."
    assert found.classes[1].span.line == 8
    assert not found.problems


def test_cmake_of_ros2_names_descriptions(tmp_path: Path) -> None:
    cmake = "project(mine)\npluginlib_export_plugin_description_file(shapes plugins.xml)\n"
    package(tmp_path / "mine", tool="ament_cmake", cmake=cmake)
    found = declared_plugins(workspace(tmp_path), "shapes")
    assert [one.type for one in found.classes] == [
        "shapes::Triangle", "shapes::Square", "shapes::Ball"
    ]  # fmt: skip


def test_what_is_exported_for_others_is_theirs(tmp_path: Path) -> None:
    package(tmp_path / "mine", export='<nodelet plugin="${prefix}/plugins.xml"/>')
    assert declared_plugins(workspace(tmp_path), "shapes") == ((), (), ())


def test_several_libraries_may_stand_beside_each_other(tmp_path: Path) -> None:
    folder = package(tmp_path / "mine")
    text = "".join(
        f'<library path="{name}"><class type="{name}" base_class_type="B"/></library>\n'
        for name in ("one", "two")
    )
    (folder / "plugins.xml").write_text(text)
    found = read_description(folder / "plugins.xml", Package("mine", folder))
    assert [one.library for one in found] == ["one", "two"]


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("<library path='x'><class type='A'/></library>", "no attribute base_class_type"),
        ("<library path='x'><class base_class_type='A'/></library>", "no attribute type"),
        ("<library><class type='A' base_class_type='B'/></library>", "no attribute path"),
        ("<class type='A' base_class_type='B'/>", "stands outside"),
        ("<nothing/>", "no <library"),
        ("<library path='x'>", "is no XML"),
        ("<!DOCTYPE a [<!ENTITY e 'e'>]><library path='x'/>", "no XML|entities are refused"),
    ],
)
def test_what_is_wrong_is_said_with_its_file(tmp_path: Path, text: str, reason: str) -> None:
    path = tmp_path / "plugins.xml"
    path.write_text(text)
    with pytest.raises(PluginDescriptionError, match=reason) as caught:
        read_description(path, Package("mine", tmp_path))
    assert str(path) in str(caught.value)


def test_a_description_that_is_not_there_is_told_and_the_others_are_read(tmp_path: Path) -> None:
    package(tmp_path / "lacking", export='<shapes plugin="${prefix}/none.xml"/>')
    package(tmp_path / "mine", export='<shapes plugin="${prefix}/plugins.xml"/>')
    found = declared_plugins(workspace(tmp_path), "shapes")
    assert len(found.classes) == 3
    assert [problem for problem in found.problems if "none.xml" in problem]


@pytest.mark.parametrize("written", ["lib/libfoo", "libfoo", "foo", "libfoo.so", "a/b/libfoo.so"])
def test_a_library_is_known_by_its_targets_name(written: str) -> None:
    assert library_name(written) == "foo"
