"""What a new publisher sends at once reaches who listens already, and all of it."""

from __future__ import annotations

import threading

import pytest
from tests.patience import eventually

from gazelle.graph import Graph

_THREADS = 4
_EACH = 1000


@pytest.mark.parametrize("role", ["client", "node"])
def test_the_first_messages_of_a_publisher_arrive(role: str, free_port: int) -> None:
    arrived: dict[str, list[int]] = {}
    with Graph.open(port=free_port) as hub, Graph.open(port=free_port, role="client") as own:
        taker, sender = (own, hub) if role == "node" else (hub, own)
        ear, mouth = taker.create_node("ear"), sender.create_node("mouth")
        for place in range(5):
            topic = f"/topic{place}"
            got = arrived[topic] = []

            def take(message: object, got: list[int] = got) -> None:
                got.append(message.data)  # type: ignore[attr-defined]

            ear.create_subscription(topic, "std_msgs/msg/Int32", take)
            eventually(lambda topic=topic: sender.subscription_count(topic))
            publisher = mouth.create_publisher(topic, "std_msgs/msg/Int32")
            for number in range(3):
                publisher.publish(publisher.message_class(data=number))
            eventually(lambda got=got: 2 in got, why=lambda: str(arrived))
    assert all(got == [0, 1, 2] for got in arrived.values()), arrived


def test_what_threads_of_a_process_publish_at_once_on_one_topic_arrives(free_port: int) -> None:
    got: list[int] = []
    with Graph.open(port=free_port) as hub, Graph.open(port=free_port, role="client") as own:
        ear, mouth = own.create_node("ear"), hub.create_node("mouth")
        ear.create_subscription(
            "/chatter", "std_msgs/msg/Int32", lambda message: got.append(message.data), queue_size=0
        )
        eventually(lambda: hub.subscription_count("/chatter"))
        publishers = [
            mouth.create_publisher("/chatter", "std_msgs/msg/Int32") for _ in range(_THREADS)
        ]

        def send(place: int) -> None:
            publisher = publishers[place]
            for number in range(place * _EACH, (place + 1) * _EACH):
                publisher.publish(publisher.message_class(data=number))

        threads = [threading.Thread(target=send, args=(place,)) for place in range(_THREADS)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        publishers[0].publish(publishers[0].message_class(data=-1))
        eventually(lambda: -1 in got[-1:])
    assert sorted(got) == list(range(-1, _THREADS * _EACH))
