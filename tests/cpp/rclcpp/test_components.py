"""Components of C++ in a container of Python."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest
from tests.conftest import Run
from tests.patience import eventually

from gazelle.graph import Graph
from gazelle.interfaces import message_type, service_type

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="nodes of C++ run on Linux for now")

_SOURCE = """
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_components/register_node_macro.hpp>
#include <std_msgs/msg/string.hpp>

namespace parts {
class Teller : public rclcpp::Node {
 public:
  explicit Teller(const rclcpp::NodeOptions &options) : Node("teller", options) {
    const auto text = declare_parameter<std::string>("text", "nothing");
    publisher_ =
        create_publisher<std_msgs::msg::String>("told", rclcpp::QoS(1).transient_local());
    std_msgs::msg::String message;
    message.data = text;
    publisher_->publish(message);
  }

 private:
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr publisher_;
};

class Thrower : public rclcpp::Node {
 public:
  explicit Thrower(const rclcpp::NodeOptions &options) : Node("thrower", options) {
    throw std::runtime_error("not today");
  }
};
}  // namespace parts

RCLCPP_COMPONENTS_REGISTER_NODE(parts::Teller)
RCLCPP_COMPONENTS_REGISTER_NODE(parts::Thrower)
"""
_CMAKE = """
cmake_minimum_required(VERSION 3.8)
project(parts)
find_package(ament_cmake REQUIRED)
find_package(rclcpp REQUIRED)
find_package(rclcpp_components REQUIRED)
find_package(std_msgs REQUIRED)
add_library(parts SHARED parts.cpp)
ament_target_dependencies(parts rclcpp rclcpp_components std_msgs)
rclcpp_components_register_node(parts PLUGIN "parts::Teller" EXECUTABLE teller)
rclcpp_components_register_nodes(parts "parts::Thrower")
install(TARGETS parts DESTINATION lib)
ament_package()
"""
_MANIFEST = """<package format="3"><name>parts</name><version>0.1.0</version>
<description>d</description><maintainer email="a@b.cd">m</maintainer><license>MIT</license>
<buildtool_depend>ament_cmake</buildtool_depend><depend>rclcpp</depend>
<depend>rclcpp_components</depend><depend>std_msgs</depend>
<export><build_type>ament_cmake</build_type></export></package>"""
_SERVICES = "composition_interfaces/srv"


@pytest.fixture
def parts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A source package with two components."""
    folder = tmp_path / "src" / "parts"
    folder.mkdir(parents=True)
    (folder / "parts.cpp").write_text(_SOURCE)
    (folder / "CMakeLists.txt").write_text(_CMAKE)
    (folder / "package.xml").write_text(_MANIFEST)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    return folder


def test_a_container_compiles_loads_and_unloads_components(
    graph: Graph, gazelle: Run, parts: Path, shared_cpp_cache: Path
) -> None:
    del shared_cpp_cache
    running = gazelle(
        "rclcpp_components/component_container", module="gazelle.nodes", cwd=parts.parent.parent
    )
    node, got = graph.create_node("tester"), []
    string = message_type("std_msgs/msg/String")

    def call(name: str, **fields: Any) -> Any:
        kind = service_type(f"{_SERVICES}/{''.join(w.capitalize() for w in name.split('_'))}")
        client = node.create_client(f"/ComponentManager/_container/{name}", kind)
        assert client.wait_for_service(60.0)
        return client.call(kind.Request(**fields))

    def load(plugin: str) -> Any:
        value = message_type("rcl_interfaces/msg/ParameterValue")(type=4, string_value="hello")
        text = message_type("rcl_interfaces/msg/Parameter")(name="text", value=value)
        return call(
            "load_node",
            package_name="parts",
            plugin_name=f"parts::{plugin}",
            node_name="renamed",
            remap_rules=["told:=heard"],
            parameters=[text],
        )

    node.create_subscription("heard", string, lambda message: got.append(message.data))
    answer = load("Teller")
    assert (answer.success, answer.full_node_name) == (True, "/renamed"), answer.error_message
    eventually(lambda: got)
    assert got == ["hello"]
    assert list(call("list_nodes").full_node_names) == ["/renamed"]
    assert "not today" in load("Thrower").error_message
    assert "no package of the name registers it" in load("Other").error_message
    assert call("unload_node", unique_id=answer.unique_id).success
    eventually(lambda: "/renamed" not in graph.node_names())
    assert running.stop() == 0
