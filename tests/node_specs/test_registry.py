"""Names of built-in nodes."""

from __future__ import annotations

import pytest

from gazelle.cli import commands
from gazelle.interfaces import action_type, message_type, service_type
from gazelle.node_specs.registry import (
    COMMANDS,
    builtin_executables,
    command_of,
    names_of_other_ros,
    node_spec,
    node_specs,
)
from gazelle.node_specs.spec import resolved


@pytest.mark.parametrize("node", node_specs(), ids=lambda node: f"{node.package}/{node.executable}")
def test_every_node_has_a_function_and_help(node) -> None:
    assert callable(node.load())
    assert node.does


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
    node = node_spec(package, type_name)
    assert node is not None
    assert node.executable == target


def test_unknown_names_are_no_nodes() -> None:
    assert node_spec("gazebo_ros", "spawn_modle") is None
    assert "spawn_model" in builtin_executables("gazebo_ros")


def test_no_name_stands_for_two_nodes() -> None:
    names = [name[:2] for node in node_specs() for name in node.names]
    assert sorted(names) == sorted(set(names))


def test_the_table_of_parameters_that_a_row_names_is_of_that_node() -> None:
    named = [node for node in node_specs() if node.parameters]
    assert len(named) >= 13
    for node in named:
        assert f"{node.package}/{node.executable}" in resolved(str(node.parameters)).types


def test_types_that_rows_name_are_known() -> None:
    for node in node_specs():
        for kind, rows in (
            (message_type, node.topics),
            (service_type, node.services),
            (action_type, node.actions),
        ):
            assert all(kind(row.type) for row in rows)


def test_names_that_only_the_other_ros_has_are_told_by_package_and_executable() -> None:
    only_1, only_2 = names_of_other_ros(2), names_of_other_ros(1)
    assert ("rviz", "") in only_1 and ("rviz2", "") in only_2
    assert ("teleop_twist_keyboard", "teleop_twist_keyboard.py") in only_1
    assert ("teleop_twist_keyboard", "teleop_twist_keyboard") in only_2
    assert not {("teleop_twist_keyboard", ""), ("turtlesim", "mimic")} & (only_1 | only_2)


def test_a_command_that_is_named_as_a_node_is_an_executable_of_its_package() -> None:
    assert command_of("tf2_ros", "tf2_echo") == ("tf_echo", "--tf2")
    assert command_of("tf2_ros", "tf_echo") == ()
    assert {"tf2_echo", "static_transform_publisher"} <= set(builtin_executables("tf2_ros"))
    assert all(words.split()[0] in commands.COMMANDS for words in COMMANDS.values())
    assert not {name[:2] for name in COMMANDS} & {
        name[:2] for spec in node_specs() for name in spec.names
    }
