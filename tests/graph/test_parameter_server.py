from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from gazelle.errors import GraphError
from gazelle.graph import Graph, parameter_server
from gazelle.graph.parameter_server import ParameterShare


def test_every_member_sees_the_same_parameters(
    graph: Graph, other: Graph, join: Callable[..., Graph]
) -> None:
    client = join(role="client")
    value = {"i": 1, "f": 1.0, "b": b"\0", "l": [True, "x"]}
    other.parameters.set("/robot", value)
    for member in (graph, other, client):
        assert member.parameters.get("/robot") == value
        assert type(member.parameters.get("/robot/f")) is float
        assert member.parameters.names() == ["/robot/i", "/robot/f", "/robot/b", "/robot/l"]
    client.parameters.delete("/robot/i")
    assert not graph.parameters.has("/robot/i")


def test_node_names_apply(other: Graph) -> None:
    node = other.create_node("arm", namespace="/left", remappings={"speed": "/speed"})
    node.parameters.set("~gain", 2)
    node.parameters.set("limit", 3)
    node.parameters.set("speed", 4)
    assert other.parameters.get("/") == {"left": {"arm": {"gain": 2}, "limit": 3}, "speed": 4}
    assert node.parameters.search("limit") == "/left/limit"
    assert node.parameters.search("gain") == "/left/arm/gain"
    assert node.parameters.search("none") is None


def test_names_that_are_numbers_become_texts_everywhere(graph: Graph, other: Graph) -> None:
    for place, setter in enumerate((graph, other)):
        setter.parameters.set(f"/set{place}", {1: {2.5: [{True: 3}]}})
        for member in (graph, other):
            assert member.parameters.get(f"/set{place}") == {"1": {"2.5": [{"True": 3}]}}


def test_missing_parameters(other: Graph) -> None:
    with pytest.raises(KeyError, match="/nothing"):
        other.parameters.get("nothing")
    with pytest.raises(KeyError, match="/nothing"):
        other.parameters.delete("nothing")
    assert other.parameters.get("nothing", 5) == 5
    assert other.parameters.get_cached("nothing", None) is None


def test_bad_values_are_refused_where_they_are_set(other: Graph) -> None:
    with pytest.raises(GraphError, match="cannot set root of parameter tree"):
        other.parameters.set("/", 5)


def test_cached_reads_follow_changes(
    graph: Graph, other: Graph, eventually: Callable[..., Any]
) -> None:
    changed: list[str] = []
    graph.parameters.on_change(changed.append)
    other.parameters.set("/a", 1)
    assert other.parameters.get_cached("/a") == 1
    assert graph.parameters.get_cached("/a") == 1
    graph.parameters.set("/a", 2)
    eventually(lambda: other.parameters.get_cached("/a") == 2)
    graph.parameters.delete("/a")
    eventually(lambda: other.parameters.get_cached("/a", None) is None)
    assert changed == ["/a", "/a", "/a"]


def test_an_owner_that_is_slow_is_waited_for_while_there_is_a_hub(
    join: Callable[..., Graph], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(parameter_server, "_NO_OWNER_S", 0.0)
    asked: list[Any] = []
    answer = ParameterShare._answer

    def answer_late(share: ParameterShare, query: Any) -> None:
        asked.append(query)
        if len(asked) > 3:
            answer(share, query)
        else:
            query.drop()

    monkeypatch.setattr(ParameterShare, "_answer", answer_late)
    join(role="hub").parameters.set("/speed", 2)
    assert join(role="client").parameters.get("/speed") == 2
    assert len(asked) == 4


def test_nearest_names_help(graph: Graph) -> None:
    graph.parameters.set("/robot_description", "<robot/>")
    assert graph.parameters.nearest("/robot_descripton") == ("/robot_description",)


def test_parameters_move_with_the_hub(
    graph: Graph, other: Graph, eventually: Callable[..., Any]
) -> None:
    graph.parameters.set("/kept", [1, 2.0])
    eventually(lambda: other.parameters.get_cached("/kept", None) is not None)
    graph.close()
    assert other.parameters.get("/kept") == [1, 2.0]
    eventually(lambda: other.is_hub)


def test_who_left_the_graph_waits_for_nobody(graph: Graph, join: Callable[..., Graph]) -> None:
    client = join(role="client")
    assert graph.parameters.settle(60.0)
    assert client.parameters.settle(60.0)
    client.close()
    assert not client.parameters.settle(60.0)


def test_a_parameter_that_is_asked_for_after_the_end_says_so(graph: Graph, other: Graph) -> None:
    graph.parameters.set("/p", 1)
    other.close()
    with pytest.raises(GraphError, match="the graph is closed"):
        other.parameters.get("/p")
