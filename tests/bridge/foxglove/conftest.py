"""A graph, bridges to viewers made for tests, and viewers that speak Foxglove's protocol."""

from __future__ import annotations

import contextlib
import itertools
import json
import struct
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest
from tests.patience import eventually

from gazelle.bridge.foxglove import Allow, FoxgloveBridge, SdkViewers
from gazelle.bridge.foxglove.server_interface import Connections, Requests, ServiceOffer, Viewers
from gazelle.graph import Graph
from gazelle.workspace import Workspace

_LOOPBACK = "127.0.0.1"


class PlainChannel:
    """A channel that keeps what is sent."""

    def __init__(self, number: int, topic: str, type_name: str, schema: str) -> None:
        self.number = number
        self.topic = topic
        self.type_name = type_name
        self.schema = schema
        self.sent: list[tuple[bytes, int]] = []
        self.closed = False

    def send(self, data: bytes, stamp_ns: int) -> None:
        self.sent.append((data, stamp_ns))

    def close(self) -> None:
        self.closed = True


class PlainViewers:
    """Viewers without a network: keeps what they would be told."""

    def __init__(self, requests: Requests) -> None:
        self.requests = requests
        self.port = 1
        self.all_channels: list[PlainChannel] = []
        self.services: dict[str, ServiceOffer] = {}
        self.times: list[int] = []
        self.parameters: list[Mapping[str, Any]] = []
        self.connections: Connections | None = None
        self.closed = False

    @property
    def channels(self) -> dict[str, PlainChannel]:
        return {one.topic: one for one in self.all_channels if not one.closed}

    def add_channel(self, topic: str, type_name: str, schema: str) -> PlainChannel:
        self.all_channels.append(PlainChannel(len(self.all_channels) + 1, topic, type_name, schema))
        return self.all_channels[-1]

    def add_services(self, offers: Iterable[ServiceOffer]) -> None:
        self.services |= {one.name: one for one in offers}

    def remove_services(self, names: Iterable[str]) -> None:
        for name in names:
            del self.services[name]

    def show_time(self, now_ns: int) -> None:
        self.times.append(now_ns)

    def show_parameters(self, values: Mapping[str, Any]) -> None:
        self.parameters.append(values)

    def show_connections(self, connections: Connections) -> None:
        self.connections = connections

    def close(self) -> None:
        self.closed = True


