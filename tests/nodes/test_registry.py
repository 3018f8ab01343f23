"""Names of built-in nodes."""

from __future__ import annotations

import pytest

from gazelle.nodes.registry import builtin_node, builtin_nodes, builtin_types


@pytest.mark.parametrize("node", builtin_nodes(), ids=lambda node: f"{node.package}/{node.type}")
def test_every_node_has_a_function_and_help(node) -> None:
    assert callable(node.load())
    assert node.help


@pytest.mark.parametrize(
    ("package", "type_name", "target"),
    [
        ("robot_state_publisher", "state_publisher", "robot_state_publisher"),
        ("gazebo", "spawn_model", "spawn_model"),
        ("gazebo_ros", "gazebo", "gzserver"),
        ("rqt_rviz", "rqt_rviz", "rviz"),
        ("gazebo", "gzclient", "gzclient"),
        ("dynamic_reconfigure", "reconfigure_gui", "rqt_reconfigure"),
    ],
)
def test_old_names_are_aliases(package: str, type_name: str, target: str) -> None:
    node = builtin_node(package, type_name)
    assert node is not None
    assert node.type == target


def test_unknown_names_are_no_nodes() -> None:
    assert builtin_node("gazebo_ros", "spawn_modle") is None
    assert "spawn_model" in builtin_types("gazebo_ros")


def test_no_name_stands_for_two_nodes() -> None:
    names = [
        name for node in builtin_nodes() for name in ((node.package, node.type), *node.aliases)
    ]
    assert sorted(names) == sorted(set(names))
