"""Where a world offers what ``gazebo_ros`` of ROS 1 does."""

from __future__ import annotations

import pytest

from gazelle.graph import Graph, Node, ServiceUnavailableError
from gazelle.graph.gazebo_names import (
    HIDDEN_SPACE,
    SHOWN_SPACE,
    offered_name,
    other_version_hint,
    world_names,
    world_space,
)
from gazelle.interfaces import service_type

EMPTY = service_type("std_srvs/srv/Empty")


@pytest.fixture
def server(graph: Graph) -> Node:
    return graph.create_node("server")


@pytest.fixture
def caller(other: Graph) -> Node:
    return other.create_node("caller")


@pytest.mark.parametrize(
    ("ros_version", "is_gz", "space"),
    [
        (1, False, SHOWN_SPACE),
        (0, False, SHOWN_SPACE),
        (2, False, HIDDEN_SPACE),
        (0, True, HIDDEN_SPACE),
        (1, True, HIDDEN_SPACE),
    ],
)
def test_ros_1_shows_its_names_and_others_hide_them(
    ros_version: int, is_gz: bool, space: str
) -> None:
    assert world_space(ros_version, is_gz=is_gz) == space


def test_only_names_of_gazebo_ros_have_a_hidden_one() -> None:
    assert world_names("/gazebo/pause_physics") == (
        "/gazebo/pause_physics",
        "/_gazebo/pause_physics",
    )
    assert world_names("/gazebo_2/pause_physics") == ("/gazebo_2/pause_physics",)


@pytest.mark.parametrize("space", [SHOWN_SPACE, HIDDEN_SPACE])
def test_the_name_that_is_there_is_found(server: Node, caller: Node, space: str) -> None:
    server.create_service(f"{space}/pause_physics", EMPTY, lambda _request: EMPTY.Response())
    assert offered_name(caller.graph, "/gazebo/pause_physics", 30.0) == f"{space}/pause_physics"


def test_a_name_that_nobody_offers_stays(caller: Node) -> None:
    assert offered_name(caller.graph, "/gazebo/pause_physics") == "/gazebo/pause_physics"


def test_who_calls_ros_1s_name_in_ros_2_is_told_ros_2s(server: Node, caller: Node) -> None:
    for name in ("/_gazebo/pause_physics", "/pause_physics"):
        server.create_service(name, EMPTY, lambda _request: EMPTY.Response())
    client = caller.create_client("/gazebo/pause_physics", EMPTY)
    assert caller.graph.wait_for_service("/pause_physics", 30.0)
    with pytest.raises(ServiceUnavailableError) as caught:
        client.call(EMPTY.Request())
    assert str(caught.value) == (
        "service [/gazebo/pause_physics] unavailable; it is ROS 1's, and this world was started "
        "by ROS 2 or gz, which have /pause_physics"
    )


@pytest.mark.parametrize(
    ("name", "offered", "hint"),
    [
        ("pause_physics", ["/gazebo/pause_physics"], ""),
        ("pause_physics", [], ""),
        (
            "delete_model",
            ["/_gazebo/delete_model"],
            ", which have /delete_entity or gz service -s /world/NAME/remove",
        ),
        (
            "get_link_state",
            ["/_gazebo/get_link_state"],
            ", which have /get_entity_state once the world's file has"
            ' <plugin name="gazebo_ros_state" filename="libgazebo_ros_state.so"/>',
        ),
        (
            "get_link_state",
            ["/_gazebo/get_link_state", "/demo/get_entity_state"],
            ", which have /demo/get_entity_state",
        ),
        (
            "get_model_properties",
            ["/_gazebo/get_model_properties"],
            ", which have /get_model_properties once the world's file has"
            ' <plugin name="gazebo_ros_properties" filename="libgazebo_ros_properties.so"/>',
        ),
        (
            "set_model_state",
            ["/_gazebo/set_model_state"],
            ", which have /set_entity_state once the world's file has"
            ' <plugin name="gazebo_ros_state" filename="libgazebo_ros_state.so"/>'
            " or gz service -s /world/NAME/set_pose",
        ),
        ("get_state_hash", ["/_gazebo/get_state_hash"], ""),
    ],
)
def test_hint_names_what_does_the_same(name: str, offered: list[str], hint: str) -> None:
    text = other_version_hint(f"/gazebo/{name}", offered)
    start = "it is ROS 1's, and this world was started by ROS 2 or gz"
    assert text == (start + hint if f"/_gazebo/{name}" in offered else "")


def test_hidden_names_are_no_suggestions(server: Node, caller: Node) -> None:
    server.create_service("/_robot/reset", EMPTY, lambda _request: EMPTY.Response())
    client = caller.create_client("/robot/reset", EMPTY)
    assert caller.graph.wait_for_service("/_robot/reset", 30.0)
    with pytest.raises(ServiceUnavailableError) as caught:
        client.call(EMPTY.Request())
    assert str(caught.value) == "service [/robot/reset] unavailable"
