"""Publishers and subscriptions, in one process and between members of the graph."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from tests.patience import stretched

from gazelle.errors import GraphError
from gazelle.graph import Graph, MessageInfo, Node, RawMessage, type_support
from gazelle.interfaces import from_cdr, message_type, ros1_message_type

String = message_type("std_msgs/msg/String")
Image = message_type("sensor_msgs/msg/Image")
Wait = Callable[..., Any]
MISMATCH = "graph.type-mismatch"


@pytest.fixture
def talker(graph: Graph) -> Node:
    return graph.create_node("talker")


@pytest.fixture
def listener(other: Graph) -> Node:
    return other.create_node("listener")


def _texts(messages: list[Any]) -> list[str]:
    return [message.data for message in messages]


def test_messages_reach_another_member(
    talker: Node, listener: Node, inbox: Any, eventually: Wait
) -> None:
    publisher = talker.create_publisher("chatter", String)
    assert not publisher.matched
    listener.create_subscription("chatter", String, inbox)
    eventually(lambda: publisher.matched)
    for text in "abc":
        publisher.publish(String(data=text))
    assert _texts(inbox.wait_for(3)) == ["a", "b", "c"]


def test_subscriptions_of_the_process_get_the_same_object(talker: Node, inbox: Any) -> None:
    publisher = talker.create_publisher("chatter", String)
    talker.create_subscription("chatter", String, inbox)
    assert publisher.matched
    message = String(data="x")
    publisher.publish(message)
    assert inbox.wait_for(1)[0] is message


def test_inline_callbacks_run_before_publish_returns(talker: Node) -> None:
    got: list[Any] = []
    publisher = talker.create_publisher("chatter", String)
    talker.create_subscription("chatter", String, got.append, inline=True)
    publisher.publish(String(data="x"))
    assert _texts(got) == ["x"]


def test_local_copies_are_made_when_asked_for(talker: Node) -> None:
    got: list[Any] = []
    publisher = talker.create_publisher("chatter", String, copy_local=True)
    talker.create_subscription("chatter", String, got.append, inline=True)
    message = String(data="before")
    publisher.publish(message)
    message.data = "after"
    assert _texts(got) == ["before"]


def test_mixed_subscriptions_get_each_message_once(
    talker: Node, listener: Node, make_inbox: Any, eventually: Wait
) -> None:
    local, remote = make_inbox(), make_inbox()
    publisher = talker.create_publisher("chatter", String)
    talker.create_subscription("chatter", String, local)
    listener.create_subscription("chatter", String, remote)
    eventually(
        lambda: publisher.subscription_count == 2 and publisher._matcher.matching_status.matching
    )
    for text in ("a", "b", "end"):
        publisher.publish(String(data=text))
    assert _texts(local.wait_for(3)) == _texts(remote.wait_for(3)) == ["a", "b", "end"]


def test_latched_message_reaches_late_subscriptions_once(
    talker: Node, listener: Node, make_inbox: Any, eventually: Wait
) -> None:
    local, early, late = make_inbox(), make_inbox(), make_inbox()
    listener.create_subscription("map", String, early)
    publisher = talker.create_publisher("map", String, latch=True)
    eventually(lambda: publisher.matched)
    publisher.publish(String(data="old"))
    publisher.publish(String(data="map"))
    early.wait_for(2)
    talker.create_subscription("map", String, local)
    listener.create_subscription("map", String, late)
    assert _texts(local.wait_for(1)) == _texts(late.wait_for(1)) == ["map"]
    publisher.publish(String(data="end"))
    assert _texts(local.wait_for(2)) == _texts(late.wait_for(2)) == ["map", "end"]
    assert _texts(early.wait_for(3)) == ["old", "map", "end"]


def test_all_latched_publishers_of_a_topic_are_heard(
    talker: Node, listener: Node, inbox: Any
) -> None:
    for text in "abc":
        talker.create_publisher("tf_static", String, latch=True).publish(String(data=text))
    listener.create_subscription("tf_static", String, inbox)
    assert sorted(_texts(inbox.wait_for(3))) == ["a", "b", "c"]


def test_latched_publisher_that_comes_later_is_heard(
    talker: Node, listener: Node, inbox: Any
) -> None:
    listener.create_subscription("map", String, inbox)
    talker.create_publisher("map", String, latch=True).publish(String(data="map"))
    assert _texts(inbox.wait_for(1)) == ["map"]


def test_of_two_threads_the_same_one_has_the_last_word_here_and_elsewhere(
    talker: Node, listener: Node, make_inbox: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    publisher = talker.create_publisher("map", String, latch=True)
    second = threading.Thread(target=lambda: publisher.publish(String(data="second")))
    encode = type_support.encode

    def encode_behind_the_second(message: Any) -> bytes:
        if message.data == "first":
            second.start()
            second.join(0.3)
        return encode(message)

    monkeypatch.setattr(type_support, "encode", encode_behind_the_second)
    publisher.publish(String(data="first"))
    second.join(stretched())
    local, remote = make_inbox(), make_inbox()
    talker.create_subscription("map", String, local)
    listener.create_subscription("map", String, remote)
    assert _texts(local.wait_for(1)) == _texts(remote.wait_for(1)) == ["second"]


def test_wrong_type_is_reported_once_and_dropped(
    talker: Node, listener: Node, inbox: Any, eventually: Wait, capsys: pytest.CaptureFixture[str]
) -> None:
    listener.create_subscription("chatter", Image, inbox)
    wrong = talker.create_publisher("chatter", String)
    right = talker.create_publisher("chatter", Image)
    eventually(lambda: wrong.matched and right.matched)
    wrong.publish(String(data="x"))
    wrong.publish(String(data="x"))
    right.publish(Image(height=1))
    assert inbox.wait_for(1)[0].height == 1
    errors = capsys.readouterr().err
    assert errors.count(MISMATCH) == 1
    assert (
        "/listener wants topic /chatter to have type sensor_msgs/msg/Image, but it is published "
        "as std_msgs/msg/String"
    ) in errors


def test_wrong_type_in_the_same_process_is_reported(
    talker: Node, capsys: pytest.CaptureFixture[str]
) -> None:
    got: list[Any] = []
    talker.create_subscription("chatter", Image, got.append, inline=True)
    talker.create_publisher("chatter", String).publish(String(data="x"))
    assert not got
    assert MISMATCH in capsys.readouterr().err


def test_any_type_and_raw_subscriptions(
    talker: Node, listener: Node, make_inbox: Any, eventually: Wait
) -> None:
    decoded, raw, local_raw = make_inbox(), make_inbox(), make_inbox()
    listener.create_subscription("chatter", None, decoded)
    listener.create_subscription("chatter", None, raw, raw=True)
    talker.create_subscription("chatter", String, local_raw, raw=True)
    publisher = talker.create_publisher("chatter", String)
    eventually(
        lambda: publisher.subscription_count == 3 and publisher._matcher.matching_status.matching
    )
    publisher.publish(String(data="x"))
    assert decoded.wait_for(1) == [String(data="x")]
    for box in (raw, local_raw):
        message = box.wait_for(1)[0]
        assert isinstance(message, RawMessage)
        assert message.type_name == "std_msgs/msg/String"
        assert from_cdr(String, message.data) == String(data="x")


def test_ros1_views_and_ros2_types_meet(
    talker: Node, listener: Node, make_inbox: Any, eventually: Wait
) -> None:
    ros1_image = ros1_message_type("sensor_msgs/Image")
    local, remote, back = make_inbox(), make_inbox(), make_inbox()
    talker.create_subscription("image", ros1_image, local)
    listener.create_subscription("image", ros1_image, remote)
    publisher = talker.create_publisher("image", Image)
    eventually(
        lambda: publisher.subscription_count == 2 and publisher._matcher.matching_status.matching
    )
    for height in (1, 2):
        message = Image(height=height, data=np.arange(3, dtype=np.uint8))
        message.header.stamp.sec = 5
        publisher.publish(message)
    for box in (local, remote):
        second = box.wait_for(2)[1]
        assert (second.height, second.header.stamp.secs, bytes(second.data)) == (2, 5, b"\0\1\2")
    assert [one.header.seq for one in remote.items] == [1, 2]
    talker.create_subscription("back", Image, back)
    listener_publisher = listener.create_publisher("back", ros1_image)
    eventually(lambda: listener_publisher.matched)
    listener_publisher.publish(ros1_image(height=3))
    assert back.wait_for(1)[0].height == 3


def test_message_info_names_the_publisher(
    talker: Node, listener: Node, inbox: Any, eventually: Wait
) -> None:
    listener.create_subscription("chatter", String, inbox, with_info=True)
    publisher = talker.create_publisher("chatter", String)
    eventually(lambda: publisher.matched and listener.graph.publisher_count("/chatter"))
    publisher.publish(String())
    _, info = inbox.wait_for(1)[0]
    assert info == MessageInfo(1, info.stamp_ns, "/talker", "std_msgs/msg/String", info.gid)
    assert len(info.gid) == 16 and any(info.gid)


def test_full_queue_drops_the_oldest(talker: Node) -> None:
    entered, leave, got = threading.Event(), threading.Event(), []
    finished = threading.Event()

    def slow(message: Any) -> None:
        got.append(message.data)
        entered.set()
        leave.wait(stretched(30))
        if message.data == "9":
            finished.set()

    subscription = talker.create_subscription("chatter", String, slow, queue_size=2)
    publisher = talker.create_publisher("chatter", String)
    publisher.publish(String(data="0"))
    assert entered.wait(stretched(30))
    for number in range(1, 10):
        publisher.publish(String(data=str(number)))
    leave.set()
    assert finished.wait(stretched(30))
    assert got == ["0", "8", "9"]
    assert subscription.dropped == 7


def test_failing_callback_is_logged_and_the_next_message_comes(
    talker: Node, inbox: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    def fail_first(message: Any) -> None:
        inbox(message)
        if message.data == "a":
            raise ZeroDivisionError("oh no")

    talker.create_subscription("chatter", String, fail_first)
    publisher = talker.create_publisher("chatter", String)
    publisher.publish(String(data="a"))
    publisher.publish(String(data="b"))
    assert _texts(inbox.wait_for(2)) == ["a", "b"]
    errors = capsys.readouterr().err
    assert "bad callback:" in errors
    assert "ZeroDivisionError: oh no" in errors


def test_unregistered_ends_are_off_the_graph(
    talker: Node, listener: Node, inbox: Any, eventually: Wait
) -> None:
    publisher = talker.create_publisher("chatter", String)
    subscription = listener.create_subscription("chatter", String, inbox)
    eventually(lambda: publisher.matched)
    subscription.unregister()
    subscription.unregister()
    eventually(lambda: not publisher.matched)
    publisher.unregister()
    publisher.unregister()
    eventually(lambda: "/chatter" not in dict(listener.graph.topic_names_and_types()))
    with pytest.raises(GraphError, match="publish\\(\\) to a closed topic: /chatter"):
        publisher.publish(String())
    assert not publisher.matched


def test_message_of_another_class_is_refused(talker: Node) -> None:
    publisher = talker.create_publisher("chatter", String)
    with pytest.raises(GraphError, match="the topic's type is std_msgs/msg/String"):
        publisher.publish(Image())


def test_types_may_be_given_by_name(talker: Node, inbox: Any) -> None:
    talker.create_subscription("chatter", "std_msgs/String", inbox)
    talker.create_publisher("chatter", "std_msgs/msg/String").publish(String(data="x"))
    assert _texts(inbox.wait_for(1)) == ["x"]


def test_big_images_arrive_whole(
    talker: Node, listener: Node, inbox: Any, eventually: Wait
) -> None:
    pixels = np.random.default_rng(0).integers(0, 255, 640 * 480 * 3, np.uint8)
    publisher = talker.create_publisher("image", Image, reliable=False)
    listener.create_subscription("image", Image, inbox)
    eventually(lambda: publisher.matched)
    image = Image(height=480, width=640, step=1920, data=pixels)

    # A publisher of best effort may drop what finds no room on its way.
    def arrived() -> Any:
        publisher.publish(image)
        return inbox.items

    assert np.array_equal(eventually(arrived)[0].data, pixels)


def test_unregistering_while_another_thread_publishes_is_clean(
    talker: Node, listener: Node, inbox: Any, eventually: Wait
) -> None:
    listener.create_subscription("chatter", String, inbox)
    ended: list[BaseException] = []

    def publish_until_closed(publisher: Any) -> None:
        try:
            while True:
                publisher.publish(String(data="x" * 1000))
        except BaseException as error:  # noqa: BLE001 - whatever ends the thread is the result
            ended.append(error)

    for _ in range(20):
        publisher = talker.create_publisher("chatter", String)
        eventually(lambda one=publisher: one.matched)
        threads = [
            threading.Thread(target=publish_until_closed, args=(publisher,)) for _ in range(2)
        ]
        for thread in threads:
            thread.start()
        inbox.wait_for(len(inbox.items) + 5)
        publisher.unregister()
        for thread in threads:
            thread.join(stretched(30))
    assert len(ended) == 40
    assert {type(error) for error in ended} == {GraphError}


def test_what_was_published_last_arrives_before_its_process_has_left(
    graph: Graph, other: Graph, eventually: Wait
) -> None:
    got: list[int] = []

    def take(raw: RawMessage) -> None:
        threading.Event().wait(0.002)
        got.append(len(raw.data))

    graph.create_node("slow").create_subscription("chatter", None, take, raw=True, inline=True)
    publisher = other.create_node("talker").create_publisher("chatter", String)
    eventually(lambda: publisher.matched)
    for _ in range(100):
        publisher.publish(String(data="x" * 20_000))
    other.close()
    assert len(got) == 100


def test_a_subscriber_that_stands_still_does_not_keep_others_from_leaving(
    graph: Graph, other: Graph, eventually: Wait, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gazelle.graph.graph._LAST_MESSAGES_S", 0.2)
    goes_on, stands = threading.Event(), threading.Event()

    def take(raw: RawMessage) -> None:
        stands.set()
        goes_on.wait()

    graph.create_node("stands").create_subscription("chatter", None, take, raw=True, inline=True)
    publisher = other.create_node("talker").create_publisher("chatter", String)
    eventually(lambda: publisher.matched)
    publisher.publish(String(data="x"))
    eventually(stands.is_set)
    other.close()
    assert not goes_on.is_set()
    goes_on.set()
