from __future__ import annotations

import threading
from typing import Any

import pytest
from tests.patience import eventually, stretched

from gazelle.graph.actions.client_events import ClientEvents
from gazelle.graph.subscription import MAX_WAITING


class _Node:
    def __init__(self) -> None:
        self.told: list[tuple[str, str]] = []

    def log(self, level: str, text: str) -> None:
        self.told.append((level, text))


@pytest.fixture
def node() -> Any:
    return _Node()


def test_newest_of_a_topic_wait_and_what_is_told_once_is_not_dropped(node: Any) -> None:
    seen: list[Any] = []
    news, begun, goes_on = ClientEvents(node, "/dig"), threading.Event(), threading.Event()

    def slow(message: int) -> None:
        begun.set()
        goes_on.wait(stretched())
        seen.append(message)

    take = news.topic("/dig/feedback", slow)
    take(0)
    assert begun.wait(stretched())
    news.put(lambda: seen.append("accepted"))
    for number in range(1, MAX_WAITING + 50):
        take(number)
    news.put(lambda: seen.append("result"))
    goes_on.set()
    eventually(lambda: seen[-1:] == ["result"])
    assert seen == [0, "accepted", *range(50, MAX_WAITING + 50), "result"]
    assert node.told == [
        (
            "warn",
            "a callback of the action /dig is slower than /dig/feedback: 1000 messages wait, and "
            "the oldest are dropped from now on",
        )
    ]
    news.close()


def test_what_a_callback_raises_is_told_and_the_next_is_handled(node: Any) -> None:
    seen: list[int] = []
    news = ClientEvents(node, "/dig")
    take = news.topic("/dig/feedback", lambda message: seen.append(10 // message))
    take(0)
    take(5)
    eventually(lambda: seen == [2])
    ((level, text),) = node.told
    assert level == "error" and text.startswith("bad callback: Traceback")
    assert text.endswith("ZeroDivisionError: integer division or modulo by zero")
    news.close()
