"""Sessions end without holding up what else goes on in the process."""

from __future__ import annotations

import gc
from typing import Any

from tests.patience import eventually

from gazelle.graph.closing import close_session


def test_a_closed_session_is_never_destroyed() -> None:
    """The transport's destructor waits for callbacks, and lets no thread run meanwhile."""
    done: list[str] = []

    class Session:
        def close(self) -> None:
            done.append("closed")

        def __del__(self) -> None:
            done.append("destroyed")

    close_session(Session(), lambda: done.append("then"))
    eventually(lambda: "then" in done)
    gc.collect()
    assert done == ["closed", "then"]


def test_messages_flow_while_other_sessions_come_and_go(graph: Any, other: Any, join: Any) -> None:
    """Each message is a callback that a destructor could have waited for."""
    from gazelle.interfaces import message_type

    kind = message_type("std_msgs/msg/Int32")
    heard: list[int] = []
    publisher = other.create_node("talker").create_publisher("count", kind)
    graph.create_node("listener").create_subscription("count", kind, lambda m: heard.append(m.data))
    eventually(lambda: publisher.matched)
    published = 0
    for _ in range(10):
        passing = join(role="client")
        for _ in range(100):
            publisher.publish(kind(data=published))
            published += 1
        passing.close()
        del passing
        gc.collect()
    eventually(lambda: len(heard) == published)
    assert heard == sorted(heard)
