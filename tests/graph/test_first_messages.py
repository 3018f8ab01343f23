"""What a new publisher sends at once reaches who listens already."""

from __future__ import annotations

import threading

import pytest

from gazelle.graph import Graph


@pytest.mark.parametrize("role", ["client", "node"])
def test_the_first_messages_of_a_publisher_arrive(role: str, free_port: int) -> None:
    arrived: dict[str, list[int]] = {}
    done = threading.Event()
    with Graph.open(port=free_port) as hub, Graph.open(port=free_port, role="client") as own:
        taker, sender = (own, hub) if role == "node" else (hub, own)
        ear, mouth = taker.create_node("ear"), sender.create_node("mouth")
        for place in range(5):
            topic = f"/topic{place}"
            got = arrived[topic] = []

            def take(message: object, got: list[int] = got) -> None:
                got.append(message.data)  # type: ignore[attr-defined]
                if message.data == 2:  # type: ignore[attr-defined]
                    done.set()

            ear.create_subscription(topic, "std_msgs/msg/Int32", take)
            for _ in range(500):
                if sender.subscription_count(topic) or done.wait(0.01):
                    break
            done.clear()
            publisher = mouth.create_publisher(topic, "std_msgs/msg/Int32")
            for number in range(3):
                publisher.publish(publisher.message_class(data=number))
            done.wait(2.0)
    assert all(got == [0, 1, 2] for got in arrived.values()), arrived
