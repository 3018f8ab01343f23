"""A world on a graph of its own, and Studio beside it."""

from __future__ import annotations

import json
import struct
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.graph import Graph
from gazelle.simulator import Simulation
from gazelle.simulator.gazebo_ros.api import offer_gazebo_ros
from gazelle.simulator.gui import offer_views
from gazelle.simulator.wall_clock import Mode
from gazelle.simulator.world_server import WorldServer
from gazelle.studio.errors import error_value
from gazelle.studio.protocol import METHODS, STREAMS
from gazelle.studio.request_params import Params
from gazelle.studio.streams import Channel
from gazelle.studio.studio import Studio


class Page:
    """A page without a browser: calls methods, opens streams, hears what they send."""

    def __init__(self, studio: Studio) -> None:
        self.studio = studio
        self._changed = threading.Condition()
        self._got: list[Any] = []
        self._number = 0

    def post(self, data: str | bytes, on_sent: Callable[[], None] | None = None) -> None:
        with self._changed:
            self._got.append(json.loads(data) if isinstance(data, str) else data)
            self._changed.notify_all()
        if on_sent is not None:
            # Not at once: the channel is at work.
            threading.Thread(target=on_sent).start()

    def later(self, delay_s: float, call: Callable[[], None]) -> None:
        threading.Timer(delay_s, call).start()

    def call(self, method: str, **params: Any) -> Any:
        """Return a method's value; its error raises `AssertionError` with the words."""
        try:
            return METHODS[method](self.studio, Params(method, params))
        except Exception as error:
            raise AssertionError(json.dumps(error_value(error))) from error

    def open(self, stream: str, **params: Any) -> Channel:
        self._number += 1
        kind = STREAMS[stream]
        channel = Channel(
            self._number, latest=kind.latest, frame_sink=self, workers=self.studio.workers
        )
        opened = kind.open(self.studio, channel, Params(stream, params))
        channel.begin(opened.info)
        return channel

    def wait(self, channel: Channel, wanted: Callable[[Any], bool] = lambda _: True) -> Any:
        """Return the next item of a channel that is as wanted: a JSON value, or a frame.

        Every frame is acknowledged, as a page does that has drawn it.
        """
        deadline = time.monotonic() + stretched()
        seen: list[Any] = []
        while True:
            with self._changed:
                left_s = deadline - time.monotonic()
                arrived = self._changed.wait_for(lambda: self._items(channel), max(0.0, left_s))
                assert arrived, f"nothing as wanted came; last: {str(seen[-1:])[:2000]}"
                seen = self._items(channel)
                self._got = [item for item in self._got if _channel(item) != channel.number]
            for _ in seen if channel.latest else ():
                channel.acknowledge()
            for item in seen:
                found = [value for value in _values(item, channel) if wanted(value)]
                if found:
                    return found[0]

    def _items(self, channel: Channel) -> list[Any]:
        return [item for item in self._got if _channel(item) == channel.number]


def _channel(item: Any) -> int:
    if isinstance(item, bytes):
        return int(struct.unpack_from("<H", item)[0])
    return int(item["ch"]) if item["op"] == "data" else 0


def _values(item: Any, channel: Channel) -> list[Any]:
    if isinstance(item, bytes):
        _, kind, count, stamp_s = struct.unpack_from("<HHId", item)
        return [(kind, count, stamp_s, item[16:])]
    return [item["value"]] if channel.latest else list(item["value"])


@pytest.fixture
def server(free_port: int) -> Iterator[WorldServer]:
    """A paused world with ground and sun that runs in a thread."""
    graph = Graph.open(port=free_port, environ={}, role="hub")
    node = graph.create_node("gazebo", rosout=False)
    server = Simulation.load(None, node=node).server
    server.mode = Mode.REAL_TIME
    server.pause()
    offer_gazebo_ros(server)
    offer_views(server)
    running = threading.Thread(target=server.run)
    running.start()
    yield server
    server.close()
    running.join(stretched())
    graph.close()


@pytest.fixture
def page(free_port: int) -> Iterator[Page]:
    """Studio on the same graph, as a process of its own would be."""
    graph = Graph.open(port=free_port, environ={})
    studio = Studio(graph)
    yield Page(studio)
    studio.close()
    graph.close()
