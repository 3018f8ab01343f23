"""component_container loads built-in nodes under the names of components."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest

from gazelle.graph.ros2_parameter_values import value_message
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import ABSENT_NODES
from gazelle.nodes.component_container import builtin_of_component

_SERVICES = "composition_interfaces/srv"
_ROBOT = """<robot name="r"><link name="a"/><link name="7"/><joint name="j" type="fixed">
<parent link="a"/><child link="7"/></joint></robot>"""


@pytest.mark.parametrize(
    ("package", "plugin", "node"),
    [
        ("robot_state_publisher", "robot_state_publisher::RobotStatePublisher", "robot_state_"),
        ("topic_tools", "topic_tools::RelayNode", "relay"),
        ("tf2_ros", "tf2_ros::StaticTransformBroadcasterNode", "static_transform_publisher"),
        ("ros_gz_bridge", "ros_gz_bridge::RosGzBridge", "parameter_bridge"),
    ],
)
def test_names_of_components_are_those_of_nodes(package: str, plugin: str, node: str) -> None:
    found = builtin_of_component(package, plugin)
    assert found is not None and found.executable.startswith(node)


def test_component_is_loaded_listed_and_unloaded(bench: Any) -> None:
    bench.start("rclcpp_components/component_container", "--ros-args", "-r", "__node:=box")
    parameter = message_type("rcl_interfaces/msg/Parameter")
    static = bench.listen("/moved", "tf2_msgs/msg/TFMessage")
    answer = bench.call(
        "/box/_container/load_node",
        f"{_SERVICES}/LoadNode",
        package_name="robot_state_publisher",
        plugin_name="robot_state_publisher::RobotStatePublisher",
        node_name="rsp",
        node_namespace="/s",
        remap_rules=["/tf_static:=/moved"],
        parameters=[
            parameter(name="robot_description", value=value_message(_ROBOT)),
            parameter(name="frame_prefix", value=value_message("1")),
        ],
    )
    assert (answer.success, answer.unique_id, answer.full_node_name) == (True, 1, "/s/rsp")
    bench.eventually(lambda: static)
    assert static[0].transforms[0].child_frame_id == "17"
    listed = bench.call("/box/_container/list_nodes", f"{_SERVICES}/ListNodes")
    assert (list(listed.unique_ids), list(listed.full_node_names)) == ([1], ["/s/rsp"])
    kind = f"{_SERVICES}/UnloadNode"
    assert bench.call("/box/_container/unload_node", kind, unique_id=1).success
    bench.eventually(lambda: "/s/rsp" not in bench.graph.node_names())
    again = bench.call("/box/_container/unload_node", kind, unique_id=1)
    assert again.error_message == "No node found with unique_id: 1"
    assert bench.stop() == [0]


def _load(bench: Any, package: str, plugin: str, **parameters: Any) -> None:
    kind = message_type("rcl_interfaces/msg/Parameter")
    answer = bench.call(
        "/box/_container/load_node",
        f"{_SERVICES}/LoadNode",
        package_name=package,
        plugin_name=plugin,
        node_name="one",
        parameters=[
            kind(name=name.replace("__", "."), value=value_message(value))
            for name, value in parameters.items()
        ],
    )
    assert answer.success


def test_a_component_of_a_fixed_transform_is_told_it_by_parameters(bench: Any) -> None:
    bench.start("rclcpp_components/component_container", "--ros-args", "-r", "__node:=box")
    static = bench.listen("/tf_static", "tf2_msgs/msg/TFMessage")
    said = bench.listen("/rosout", "rcl_interfaces/msg/Log")
    _load(bench, "tf2_ros", "tf2_ros::StaticTransformBroadcasterNode", translation__x=1.5,
          rotation__z=1.0, rotation__w=0.0, frame_id="a", child_frame_id="b",
          frame="c")  # fmt: skip
    (one,) = bench.eventually(lambda: static)[0].transforms
    assert (one.header.frame_id, one.child_frame_id) == ("a", "b")
    moved, turned = one.transform.translation, one.transform.rotation
    assert (moved.x, moved.y, turned.z, turned.w) == (1.5, 0.0, 1.0, 0.0)
    text = "/one: parameter 'frame' is not one of static_transform_publisher; it has no effect"
    bench.eventually(lambda: any(text in line.msg for line in said))


@pytest.mark.parametrize(
    ("plugin", "parameters"),
    [
        ("RelayNode", {}),
        ("ThrottleNode", {"throttle_type": "messages", "msgs_per_sec": 1e6}),
        ("ThrottleNode", {"throttle_type": "bytes", "bytes_per_sec": 1000, "window": 1.0}),
        ("DropNode", {"X": 1, "Y": 2}),
        ("MuxNode", {"input_topics": ["/in", "/other"]}),
    ],
)
def test_components_of_topic_tools_are_told_topics_by_parameters(
    bench: Any, plugin: str, parameters: dict[str, Any]
) -> None:
    bench.start("rclcpp_components/component_container", "--ros-args", "-r", "__node:=box")
    got = bench.listen("/out", "std_msgs/msg/Int32")
    topics = {"output_topic": "/out", **({} if plugin == "MuxNode" else {"input_topic": "/in"})}
    _load(bench, "topic_tools", f"topic_tools::{plugin}", **topics, **parameters)
    out = bench.node.create_publisher("/in", message_type("std_msgs/msg/Int32"))
    bench.eventually(lambda: out.matched)
    for _ in range(2):
        out.publish(message_type("std_msgs/msg/Int32")(data=7))
    assert bench.eventually(lambda: got)[0].data == 7


def test_compiled_components_are_refused_with_what_there_is(bench: Any) -> None:
    bench.start("rclcpp_components/component_container_mt", "--ros-args", "-r", "__node:=box")
    answer = bench.call(
        "/box/_container/load_node",
        f"{_SERVICES}/LoadNode",
        package_name="topic_tools",
        plugin_name="topic_tools::Blender",
    )
    assert not answer.success
    assert "no package of the name registers it" in answer.error_message
    assert "built-in nodes of package 'topic_tools': demux, drop, mux" in answer.error_message


def test_nodes_that_components_make_read_the_containers_files(
    bench: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nav2's costmaps are nodes of their own, which no request of a launch speaks of."""
    monkeypatch.setenv(ABSENT_NODES, "")
    file = tmp_path / "params.yaml"
    file.write_text("local_costmap: {local_costmap: {ros__parameters: {resolution: 0.125}}}")
    words = ("--ros-args", "-r", "__node:=box", "--params-file", str(file))
    bench.start("rclcpp_components/component_container_isolated", *words)
    load = {"node_namespace": "/", "remap_rules": ["/tf:=tf"]}
    for package, plugin, name in (
        ("nav2_controller", "nav2_controller::ControllerServer", "controller_server"),
        ("nav2_route", "nav2_route::RouteServer", "route_server"),
    ):
        names = {"package_name": package, "plugin_name": plugin, "node_name": name}
        bench.call("/box/_container/load_node", f"{_SERVICES}/LoadNode", **names, **load)
    transition = message_type("lifecycle_msgs/msg/Transition")(label="configure")
    kind = "lifecycle_msgs/srv/ChangeState"
    assert bench.call("/controller_server/change_state", kind, transition=transition).success
    found = bench.call(
        "/local_costmap/local_costmap/get_parameters",
        "rcl_interfaces/srv/GetParameters",
        names=["resolution"],
    )
    assert found.values[0].double_value == 0.125
    topics = {one.name for one in bench.graph.entities() if "local_costmap" in one.node}
    assert "/tf" in topics and "/local_costmap/tf" not in topics
    assert os.environ[ABSENT_NODES] == "/route_server"
