"""The hub moves when its process ends."""

from __future__ import annotations

import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest

from gazelle.graph import Graph, locators, sessions
from gazelle.interfaces import message_type

String = message_type("std_msgs/msg/String")


def test_hub_is_taken_over_and_messages_flow_on(
    graph: Graph,
    other: Graph,
    join: Callable[..., Graph],
    inbox: Any,
    eventually: Callable[..., Any],
) -> None:
    third = join()
    publisher = other.create_node("talker").create_publisher("chatter", String)
    third.create_node("listener").create_subscription("chatter", String, inbox)
    # By the hub they know of each other sooner than they have a link of their own.
    eventually(lambda: publisher.matched and third.zid in map(str, other.session.info.peers_zid()))
    graph.close()
    publisher.publish(String(data="still here"))
    assert inbox.wait_for(1)[0].data == "still here"
    eventually(lambda: other.is_hub != third.is_hub and other.connected and third.connected)
    late = join()
    late.create_node("late").create_subscription("chatter", String, inbox)
    eventually(lambda: publisher.subscription_count == 2)
    client = join(role="client")
    eventually(lambda: client.node_names() == ("/late", "/listener", "/talker"))


def test_who_comes_while_the_hub_closes_waits_for_its_place(
    port: int,
    join: Callable[..., Graph],
    eventually: Callable[..., Any],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    import zenoh

    monkeypatch.setattr("gazelle.graph.parameter_server._NO_OWNER_S", 0.0)
    release = locators.claim_hub(port)
    assert release is not None
    hub: Any = zenoh.open(sessions.hub_config(port))
    closed = threading.Event()
    refused: list[int] = []

    def claim(number: int) -> Callable[[], None] | None:
        found = locators.claim_hub(number)
        if found is None and closed.is_set():
            refused.append(number)
            if len(refused) == 2:
                release()
        return found

    monkeypatch.setattr("gazelle.graph.hub.claim_hub", claim)
    with ThreadPoolExecutor() as pool:
        opening = pool.submit(join)
        eventually(hub.info.peers_zid)
        hub.close()
        closed.set()
        assert opening.result().is_hub
    assert len(refused) == 2


def test_a_session_that_ends_takes_no_hub_over(
    graph: Graph, other: Graph, eventually: Callable[..., Any]
) -> None:
    keeper: Any = other._keeper
    keeper.settle()
    graph.close()
    eventually(lambda: not other.connected)
    assert not keeper.carry()
    eventually(lambda: not keeper.watches)
    assert not other.is_hub


def test_last_member_leaves_the_port_free(graph: Graph, join: Callable[..., Graph]) -> None:
    graph.close()
    assert join().is_hub
