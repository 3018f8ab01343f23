"""Whatever a process sends to another one, that answers and goes on."""

from __future__ import annotations

import json
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.patience import stretched

from gazelle.errors import GazelleError, GraphError
from gazelle.graph import Graph, Kind
from gazelle.graph.key_expressions import (
    Entity,
    Qos,
    control_key,
    parameter_key,
    service_key,
    token,
)
from gazelle.graph.parameter_tree import ParameterTree, from_json
from gazelle.graph.process_queries import answer_in, read_query
from gazelle.interfaces import service_type

KINDS = {"op": str, "count": int}
MARKS = ["$bytes", "$datetime", "$date", "$dict", "op", "name", "value", "start", "revision"]
JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text() | st.sampled_from(MARKS), inner),
    max_leaves=20,
)
HOSTILE = [
    b"",
    b"not json",
    b"\xff\xfe\x00",
    b"[" * 100_000,
    b'{"a":' * 50_000,
    b"7" * 5_000,
    b"null",
    b"[1, 2]",
    b'"text"',
    b'{"op": 7}',
    b'{"op": ["set"]}',
    b'{"op": "set"}',
    b'{"op": "set", "name": {"a": 1}, "value": 1}',
    b'{"op": "set", "name": "/", "value": 1}',
    b'{"op": "search", "name": "a"}',
    b'{"op": "get", "name": null}',
    b'{"op": "shutdown", "node": 3, "reason": null}',
    b'{"op": "shutdown", "since_ns": "now"}',
    b'{"$bytes": 7}',
    b'{"op": {"$date": "yesterday"}}',
    json.dumps({"op": "set", "name": "/x" * 5_000, "value": 1}).encode(),
    json.dumps({"op": "search", "name": "a", "start": "/x" * 50_000}).encode(),
]


def _payload(data: bytes) -> Any:
    return SimpleNamespace(to_bytes=lambda: data)


@pytest.mark.parametrize("data", [None, *HOSTILE[:9]])
def test_what_is_no_dictionary_is_told_in_a_sentence(data: bytes | None) -> None:
    query = SimpleNamespace(payload=None if data is None else _payload(data))
    with pytest.raises(GraphError, match=r"^(this cannot be read: |a request is a dictionary)"):
        read_query(query, KINDS)
    assert answer_in(SimpleNamespace(ok=SimpleNamespace(payload=query.payload))) is None


@pytest.mark.parametrize(
    ("data", "text"),
    [
        (b'{"op": 7}', "'op' of a request cannot be 7"),
        (b'{"count": true}', "'count' of a request cannot be True"),
        (b'{"op": "' + b"x" * 5_000 + b'"}', "'op' of a request is 5000 characters long"),
    ],
)
def test_entries_of_the_wrong_kind_are_named(data: bytes, text: str) -> None:
    with pytest.raises(GraphError, match=text):
        read_query(SimpleNamespace(payload=_payload(data)), KINDS)


@given(st.binary() | JSON.map(lambda value: json.dumps(value).encode()))
def test_any_bytes_are_a_value_or_an_error(data: bytes) -> None:
    try:
        from_json(data)
    except GraphError as error:
        assert str(error).startswith("this cannot be read: ")


@given(st.text() | st.text("/²0٣a%,:*\x1b\n"), st.integers(0, 12))
def test_any_text_is_a_token_or_none(text: str, place: int) -> None:
    whole = "@ros2_lv/0/z/1/2/MP/%/%/node/%topic/std_msgs::msg::dds_::String_/hash/::,:,:,:,,"
    parts = whole.split("/")
    parts[place] = text
    for key in (text, "/".join(parts)):
        entity = Entity.from_token(key)
        assert entity is None or Entity.from_token(token(0, entity)) is not None
    Qos.from_key(text)


@pytest.mark.parametrize("number", ["²", "٣", "9" * 5_000, "-1", "1_0", " 1", ""])
def test_numbers_of_tokens_are_plain_ones(number: str) -> None:
    assert Entity.from_token(f"@ros2_lv/0/z/{number}/0/NN/%/%/n") is None
    assert Entity.from_token(f"@ros2_lv/0/z/0/{number}/NN/%/%/n") is None
    assert Qos.from_key(f"::,{number}:{number},{number}:,:,,") == Qos()


