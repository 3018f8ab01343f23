"""A nodelet of a user's package: alone, and in a manager that others load into."""

from __future__ import annotations

import signal
from pathlib import Path

import pytest
from tests.conftest import Run
from tests.patience import eventually

from gazelle.graph import Graph
from gazelle.interfaces import message_type, service_type

MANIFEST = """\
<package format="2"><name>sums</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>MIT</license>
<buildtool_depend>catkin</buildtool_depend>
<depend>nodelet</depend><depend>roscpp</depend><depend>std_msgs</depend>
<export><nodelet plugin="${prefix}/plugins.xml"/></export></package>
"""
CMAKE = """\
cmake_minimum_required(VERSION 3.0.2)
project(sums)
find_package(catkin REQUIRED COMPONENTS nodelet roscpp std_msgs)
catkin_package()
include_directories(${catkin_INCLUDE_DIRS})
add_library(sums src/plus.cpp)
target_link_libraries(sums ${catkin_LIBRARIES})
"""
PLUGINS = """\
<library path="lib/libsums">
  <class name="sums/Plus" type="sums::Plus" base_class_type="nodelet::Nodelet"/>
</library>
"""
PLUS = """\
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.h>
#include <std_msgs/Float64.h>
namespace sums {
class Plus : public nodelet::Nodelet {
  void onInit() override {
    getPrivateNodeHandle().param("value", value_, 0.0);
    out_ = getPrivateNodeHandle().advertise<std_msgs::Float64>("out", 10);
    in_ = getPrivateNodeHandle().subscribe("in", 10, &Plus::onNumber, this);
    NODELET_INFO("plus %g", value_);
  }
  void onNumber(const std_msgs::Float64::ConstPtr& number) {
    const std_msgs::Float64Ptr sum(new std_msgs::Float64());
    sum->data = number->data + value_;
    out_.publish(sum);
  }
  double value_ = 0.0;
  ros::Publisher out_;
  ros::Subscriber in_;
};
}
PLUGINLIB_EXPORT_CLASS(sums::Plus, nodelet::Nodelet)
"""


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """A catkin workspace with a package of one nodelet."""
    package = tmp_path / "src" / "sums"
    (package / "src").mkdir(parents=True)
    (package / "package.xml").write_text(MANIFEST)
    (package / "CMakeLists.txt").write_text(CMAKE)
    (package / "plugins.xml").write_text(PLUGINS)
    (package / "src" / "plus.cpp").write_text(PLUS)
    return tmp_path


@pytest.mark.tutorial
def test_a_nodelet_is_loaded_into_a_manager_and_goes_with_who_loaded_it(
    gazelle: Run, graph: Graph, workspace: Path, shared_cpp_cache: Path
) -> None:
    del shared_cpp_cache
    number, got = message_type("std_msgs/msg/Float64"), []
    node = graph.create_node("tester")
    node.create_subscription("/plus/out", number, lambda message: got.append(message.data))
    publisher = node.create_publisher("/numbers", number)
    manager = gazelle("rosrun", "nodelet", "nodelet", "manager", "__name:=mine", cwd=workspace)
    words = ("load", "sums/Plus", "mine", "__name:=plus", "_value:=1.5", "plus/in:=/numbers")
    loading = gazelle("rosrun", "nodelet", "nodelet", *words, cwd=workspace)
    manager.wait_for_line(r"plus 1\.5")
    eventually(lambda: publisher.matched)
    publisher.publish(number(data=2.0))
    eventually(lambda: got == [3.5])
    kind = service_type("nodelet/srv/NodeletList")
    listing = node.create_client("/mine/list", kind)
    assert list(listing.call(kind.Request()).nodelets) == ["/plus"]
    assert loading.stop(signal.SIGINT) == 0
    eventually(lambda: not listing.call(kind.Request()).nodelets)
    assert manager.stop(signal.SIGINT) == 0
