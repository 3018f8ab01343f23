"""A program of ROS 1 makes objects of classes that a package declares, by pluginlib."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.cpp.compiled_ahead import compile_ahead

MANIFEST = """\
<package format="2"><name>shapes</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>MIT</license>
<buildtool_depend>catkin</buildtool_depend>
<depend>pluginlib</depend><depend>roscpp</depend>
<export><shapes plugin="${prefix}/plugins.xml"/></export></package>
"""
CMAKE = """\
cmake_minimum_required(VERSION 3.0.2)
project(shapes)
find_package(catkin REQUIRED COMPONENTS pluginlib roscpp)
catkin_package()
include_directories(${catkin_INCLUDE_DIRS})
add_library(polygons src/polygons.cpp)
target_link_libraries(polygons ${catkin_LIBRARIES})
add_executable(measure src/measure.cpp)
target_link_libraries(measure ${catkin_LIBRARIES})
"""
PLUGINS = """\
<library path="lib/libpolygons">
  <class name="square" type="shapes::Square" base_class_type="shapes::Polygon"/>
  <class name="lost" type="shapes::Lost" base_class_type="shapes::Polygon"/>
</library>
"""
BASE = """\
#pragma once
namespace shapes {
struct Polygon {
  virtual ~Polygon() {}
  virtual double area() const = 0;
};
}
"""
POLYGONS = """\
#include <pluginlib/class_list_macros.h>
#include "polygon.h"
namespace shapes {
struct Square : Polygon {
  double area() const { return 4.0; }
};
}
PLUGINLIB_EXPORT_CLASS(shapes::Square, shapes::Polygon)
"""
MEASURE = """\
#include <pluginlib/class_loader.h>
#include "polygon.h"
int main() {
  pluginlib::ClassLoader<shapes::Polygon> loader("shapes", "shapes::Polygon");
  ROS_INFO("%zu classes", loader.getDeclaredClasses().size());
  boost::shared_ptr<shapes::Polygon> square = loader.createInstance("square");
  ROS_INFO("area %.1f", square->area());
  for (const char* name : {"lost", "unheard"}) {
    try {
      loader.createInstance(name);
    } catch (const pluginlib::CreateClassException& error) {
      ROS_INFO("cannot be made: %s", error.what());
    } catch (const pluginlib::LibraryLoadException& error) {
      ROS_INFO("cannot be loaded: %s", error.what());
    }
  }
}
"""


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """A catkin workspace with a package of shapes."""
    package = tmp_path / "src" / "shapes"
    (package / "src").mkdir(parents=True)
    files = {
        "package.xml": MANIFEST,
        "CMakeLists.txt": CMAKE,
        "plugins.xml": PLUGINS,
        "src/polygon.h": BASE,
        "src/polygons.cpp": POLYGONS,
        "src/measure.cpp": MEASURE,
    }
    for name, text in files.items():
        (package / name).write_text(text)
    compile_ahead(tmp_path, "shapes", "measure", libraries=["polygons"])
    return tmp_path


@pytest.mark.tutorial
def test_a_class_is_made_by_its_name_and_others_are_told(
    gazelle: Callable[..., Any], workspace: Path
) -> None:
    measure = gazelle("rosrun", "shapes", "measure", cwd=workspace)
    measure.wait_for_line("2 classes")
    measure.wait_for_line(r"area 4\.0")
    measure.wait_for_line(r"cannot be made: .*has registered no class shapes::Lost.*shapes::Square")
    measure.wait_for_line("cannot be loaded: .* the class unheard .*does not exist")
    assert measure.wait() == 0
