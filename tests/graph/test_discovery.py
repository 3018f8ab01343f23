"""What is known of the graph, while it still comes."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from types import SimpleNamespace
from typing import Any

import pytest
import zenoh

from gazelle.errors import GraphError
from gazelle.graph import Entity, Graph, Kind
from gazelle.graph.discovery import Discovery
from gazelle.graph.key_expressions import token
from gazelle.interfaces import message_type, service_type

Empty = service_type("std_srvs/srv/Empty")
String = message_type("std_msgs/msg/String")
_SHORT_S = 0.05
_LEFT_OPEN = SimpleNamespace(ok=None, err="Timeout")
_TALKER = Entity("1f", 0, 3, Kind.PUBLISHER, "/n", "/wanted", "std_msgs/msg/String")


class Replies:
    """Stands for a session that gives these answers one after the other, then the last again."""

    def __init__(self, *answers: list[Any]) -> None:
        self.answers = list(answers)

    def liveliness(self) -> Replies:
        return self

    def get(self, _selector: str, _channel: Any, timeout: float) -> list[Any]:
        assert timeout > 0
        return self.answers.pop(0) if len(self.answers) > 1 else self.answers[0]

    def close(self) -> None:
        pass


def _discovery_of(session: Any) -> Discovery:
    return Discovery(session, 0, port=1, zid="2f")


def _reply(entity: Entity) -> SimpleNamespace:
    return SimpleNamespace(ok=SimpleNamespace(key_expr=token(0, entity)))


def test_a_question_that_is_left_open_is_asked_again() -> None:
    discovery = _discovery_of(Replies([_LEFT_OPEN], [_LEFT_OPEN], [_reply(_TALKER)]))
    assert discovery.ask() == (_TALKER,)


def test_a_hub_that_never_answers_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gazelle.graph.discovery._MAX_DURATION_S", 0.0)
    with pytest.raises(GraphError, match="the graph on port 1 does not answer: who listens at"):
        _discovery_of(Replies([_LEFT_OPEN])).ask()


def test_what_is_known_of_others_is_taken_for_all_once_it_is_quiet() -> None:
    discovery = _discovery_of(Replies([_LEFT_OPEN]))
    _told(discovery, _TALKER, zenoh.SampleKind.PUT)
    assert discovery.ask() == (_TALKER,)


def test_a_hub_that_answered_once_leaves_what_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gazelle.graph.discovery._MAX_DURATION_S", 0.0)
    discovery = _discovery_of(Replies([], [_LEFT_OPEN]))
    assert discovery.ask() == ()
    _told(discovery, _TALKER, zenoh.SampleKind.PUT)
    assert discovery.ask() == (_TALKER,)


def test_what_the_hub_has_yet_to_tell_is_not_missing() -> None:
    discovery = _discovery_of(Replies([_LEFT_OPEN], [_reply(_TALKER)]))
    seen = discovery.settles(lambda known: _TALKER in known, quiet_s=_SHORT_S)
    assert seen


def _comes(discovery: Discovery, kind: Kind, name: str, number: int) -> None:
    entity = Entity("1f", 0, number, kind, "/n", name, "std_srvs/srv/Empty")
    sample = SimpleNamespace(key_expr=token(0, entity), kind=zenoh.SampleKind.PUT)
    discovery._on_token(sample)


def _seen(discovery: Discovery, coming: list[tuple[Kind, str]]) -> Callable[[Any], bool]:
    """Return a condition that lets one thing more come each time it does not hold."""

    def condition(known: Iterable[Entity]) -> bool:
        found = any(one.name == "/wanted" for one in known)
        if not found and coming:
            _comes(discovery, *coming.pop(0), number=len(coming))
        return found

    return condition


def test_what_comes_with_the_rest_is_found() -> None:
    discovery = _discovery_of(Replies([]))
    coming = [(Kind.SERVICE, name) for name in ("/a", "/b", "/c", "/wanted")]
    assert discovery.settles(_seen(discovery, coming), quiet_s=_SHORT_S)
    assert coming == []


def test_what_does_not_come_is_missing_once_it_is_quiet() -> None:
    discovery = _discovery_of(Replies([]))
    coming = [(Kind.SERVICE, name) for name in ("/a", "/b")]
    assert not discovery.settles(_seen(discovery, coming), quiet_s=_SHORT_S)
    assert [one.name for one in discovery.known()] == ["/a", "/b"]


def _told(discovery: Discovery, entity: Entity, kind: zenoh.SampleKind) -> None:
    discovery._on_token(SimpleNamespace(key_expr=token(0, entity), kind=kind))


def test_coming_that_is_told_after_the_going_is_not_believed(
    graph: Graph, eventually: Callable[..., Any]
) -> None:
    ended = Entity("1f", 0, 7, Kind.SUBSCRIPTION, "/n", "/in", "std_msgs/msg/String")
    seen: list[tuple[str, bool]] = []
    graph.discovery.listen(
        lambda one, is_there: seen.append((one.name, is_there)) if one.name == "/in" else None
    )
    _told(graph.discovery, ended, zenoh.SampleKind.DELETE)
    _told(graph.discovery, ended, zenoh.SampleKind.PUT)
    assert graph.subscription_count("/in") == 1
    eventually(lambda: graph.subscription_count("/in") == 0)
    assert ended not in graph.discovery.ask()
    assert seen == [("/in", False), ("/in", True), ("/in", False)]


def test_what_comes_again_stays_while_the_hub_leaves_questions_open(
    graph: Graph, monkeypatch: pytest.MonkeyPatch, eventually: Callable[..., Any]
) -> None:
    answers: list[frozenset[str] | None] = [None, None, None, None, frozenset([token(0, _TALKER)])]
    monkeypatch.setattr("gazelle.graph.discovery._DOUBT_S", 0.01)
    monkeypatch.setattr(
        "gazelle.graph.discovery.hub_tokens", lambda _port, _selector, _s: answers.pop(0)
    )
    _told(graph.discovery, _TALKER, zenoh.SampleKind.DELETE)
    _told(graph.discovery, _TALKER, zenoh.SampleKind.PUT)
    eventually(lambda: not graph.discovery._is_asking)
    assert answers == []
    assert _TALKER in graph.discovery.known()


def test_what_a_lost_link_brings_again_stays(
    graph: Graph, other: Graph, eventually: Callable[..., Any]
) -> None:
    other.create_node("listener").create_subscription("/in", String, print)
    eventually(lambda: graph.subscription_count("/in") == 1)
    found = next(one for one in graph.discovery.known() if one.name == "/in")
    _told(graph.discovery, found, zenoh.SampleKind.DELETE)
    _told(graph.discovery, found, zenoh.SampleKind.PUT)
    eventually(lambda: not graph.discovery._is_asking)
    assert found in graph.discovery.known()


def test_a_service_that_is_about_to_come_is_called(
    graph: Graph, other: Graph, eventually: Callable[..., Any]
) -> None:
    server = other.create_node("server")
    client = graph.create_node("caller").create_client("late", Empty)
    other.discovery.listen(
        lambda one, _is_there: (
            server.create_service("late", Empty, lambda _request: Empty.Response())
            if one.name == "/begin"
            else None
        )
    )
    graph.create_node("begin").create_client("begin", Empty)
    assert client.call(Empty.Request()) == Empty.Response()
