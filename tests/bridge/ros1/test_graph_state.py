"""What each side is told of the other."""

from __future__ import annotations

import pytest

from gazelle.bridge.ros1.graph_state import TypeBook, node_entities_of, ros_node_entities_of
from gazelle.bridge.ros1.master_registry import Registry
from gazelle.bridge.ros1.types import message_kind, service_kind
from gazelle.graph import ANY_TYPE, Entity, Kind, Qos

NONE: frozenset[str] = frozenset()
STRING = "std_msgs/msg/String"


@pytest.fixture
def told() -> list[str]:
    return []


@pytest.fixture
def book(told: list[str]) -> TypeBook:
    return TypeBook(told.append, told.append)


def entity(kind: Kind, node: str, name: str = "", type_name: str = STRING, **qos: bool) -> Entity:
    return Entity("z", 0, 0, kind, node, name, type_name, qos=Qos(**qos))


def test_nodes_wish_for_what_they_have_announced(book: TypeBook) -> None:
    found = node_entities_of(
        [
            entity(Kind.NODE, "/a"),
            entity(Kind.PUBLISHER, "/a", "/out", latched=True),
            entity(Kind.SUBSCRIPTION, "/b", "/in"),
            entity(Kind.SUBSCRIPTION, "/b", "/any", ANY_TYPE),
            entity(Kind.SERVICE, "/b", "/switch", "std_srvs/srv/SetBool"),
            entity(Kind.CLIENT, "/c", "/switch", "std_srvs/srv/SetBool"),
        ],
        NONE,
        NONE,
        book,
    )
    assert set(found) == {"/a", "/b"}
    assert found["/a"].publishers == {"/out": ("/a", message_kind(STRING), True)}
    assert found["/b"].subscribers == {"/in": "std_msgs/String", "/any": "*"}
    assert found["/b"].services == {"/switch": service_kind("std_srvs/SetBool")}


def test_hidden_and_taken_names_have_another_name_in_ros1(book: TypeBook) -> None:
    entities = [
        entity(Kind.SUBSCRIPTION, "/_ros2cli_7", "/in"),
        entity(Kind.PUBLISHER, "/rosout", "/agg"),
    ]
    found = node_entities_of(entities, frozenset({"/rosout"}), NONE, book)
    assert {name: one.node for name, one in found.items()} == {
        "/ros1_bridge": "/_ros2cli_7",
        "/rosout_gazelle": "/rosout",
    }


def test_what_ros1_has_no_use_for_stays(book: TypeBook, told: list[str]) -> None:
    entities = [
        entity(Kind.PUBLISHER, "/a", "/parameter_events", "rcl_interfaces/msg/ParameterEvent"),
        entity(Kind.PUBLISHER, "/a", "/fib/_action/status", "action_msgs/msg/GoalStatusArray"),
        entity(Kind.PUBLISHER, "/a", "/skipped"),
        entity(Kind.SERVICE, "/a", "/a/get_parameters", "rcl_interfaces/srv/GetParameters"),
        entity(Kind.PUBLISHER, "/a", "/odd", "odd_msgs/msg/Odd"),
        entity(Kind.PUBLISHER, "/b", "/odd", "odd_msgs/msg/Odd"),
    ]
    found = node_entities_of(entities, NONE, frozenset({"/skipped"}), book)
    assert not any(one.publishers or one.services for one in found.values())
    assert told == [
        "topic /odd of /a does not cross the bridge: nothing here defines its type odd_msgs/Odd\n"
        "  fix: start the bridge where the package that defines it is found"
    ]


def test_nodes_of_ros1_show_without_those_that_are_ours(book: TypeBook) -> None:
    registry = Registry()
    registry.add_publisher("/a", "/out", "std_msgs/String", "http://a:1/")
    registry.add_subscriber("/a", "/in", "*", "http://a:1/")
    registry.add_publisher("/ours", "/out", "std_msgs/String", "http://us:1/")
    registry.add_service("/a", "/known", "rosrpc://a:1", "http://a:1/")
    registry.add_service("/a", "/unknown", "rosrpc://a:1", "http://a:1/")
    kind = service_kind("std_srvs/Empty")
    found = ros_node_entities_of(
        registry.state(), frozenset({"/ours"}), NONE, {"/known": kind}, book
    )
    assert set(found) == {"/a"}
    assert found["/a"].publishers == {"/out": message_kind("std_msgs/String")}
    assert found["/a"].subscribers == {"/in": ANY_TYPE}
    assert found["/a"].services == {"/known": kind}


def test_registry_forgets_a_node_whose_name_is_taken() -> None:
    registry = Registry()
    registry.add_publisher("/a", "/out", "std_msgs/String", "http://old:1/")
    registry.add_service("/a", "/s", "rosrpc://old:1", "http://old:1/")
    replaced = registry.add_subscriber("/a", "/in", "*", "http://new:1/")
    assert replaced == ("/a", "http://old:1/")
    state = registry.state()
    assert (state.publishers, state.services) == (frozenset(), frozenset())
    assert registry.node_uri("/a") == "http://new:1/"
    assert not registry.remove_subscriber("/a", "/in", "http://old:1/")
    assert registry.remove_subscriber("/a", "/in", "http://new:1/")
    assert registry.node_uri("/a") is None
