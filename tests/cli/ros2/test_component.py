"""ros2 component."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from gazelle.cli.ros2.component import instead_of
from gazelle.graph import Graph, Node
from gazelle.interfaces import service_type


@pytest.fixture
def container(graph: Graph) -> list[Any]:
    """A container that loads everything but ``bad::Node``; returns the requests."""
    requests: list[Any] = []
    kinds = {name: service_type(f"composition_interfaces/{name}") for name in _HANDLERS}
    node = graph.create_node("container", rosout=False)

    def load(request: Any) -> Any:
        requests.append(request)
        if request.plugin_name == "bad::Node":
            return kinds["LoadNode"].Response(success=False, error_message="failed to find class")
        return kinds["LoadNode"].Response(success=True, full_node_name="/talker", unique_id=1)

    def unload(request: Any) -> Any:
        is_there = request.unique_id == 1
        why = "" if is_there else "no node found with unique_id: 7"
        return kinds["UnloadNode"].Response(success=is_there, error_message=why)

    def listing(_: Any) -> Any:
        return kinds["ListNodes"].Response(full_node_names=["/talker"], unique_ids=[1])

    for name, handler in zip(_HANDLERS, (load, unload, listing), strict=True):
        node.create_service(f"/container/_container/{_HANDLERS[name]}", kinds[name], handler)
    return requests


_HANDLERS = {"LoadNode": "load_node", "UnloadNode": "unload_node", "ListNodes": "list_nodes"}


def test_list(container: list[Any], robot: Node, run: Any) -> None:
    assert run("ros2", "component", "list") == (0, "/container\n  1  /talker\n", "")
    assert run("ros2", "component", "list", "/container").out == "1  /talker\n"
    assert run("ros2", "component", "list", "--containers-only").out == "/container\n"
    code, _, error = run("ros2", "component", "list", "/contaner")
    assert code == 1
    assert error == ("Unable to find container node '/contaner'\n  did you mean '/container'?\n")


def test_load_and_unload(container: list[Any], run: Any) -> None:
    words = ("composition", "composition::Talker", "-p", "rate:=5", "-r", "a:=b", "-n", "x")
    assert run("ros2", "component", "load", "/container", *words) == (
        0,
        "Loaded component 1 into '/container' container node as '/talker'\n",
        "",
    )
    (request,) = container
    assert (request.node_name, list(request.remap_rules)) == ("x", ["a:=b"])
    assert (request.parameters[0].name, request.parameters[0].value.integer_value) == ("rate", 5)
    assert run("ros2", "component", "load", "-q", "/container", *words).out == "1  /talker\n"
    code, _, error = run("ros2", "component", "load", "/container", "a", "bad::Node")
    assert (code, error) == (1, "Failed to load component: Failed to find class\n")
    assert run("ros2", "component", "unload", "/container", "1").out == (
        "Unloaded component 1 from '/container' container node\n"
    )
    code, _, error = run("ros2", "component", "unload", "/container", "7")
    assert code == 1
    assert error == (
        "Failed to unload component 7 from '/container' container node\n"
        "    No node found with unique_id: 7\n"
    )


def test_compiled_components_are_answered_with_the_built_in_node(robot: Node, run: Any) -> None:
    plugin = "robot_state_publisher::RobotStatePublisher"
    code, _, error = run(
        "ros2", "component", "standalone", "robot_state_publisher", plugin, "-p", "a:=1"
    )
    assert code == 1
    assert (
        "does the same: ros2 run robot_state_publisher robot_state_publisher --ros-args -p a:=1\n"
        in error
    )
    assert error.endswith(f"load /standalone_container robot_state_publisher {plugin}\n")
    code, _, error = run("ros2", "component", "load", "/c", "topic_tools", "topic_tools::RelayNode")
    assert code == 1
    assert error.startswith("Unable to find container node '/c'\n  there is none; start one")
    assert error.endswith("ros2 run topic_tools relay\n")


@pytest.mark.parametrize(
    ("package", "plugin", "words"),
    [
        (
            "tf2_ros",
            "tf2_ros::StaticTransformBroadcasterNode",
            "tf2_ros static_transform_publisher",
        ),
        ("topic_tools", "topic_tools::ThrottleNode", "ros2 run topic_tools throttle"),
        ("topic_tools", "topic_tools::Other", "built-in nodes of the package: demux"),
    ],
)
def test_instead_of_a_component(package: str, plugin: str, words: str) -> None:
    assert words in instead_of(package, plugin)


def test_types_are_those_of_installed_packages(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, run: Any
) -> None:
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    assert run("ros2", "component", "types")[:2] == (0, "")
    folder = tmp_path / "share/ament_index/resource_index/rclcpp_components"
    folder.mkdir(parents=True)
    (folder / "composition").write_text(
        "composition::Talker;lib/a.so\ncomposition::Listener;lib/b.so\n", encoding="utf-8"
    )
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    assert run("ros2", "component", "types") == (
        0,
        "composition\n  composition::Talker\n  composition::Listener\n",
        "",
    )
    assert run("ros2", "component", "types", "composition").out == (
        "composition::Talker\ncomposition::Listener\n"
    )
    code, _, error = run("ros2", "component", "types", "compositon")
    assert code == 1
    assert error.startswith("Unable to find package 'compositon'\n  did you mean 'composition'")