class Viewer:
    """A client of the protocol over a real WebSocket.

    Attributes:
        channels: what the server offers, by topic.
        services: the same, by name.
        heard: operations that came, by their word, newest last.
        messages: (bytes, nanoseconds) by topic.
        times: nanoseconds the server told.
        answers: of services, by number of the call.
        assets: files by number of the request, None for those it does not get.
    """

    def __init__(self, port: int) -> None:
        client = pytest.importorskip("websockets.sync.client", reason="needs pip's websockets")
        self._end = ExitStack()
        self._socket = self._end.enter_context(
            client.connect(
                f"ws://{_LOOPBACK}:{port}",
                subprotocols=["foxglove.sdk.v1"],
                max_size=None,
                close_timeout=0.2,
                ping_interval=None,
            )
        )
        self._numbers = itertools.count(1)
        self._topics: dict[int, str] = {}
        self._subscribed: dict[int, int] = {}
        self.channels: dict[str, dict[str, Any]] = {}
        self.services: dict[str, dict[str, Any]] = {}
        self.heard: dict[str, list[dict[str, Any]]] = {}
        self.messages: dict[str, list[tuple[bytes, int]]] = {}
        self.times: list[int] = []
        self.answers: dict[int, bytes] = {}
        self.assets: dict[int, bytes | None] = {}
        self.info = self.wait_for(lambda: self.heard.get("serverInfo"))[0]

    def wait_for(self, condition: Callable[[], Any]) -> Any:
        """Read until a condition gives something true, and return it."""

        def read_until() -> Any:
            if not (found := condition()):
                with contextlib.suppress(TimeoutError):
                    self._take(self._socket.recv(timeout=0.05))
            return found

        return eventually(read_until, why=lambda: str(self.heard))

    def subscribe(self, topic: str) -> int:
        channel = self.wait_for(lambda: self.channels.get(topic))["id"]
        number = next(self._numbers)
        self._topics[number] = topic
        self._subscribed[channel] = number
        self._send_subscription(channel)
        return number

    def _send_subscription(self, channel: int) -> None:
        row = {"id": self._subscribed[channel], "channelId": channel}
        self.send({"op": "subscribe", "subscriptions": [row]})

    def unsubscribe(self, number: int) -> None:
        self.send({"op": "unsubscribe", "subscriptionIds": [number]})

    def advertise(self, topic: str, type_name: str, encoding: str = "cdr") -> int:
        number = next(self._numbers)
        row = {"id": number, "topic": topic, "encoding": encoding, "schemaName": type_name}
        self.send({"op": "advertise", "channels": [row]})
        return number

    def publish(self, number: int, data: bytes) -> None:
        self._socket.send(struct.pack("<BI", 1, number) + data)

    def call(self, service: str, data: bytes) -> int:
        number = self.wait_for(lambda: self.services.get(service))["id"]
        call = next(self._numbers)
        self._socket.send(struct.pack("<BIII", 2, number, call, 3) + b"cdr" + data)
        return call

    def send(self, operation: dict[str, Any]) -> None:
        self._socket.send(json.dumps(operation))

    def close(self) -> None:
        self._end.close()

    def _take(self, frame: str | bytes) -> None:
        if isinstance(frame, bytes):
            self._take_binary(frame)
            return
        operation = json.loads(frame)
        self.heard.setdefault(operation["op"], []).append(operation)
        match operation["op"]:
            case "status" if operation["message"].startswith("Unknown channel ID: "):
                # foxglove-sdk 0.30 tells of a channel a moment before it knows it itself.
                self._send_subscription(int(operation["message"].rpartition(" ")[2]))
            case "advertise":
                self.channels |= {one["topic"]: one for one in operation["channels"]}
            case "unadvertise":
                gone = operation["channelIds"]
                self.channels = {k: v for k, v in self.channels.items() if v["id"] not in gone}
            case "advertiseServices":
                self.services |= {one["name"]: one for one in operation["services"]}
            case "unadvertiseServices":
                gone = operation["serviceIds"]
                self.services = {k: v for k, v in self.services.items() if v["id"] not in gone}

    def _take_binary(self, frame: bytes) -> None:
        if frame[0] == 1:
            number, stamp_ns = struct.unpack_from("<IQ", frame, 1)
            self.messages.setdefault(self._topics[number], []).append((frame[13:], stamp_ns))
        elif frame[0] == 2:
            self.times.append(struct.unpack_from("<Q", frame, 1)[0])
        elif frame[0] == 3:
            _, call, length = struct.unpack_from("<III", frame, 1)
            assert frame[13 : 13 + length] == b"cdr"
            self.answers[call] = frame[13 + length :]
        elif frame[0] == 4:
            call, failed, length = struct.unpack_from("<IBI", frame, 1)
            self.assets[call] = None if failed else frame[10 + length :]


@pytest.fixture
def make_bridge(graph: Graph, tmp_path: Path) -> Iterator[Callable[..., FoxgloveBridge]]:
    """Makes bridges that are on the graph as processes of their own would be."""
    made: list[tuple[Graph, FoxgloveBridge]] = []

    def make(make_viewers: Callable[[Requests], Viewers], *allow: Allow) -> FoxgloveBridge:
        own = Graph.open(port=graph.port, environ={})
        try:
            bridge = FoxgloveBridge(
                own, Workspace.discover(environ={}, extra=[tmp_path]), make_viewers, allow
            )
        except BaseException:
            own.close()
            raise
        made.append((own, bridge))
        return bridge

    yield make
    for own, bridge in reversed(made):
        bridge.close()
        own.close()


@pytest.fixture
def viewers(make_bridge: Callable[..., FoxgloveBridge]) -> PlainViewers:
    """Viewers that may do everything, without a network."""
    made: list[PlainViewers] = []

    def make(requests: Requests) -> PlainViewers:
        made.append(PlainViewers(requests))
        return made[0]

    make_bridge(make, *Allow)
    return made[0]


@pytest.fixture
def make_served(make_bridge: Callable[..., FoxgloveBridge]) -> Callable[..., FoxgloveBridge]:
    """Makes bridges with Foxglove's own server."""
    pytest.importorskip("foxglove", reason="needs pip install 'gazelle-sim[foxglove]'")

    def make(*allow: Allow) -> FoxgloveBridge:
        return make_bridge(
            lambda requests: SdkViewers(requests, host=_LOOPBACK, port=0, allow=allow), *allow
        )

    return make


@pytest.fixture
def connect() -> Iterator[Callable[[FoxgloveBridge], Viewer]]:
    """Connects viewers."""
    made: list[Viewer] = []

    def make(bridge: FoxgloveBridge) -> Viewer:
        made.append(Viewer(bridge.port))
        return made[-1]

    yield make
    for one in made:
        one.close()