def test_names_that_steer_a_terminal_are_no_tokens() -> None:
    assert Entity.from_token("@ros2_lv/0/z/0/0/NN/%/%/n\x1b[2J") is None


def test_trees_have_a_depth() -> None:
    tree = ParameterTree()
    with pytest.raises(GraphError, match="is more than 100 levels deep"):
        tree.set("/x" * 101, 1)
    value: Any = 1
    for _level in range(101):
        value = [value]
    with pytest.raises(GraphError, match="is more than 100 levels deep"):
        tree.set("/deep", value)
    assert tree.names() == []


@pytest.mark.parametrize("key", ["store", "control"])
def test_a_process_answers_after_anything(graph: Graph, other: Graph, key: str) -> None:
    node = graph.create_node("stays")
    graph.parameters.set("/before", 1)
    where = parameter_key("store") if key == "store" else control_key(graph.domain, graph.zid)
    for data in HOSTILE:
        replies = list(other.session.get(where, payload=data, timeout=20.0))
        assert len(replies) == 1, data
        assert answer_in(replies[0]) is not None, data
    assert list(other.session.get(where, timeout=20.0))
    other.parameters.set("/after", 2)
    assert graph.parameters.get("/before") == 1
    assert other.parameters.get("/after") == 2
    assert not node.closed
    assert other.kill_node("/stays")


def test_a_service_answers_after_anything(
    graph: Graph, other: Graph, capsys: pytest.CaptureFixture[str]
) -> None:
    kind = service_type("std_srvs/srv/SetBool")
    graph.create_node("server").create_service(
        "/set", kind, lambda request: kind.Response(success=request.data)
    )
    client = other.create_node("caller").create_client("/set", kind)
    assert client.wait_for_service(stretched())
    (entity,) = (one for one in other.entities() if one.kind is Kind.SERVICE and one.name == "/set")
    key = service_key(graph.domain, "/set", entity.type_name, entity.type_hash)
    for data in HOSTILE:
        for attachment in (None, b"", data):
            replies = list(other.session.get(key, payload=data, attachment=attachment, timeout=20))
            assert len(replies) == 1, data
    assert client.call(kind.Request(data=True)).success
    assert "Traceback" not in capsys.readouterr().err


@pytest.mark.parametrize("is_error", [False, True])
def test_a_client_survives_any_answer(graph: Graph, other: Graph, is_error: bool) -> None:
    """The server is announced as one, and what it sends is none."""
    kind = service_type("std_srvs/srv/SetBool")
    client = other.create_node("caller").create_client("/set", kind)
    entity = graph.create_node("server").create_service("/mute", kind, lambda _: None).entity
    entity = replace(entity, name="/set", entity_id=entity.entity_id + 1)
    key = service_key(graph.domain, "/set", entity.type_name, entity.type_hash)
    answers = iter(HOSTILE)

    def answer(query: Any) -> None:
        with query:
            (query.reply_err(next(answers)) if is_error else query.reply(key, next(answers)))

    queryable = graph.session.declare_queryable(key, answer, complete=True)
    announced = graph.session.liveliness().declare_token(token(graph.domain, entity))
    assert client.wait_for_service(stretched())
    for data in HOSTILE:
        try:
            found = client.call(kind.Request(), stretched())
        except GazelleError as error:
            assert str(error), data
        else:
            assert isinstance(found, kind.Response), data
    announced.undeclare()
    queryable.undeclare()


def test_a_copy_follows_after_anything(
    graph: Graph, other: Graph, capsys: pytest.CaptureFixture[str], inbox: Any
) -> None:
    other.parameters.on_change(inbox)
    for data in HOSTILE:
        graph.session.put(parameter_key("update"), data)
    graph.parameters.set("/after", 2)
    inbox.wait_for(1)
    assert other.parameters.get_cached("/after") == 2
    assert capsys.readouterr().err.count("something that came is left out") == 1


def test_strangers_tokens_are_listed_by_nobody(graph: Graph, other: Graph) -> None:
    tokens = [
        other.session.liveliness().declare_token(f"@ros2_lv/{other.domain}/z/{number}/0/NN/%/%/n")
        for number in ("²", "9" * 5_000)
    ]
    other.create_node("real")
    assert graph.discovery.wait_for(lambda known: any(one.node == "/real" for one in known), 30.0)
    assert graph.node_names() == ("/real",)
    for one in tokens:
        one.undeclare()
