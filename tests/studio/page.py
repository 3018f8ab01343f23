"""A page as the server sees it: a WebSocket that speaks docs/studio_protocol.md."""

from __future__ import annotations

import contextlib
import itertools
import json
import queue
import struct
import threading
from typing import Any, NamedTuple, Self

from tests.patience import PATIENCE_S, stretched
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from gazelle.studio.security import token_of_user

_HEADER = struct.Struct("<HHId")


class RefusedError(Exception):
    """An error of the server.

    Attributes:
        error: as it came.
    """

    def __init__(self, error: dict[str, Any]) -> None:
        self.error = error
        super().__init__(error["message"])


class Binary(NamedTuple):
    """A binary frame."""

    kind: int
    number: int
    stamp_s: float
    payload: bytes


class Stream:
    """An open channel; items are acknowledged when they are taken."""

    def __init__(self, page: Page, number: int, *, acks: bool = True) -> None:
        self.page = page
        self.number = number
        self.info: Any = None
        self.items: queue.SimpleQueue[Any] = queue.SimpleQueue()
        self.status: queue.SimpleQueue[dict[str, Any]] = queue.SimpleQueue()
        self.ended: queue.SimpleQueue[dict[str, Any]] = queue.SimpleQueue()
        self.answer: queue.SimpleQueue[dict[str, Any]] = queue.SimpleQueue()
        self._acks = acks

    def next(self, timeout_s: float = PATIENCE_S) -> Any:
        """Return the next item: a JSON value or a `Binary`."""
        item = self.items.get(timeout=stretched(timeout_s))
        if self._acks:
            self.ack()
        return item

    def until(self, wanted: Any) -> Any:
        """Return the first item that a function says yes to."""
        while not wanted(item := self.next()):
            pass
        return item

    def ack(self) -> None:
        self.page.send(op="ack", ch=self.number)

    def change(self, **params: Any) -> None:
        self.page.send(op="change", ch=self.number, params=params)

    def close(self) -> None:
        self.page.send(op="close", ch=self.number)


class Page:
    """A connection to a server."""

    def __init__(self, port: int, path: str = "", **headers: str) -> None:
        self._stack = contextlib.ExitStack()
        opening = connect(
            f"ws://127.0.0.1:{port}{path or f'/ws?token={token_of_user()}'}",
            compression=None,
            max_size=None,
            additional_headers=headers,
            open_timeout=stretched(),
        )
        self.socket = self._stack.enter_context(opening)
        self.hello: dict[str, Any] = json.loads(self.socket.recv(stretched()))
        self.shown: queue.SimpleQueue[dict[str, Any]] = queue.SimpleQueue()
        self._numbers = itertools.count(1)
        self._answers: dict[int | None, queue.SimpleQueue[dict[str, Any]]] = {
            None: queue.SimpleQueue()
        }
        self._streams: dict[int, Stream] = {}
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exc_info: object) -> None:
        self.close()

    def close(self) -> None:
        self._stack.close()
        self._reader.join(stretched())

    def send(self, **value: Any) -> None:
        self.socket.send(json.dumps(value))

    def call(self, method: str, **params: Any) -> Any:
        """Return what a method returns."""
        number = next(self._numbers)
        self.expect(number)
        self.send(op="call", id=number, method=method, params=params)
        return self.answer(number)

    def expect(self, number: int) -> None:
        """Take the answer of a call of this number."""
        self._answers[number] = queue.SimpleQueue()

    def answer(self, number: int) -> Any:
        """Return the value of a call, or raise its error."""
        answer = self._answers[number].get(timeout=stretched())
        if answer["op"] == "error":
            raise RefusedError(answer["error"])
        return answer["value"]

    def raw(self, text: str) -> dict[str, Any]:
        """Send any text and return the answer that belongs to no call."""
        self.socket.send(text)
        return self._answers[None].get(timeout=stretched())

    def open(self, stream: str, *, acks: bool = True, **params: Any) -> Stream:
        """Return an open stream."""
        made = Stream(self, next(self._numbers), acks=acks)
        self._streams[made.number] = made
        self.send(op="open", ch=made.number, stream=stream, params=params)
        answer = made.answer.get(timeout=stretched())
        if answer["op"] == "failed":
            raise RefusedError(answer["error"])
        made.info = answer["info"]
        return made

    def display(self, name: str, topic: str, fixed_frame: str = "map", **params: Any) -> Stream:
        return self.open("display", display=name, topic=topic, fixed_frame=fixed_frame, **params)

    def _read(self) -> None:
        try:
            for message in self.socket:
                self._take(message)
        except ConnectionClosed:
            return

    def _take(self, message: str | bytes) -> None:
        if isinstance(message, bytes):
            channel, kind, number, stamp_s = _HEADER.unpack_from(message)
            frame = Binary(kind, number, stamp_s, message[_HEADER.size :])
            self._streams[channel].items.put(frame)
            return
        value = json.loads(message, parse_constant=_refuse)
        op = value["op"]
        if op in ("result", "error"):
            self._answers[value["id"]].put(value)
        elif op == "show":
            self.shown.put(value)
        else:
            stream = self._streams[value["ch"]]
            if op == "data":
                stream.items.put(value["value"])
            else:
                places = {"status": stream.status, "ended": stream.ended}
                places.get(op, stream.answer).put(value)


def _refuse(word: str) -> None:
    raise AssertionError(f"{word} is not JSON")
