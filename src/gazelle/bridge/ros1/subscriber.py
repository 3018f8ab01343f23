"""A topic of ROS 1 on its way to subscriptions on the graph."""

from __future__ import annotations

import contextlib
import socket
import threading
from collections.abc import Callable, Iterable
from typing import Any, Protocol

from gazelle.bridge.ros1.tcpros import FrameError, read_frame, read_header, write_header
from gazelle.bridge.ros1.types import MessageKind, message_kind
from gazelle.bridge.ros1.xmlrpc_call import RemoteError, RemoteRefusedError, call
from gazelle.errors import GazelleError, GraphError
from gazelle.graph import ANY_TYPE, Publisher
from gazelle.interfaces import RosVersion, keep_text

__all__ = ["PublisherOf", "TcprosSubscriber"]

_CONNECT_S = 5.0
_FIRST_PAUSE_S = 0.2
_MAX_PAUSE_S = 5.0
_TCPROS = "TCPROS"


class PublisherOf(Protocol):
    """Gives what speaks on the graph for a node of ROS 1."""

    def __call__(
        self, node: str, topic: str, kind: MessageKind, latched: bool, /
    ) -> Publisher | None:
        """Return the publisher, None when the node may not speak there."""


class TcprosSubscriber:
    """Takes one topic from all of its publishers in ROS 1."""

    def __init__(
        self,
        topic: str,
        subscriber: str,
        publisher_of: PublisherOf,
        notice: Callable[[str], None],
    ) -> None:
        """Start with no publisher.

        Args:
            topic: global name.
            subscriber: name of the node in ROS 1 on whose behalf it is taken.
            publisher_of: finds what to publish with.
            notice: told of what goes wrong, once for each publisher.
        """
        self.topic = topic
        self._subscriber = subscriber
        self._publisher_of = publisher_of
        self._notice = notice
        self._lock = threading.Lock()
        self._sources: dict[str, _Source] = {}

    def update(self, uris: Iterable[str]) -> None:
        """Take the topic from the nodes with these slave servers and no others."""
        wanted = set(uris)
        with self._lock:
            gone = [self._sources.pop(uri) for uri in set(self._sources) - wanted]
            for uri in wanted - set(self._sources):
                self._sources[uri] = _Source(self, uri)
        for source in gone:
            source.close()

    def close(self) -> None:
        """Take nothing more."""
        self.update(())

    @property
    def connections(self) -> list[tuple[str, int, int]]:
        """Publisher's name, messages and bytes of each connection that is there."""
        with self._lock:
            sources = list(self._sources.values())
        return [(one.node, one.received, one.received_bytes) for one in sources if one.node]


class _Source:
    """The connection to one publisher; made again when it breaks."""

    def __init__(self, subscriber: TcprosSubscriber, uri: str) -> None:
        self.node = ""
        self.received = 0
        self.received_bytes = 0
        self._owner = subscriber
        self._uri = uri
        self._ended = threading.Event()
        self._stream: socket.socket | None = None
        self._told = False
        threading.Thread(
            target=self._run, name=f"subscriber {subscriber.topic}", daemon=True
        ).start()

    def close(self) -> None:
        """End the connection and do not make it again."""
        self._ended.set()
        stream = self._stream
        if stream is not None:
            with contextlib.suppress(OSError):
                stream.shutdown(socket.SHUT_RDWR)

    def _run(self) -> None:
        pause_s = _FIRST_PAUSE_S
        while not self._ended.is_set():
            before = self.received
            try:
                self._take()
            except RemoteRefusedError as error:
                self._tell(str(error))
            except (RemoteError, OSError):
                # Not there yet, or just gone; the master says when it is gone for good.
                pass
            except GazelleError as error:
                self._tell(str(error))
            self.node = ""
            pause_s = _FIRST_PAUSE_S if self.received > before else pause_s
            self._ended.wait(pause_s)
            pause_s = min(2 * pause_s, _MAX_PAUSE_S)

    def _take(self) -> None:
        subscriber = self._owner
        found = call(
            self._uri, "requestTopic", subscriber._subscriber, subscriber.topic, [[_TCPROS]]
        )
        host, port = _place(found, self._uri)
        with socket.create_connection((host, port), _CONNECT_S) as stream:
            self._stream = stream
            if self._ended.is_set():
                return
            stream.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            stream.sendall(write_header(_request(subscriber._subscriber, subscriber.topic)))
            header = read_header(stream)
            publisher, kind = self._publisher(header)
            stream.settimeout(None)
            self.node = header.get("callerid", "?")
            self._publish(stream, publisher, kind)

    def _publisher(self, header: dict[str, str]) -> tuple[Publisher, MessageKind]:
        """Return what to publish with, by what the other side says of itself.

        Raises:
            FrameError: it refuses, or its type is not the one that is known by this name.
        """
        topic = self._owner.topic
        if "error" in header:
            raise FrameError(header["error"])
        kind = message_kind(header.get("type", ""))
        if header.get("md5sum") not in (ANY_TYPE, kind.md5):
            raise FrameError(
                f"{header.get('callerid')} publishes {topic} as {kind.ros1_name} with md5sum "
                f"{header.get('md5sum')}, but {kind.md5} is known here; its messages are dropped\n"
                f"  fix: put the package that defines it into the workspace of the bridge"
            )
        # The publisher's own words for the type, comments and all: bags keep them.
        keep_text(kind.ros1_name, RosVersion.ROS1, header.get("message_definition", ""))
        latched = header.get("latching") == "1"
        publisher = self._owner._publisher_of(header.get("callerid", ""), topic, kind, latched)
        if publisher is None:
            raise ConnectionError(f"{header.get('callerid')} is no publisher of {topic}")
        return publisher, kind

    def _publish(self, stream: socket.socket, publisher: Publisher, kind: MessageKind) -> None:
        while not self._ended.is_set():
            data = read_frame(stream)
            self.received += 1
            self.received_bytes += len(data)
            message = kind.from_bytes(data)
            try:
                publisher.publish(message)
            except GraphError as error:
                # The node has just unregistered the topic, or its name has changed hands.
                raise ConnectionError(str(error)) from error

    def _tell(self, text: str) -> None:
        if not self._told:
            self._told = True
            self._owner._notice(f"messages on {self._owner.topic} do not reach the graph: {text}")


def _place(found: Any, uri: str) -> tuple[str, int]:
    """Return host and port of an answer to ``requestTopic``."""
    well = isinstance(found, list) and len(found) == 3 and found[0] == _TCPROS
    if not well or not isinstance(found[1], str) or not isinstance(found[2], int):
        raise FrameError(f"{uri} names no place for {_TCPROS}: {found!r}")
    return found[1], found[2]


def _request(subscriber: str, topic: str) -> dict[str, str]:
    return {
        "callerid": subscriber,
        "md5sum": ANY_TYPE,
        "message_definition": "",
        "tcp_nodelay": "1",
        "topic": topic,
        "type": ANY_TYPE,
    }
