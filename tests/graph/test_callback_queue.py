"""A mailbox outlives what its items lead to."""

from __future__ import annotations

import threading
from typing import Any

import pytest
from tests.patience import eventually, stretched

from gazelle.errors import GraphError
from gazelle.graph import Graph
from gazelle.graph.callback_queue import Bound, CallbackQueue
from gazelle.interfaces import message_type


def test_mailbox_goes_on_after_an_item_that_cannot_be_handled_and_tells_once_a_kind(
    capsys: pytest.CaptureFixture[str],
) -> None:
    handled = []

    def handle(item: int) -> None:
        if item < 2:
            raise GraphError(f"no {item}")
        if item < 4:
            raise ZeroDivisionError
        handled.append(item)

    mailbox = CallbackQueue(handle, size=0, name="post")
    for item in range(6):
        mailbox.put(item)
    eventually(lambda: handled == [4, 5])
    mailbox.close()
    told = capsys.readouterr().err
    assert told.count("post: something that came is left out") == 2
    assert "post: something that came is left out: no 0\n" in told
    assert "ZeroDivisionError" in told
    assert "no 1" not in told


def test_what_waits_without_a_limit_of_items_has_one_of_bytes() -> None:
    """A slow callback of a subscriber without a queue's size would fill the memory."""
    handled, goes_on, told = [], threading.Event(), []

    def handle(item: bytes) -> None:
        goes_on.wait(stretched())
        handled.append(item)

    bound = Bound(1000, len, lambda item: item[:100], lambda: told.append("full"))
    mailbox = CallbackQueue(handle, size=0, name="post", bound=bound)
    mailbox.put(b"first")
    eventually(mailbox._items.empty)
    for number in range(100):
        mailbox.put(bytes([number]) * 200)
    assert mailbox._items.qsize() == 10
    assert mailbox.dropped == 90
    assert told == ["full"]
    goes_on.set()
    eventually(lambda: len(handled) == 11)
    assert [item[0] for item in handled[1:]] == list(range(90, 100))
    mailbox.close()


def test_slow_callback_is_told_and_loses_the_oldest(
    graph: Graph, other: Graph, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("gazelle.graph.subscription._MAX_WAITING_BYTES", 100_000)
    kind = message_type("std_msgs/msg/String")
    seen: list[str] = []
    begun, goes_on = threading.Event(), threading.Event()

    def slow(message: Any) -> None:
        begun.set()
        goes_on.wait(stretched())
        seen.append(message.data[:4])

    subscription = graph.create_node("slow").create_subscription("/x", kind, slow)
    publisher = other.create_node("fast").create_publisher("/x", kind)
    eventually(lambda: publisher.matched)
    publisher.publish(kind(data="0000"))
    assert begun.wait(stretched())
    for number in range(1, 101):
        publisher.publish(kind(data=f"{number:04}" + "x" * 10_000))
    eventually(lambda: subscription.dropped >= 90)
    goes_on.set()
    eventually(lambda: seen and seen[-1] == "0100")
    assert len(seen) < 12
    told = capsys.readouterr().err
    assert told.count("the callback of /x is slower than its messages: ") == 1
    assert "give the subscriber a queue_size" in told
