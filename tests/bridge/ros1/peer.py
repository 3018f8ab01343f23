"""A node of ROS 1 for tests: XMLRPC and TCPROS from their documents, standard library only."""

from __future__ import annotations

import http.client
import socket
import struct
import threading
import xmlrpc.client
import xmlrpc.server
from collections.abc import Callable
from typing import Any

from tests.patience import stretched

Header = dict[str, str]
_LENGTH = struct.Struct("<I")


def string_bytes(text: str) -> bytes:
    """A std_msgs/String."""
    return _LENGTH.pack(len(text)) + text.encode()


def pack_header(fields: Header) -> bytes:
    lines = [f"{key}={value}".encode() for key, value in fields.items()]
    body = b"".join(_LENGTH.pack(len(line)) + line for line in lines)
    return _LENGTH.pack(len(body)) + body


def read_bytes(stream: socket.socket, size: int) -> bytes:
    data = b""
    while len(data) < size:
        part = stream.recv(size - len(data))
        if not part:
            raise ConnectionError("ended")
        data += part
    return data


def read_block(stream: socket.socket) -> bytes:
    return read_bytes(stream, _LENGTH.unpack(read_bytes(stream, 4))[0])


def read_fields(stream: socket.socket) -> Header:
    body, fields = read_block(stream), {}
    while body:
        size = _LENGTH.unpack_from(body)[0]
        key, _, value = body[4 : 4 + size].decode().partition("=")
        fields[key] = value
        body = body[4 + size :]
    return fields


def ask(uri: str, method: str, *arguments: Any) -> Any:
    """The (code, text, value) that a server answers with."""
    return getattr(xmlrpc.client.ServerProxy(uri, allow_none=True), method)(*arguments)


def post(uri: str, body: bytes, **headers: str) -> http.client.HTTPResponse:
    """Send what xmlrpc.client would not."""
    place = uri.removeprefix("http://").rstrip("/")
    connection = http.client.HTTPConnection(place, timeout=stretched())
    connection.request("POST", "/", body, {"Content-Type": "text/xml", **headers})
    return connection.getresponse()


class Peer:
    """A node with one slave server and one TCPROS port.

    Attributes:
        updates: (method, arguments) of all calls of the slave server.
    """

    def __init__(self, master: str, name: str = "/peer") -> None:
        self.master = master
        self.name = name
        self.updates: list[tuple[str, tuple[Any, ...]]] = []
        self.headers: list[Header] = []
        self.answers: dict[str, Header] = {}
        self.after: dict[str, Callable[[socket.socket], None]] = {}
        self.streams: list[socket.socket] = []
        self.server = xmlrpc.server.SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False)
        self.uri = f"http://127.0.0.1:{self.server.server_address[1]}/"
        for method in ("publisherUpdate", "paramUpdate", "shutdown"):
            self.server.register_function(self._note(method), method)
        self.server.register_function(self._request_topic, "requestTopic")
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port: int = self.listener.getsockname()[1]
        self.place: list[Any] = ["TCPROS", "127.0.0.1", self.port]
        threading.Thread(target=self.server.serve_forever, args=(0.01,), daemon=True).start()
        threading.Thread(target=self._accept, daemon=True).start()

    def close(self) -> None:
        self.server.shutdown()
        self.server.server_close()
        for one in (self.listener, *self.streams):
            one.close()

    def call(self, method: str, *arguments: Any) -> Any:
        """Ask the master; the value of a success."""
        code, text, value = ask(self.master, method, self.name, *arguments)
        assert code == 1, text
        return value

    def publish_on(
        self, topic: str, kind: str, md5: str, *messages: bytes, latching: str = "0", text: str = ""
    ) -> None:
        """Offer a topic; each subscriber gets these messages."""
        self.answers[topic] = {
            "callerid": self.name, "type": kind, "md5sum": md5, "latching": latching,
            "message_definition": text,
        }  # fmt: skip

        def send(stream: socket.socket) -> None:
            for message in messages:
                stream.sendall(_LENGTH.pack(len(message)) + message)

        self.after[topic] = send
        self.call("registerPublisher", topic, kind, self.uri)

    def serve(self, name: str, kind: str, md5: str, answer: Callable[[bytes], bytes]) -> None:
        """Offer a service; an answer that raises is a failure."""
        self.answers[name] = {"callerid": self.name, "type": kind, "md5sum": md5}

        def reply(stream: socket.socket) -> None:
            if self.headers[-1].get("probe") == "1":
                return
            request = read_block(stream)
            try:
                body, well = answer(request), b"\1"
            except ValueError as error:
                body, well = str(error).encode(), b"\0"
            stream.sendall(well + _LENGTH.pack(len(body)) + body)

        self.after[name] = reply
        self.call("registerService", name, f"rosrpc://127.0.0.1:{self.port}", self.uri)

    def subscribe(
        self, uri: str, topic: str, kind: str = "*", md5: str = "*"
    ) -> tuple[Header, socket.socket]:
        """Connect to a publisher; its header and the stream that follows."""
        code, text, place = ask(uri, "requestTopic", self.name, topic, [["TCPROS"]])
        assert code == 1, text
        stream = self.connect(place[1], place[2])
        header = {"callerid": self.name, "topic": topic, "type": kind, "md5sum": md5}
        stream.sendall(pack_header(header))
        return read_fields(stream), stream

    def open_service(self, name: str, md5: str = "*", **more: str) -> tuple[Header, socket.socket]:
        """Connect to a service; its header and the stream."""
        host, port = self.call("lookupService", name).removeprefix("rosrpc://").split(":")
        stream = self.connect(host, int(port))
        header = {"callerid": self.name, "service": name, "md5sum": md5, **more}
        stream.sendall(pack_header(header))
        return read_fields(stream), stream

    def connect(self, host: str, port: int) -> socket.socket:
        stream = socket.create_connection((host, port), stretched())
        self.streams.append(stream)
        return stream

    def _note(self, method: str) -> Callable[..., Any]:
        def note(*arguments: Any) -> Any:
            self.updates.append((method, arguments))
            return 1, "", 0

        return note

    def _request_topic(self, caller: Any, topic: Any, protocols: Any) -> Any:
        assert caller.startswith("/") and ["TCPROS"] in protocols
        if topic not in self.answers:
            return 0, "no such topic", 0
        return 1, "ready", self.place

    def _accept(self) -> None:
        while True:
            try:
                stream, _ = self.listener.accept()
            except OSError:
                return
            self.streams.append(stream)
            threading.Thread(target=self._serve, args=(stream,), daemon=True).start()

    def _serve(self, stream: socket.socket) -> None:
        try:
            header = read_fields(stream)
            self.headers.append(header)
            name = header.get("service") or header["topic"]
            stream.sendall(pack_header(self.answers[name]))
            self.after[name](stream)
        except (OSError, KeyError):
            return


def call_on(stream: socket.socket, request: bytes) -> tuple[bool, bytes]:
    """Send a request over an open service connection; success and body."""
    stream.sendall(_LENGTH.pack(len(request)) + request)
    well = read_bytes(stream, 1)
    return well == b"\1", read_block(stream)
