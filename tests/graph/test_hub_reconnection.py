"""Looking after a process whose link is lost."""

from __future__ import annotations

import threading
from types import SimpleNamespace
from typing import Any

import pytest
import zenoh
from tests.patience import stretched

from gazelle.graph import hub
from gazelle.graph.hub import Reconnection


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> tuple[threading.Event, threading.Event]:
    """Let the question about a lost process begin and end at the test's word."""
    begun, answered = threading.Event(), threading.Event()

    def lives(_self: Reconnection, _zid: str) -> bool:
        begun.set()
        assert answered.wait(stretched(30))
        return False

    monkeypatch.setattr(Reconnection, "_lives", lives)
    monkeypatch.setattr(hub, "_RECONNECT_PAUSE_S", (0.0, 0.0))
    return begun, answered


def test_close_waits_for_a_question_that_is_under_way(
    asked: tuple[threading.Event, threading.Event],
) -> None:
    begun, answered = asked
    relinker = Reconnection(port=1)
    relinker.lost("abc")
    assert begun.wait(stretched(30))
    closing = threading.Thread(target=relinker.close)
    closing.start()
    closing.join(0.05)
    assert closing.is_alive()
    answered.set()
    closing.join(stretched(30))
    assert not closing.is_alive()


def test_nothing_is_asked_after_the_close(
    asked: tuple[threading.Event, threading.Event],
) -> None:
    begun, answered = asked
    answered.set()
    relinker = Reconnection(port=1)
    relinker.close()
    before = set(threading.enumerate())
    relinker.lost("abc")
    assert not [one for one in set(threading.enumerate()) - before if "_look_after" in one.name]
    assert not begun.is_set()


def test_a_question_that_closes_too_slowly_is_answered_all_the_same(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    class Session:
        def liveliness(self) -> Session:
            return self

        def get(self, _selector: str, _channel: Any, timeout: float) -> list[SimpleNamespace]:
            return [SimpleNamespace(ok=SimpleNamespace(key_expr=f"@ros2_lv/0/abc/{timeout}"))]

        def close(self) -> None:
            raise zenoh.ZError("close operation timed out!")

    monkeypatch.setattr(zenoh, "open", lambda _config: Session())
    monkeypatch.setattr(hub, "somebody_listens", lambda _port: True)
    assert hub.hub_knows(1, "@ros2_lv/*/abc/**")


def test_a_hub_that_leaves_a_question_open_is_asked_again(monkeypatch: pytest.MonkeyPatch) -> None:
    answers = [None, None, frozenset(["@ros2_lv/0/abc/1"])]
    monkeypatch.setattr(hub, "somebody_listens", lambda _port: True)
    monkeypatch.setattr(hub, "_tokens_now", lambda _port, _selector: answers.pop(0))
    assert hub.hub_knows(1, "@ros2_lv/*/abc/**")
    assert answers == []


def test_where_there_is_no_hub_nothing_is_known(free_port: int) -> None:
    assert hub.hub_tokens(free_port, "@ros2_lv/**") is None
    assert not hub.hub_knows(free_port, "@ros2_lv/**")
