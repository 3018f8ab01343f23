"""Publishing single messages."""

from __future__ import annotations

import threading
import time
from collections import OrderedDict
from typing import Any

from gazelle.graph import Node, Publisher
from gazelle.interfaces import message_type
from gazelle.studio.graph_view.message_forms import filled
from gazelle.studio.request_params import Params
from gazelle.studio.subscriptions import topic_name

__all__ = ["Outbox", "publish"]

_KEPT = 32
_MATCH_S = 1.0
_LOOK_S = 0.005


def publish(outbox: Outbox, params: Params) -> dict[str, Any]:
    """``topic.publish``."""
    message_class = message_type(params.text("type"))
    message = filled(message_class, params.object("message", {}), outbox.node.clock.now_ns())
    outbox.publisher(params.text("topic"), message_class).publish(message)
    return {}


class Outbox:
    """Publishers that stay for the next message: a new one is heard only after a moment.

    Attributes:
        node: who publishes.
    """

    def __init__(self, node: Node) -> None:
        """Publish as `node`."""
        self.node = node
        self._lock = threading.Lock()
        self._kept: OrderedDict[tuple[str, str], Publisher] = OrderedDict()

    def publisher(self, topic: str, message_class: Any) -> Publisher:
        """Return the publisher of a topic; a new one has met those who listen already."""
        topic = topic_name(self.node, topic)
        key = (topic, message_class.TYPE_NAME)
        with self._lock:
            found = self._kept.get(key)
            if found is None:
                found = self._kept[key] = self.node.create_publisher(topic, message_class)
                self._wait_for_match(found)
            self._kept.move_to_end(key)
            while len(self._kept) > _KEPT:
                self._kept.popitem(last=False)[1].unregister()
            return found

    def _wait_for_match(self, publisher: Publisher) -> None:
        deadline_s = time.monotonic() + _MATCH_S
        pause = threading.Event()
        while not publisher.matched and time.monotonic() < deadline_s:
            if not self.node.graph.subscription_count(publisher.topic):
                return
            pause.wait(_LOOK_S)
