"""One page's WebSocket: calls, streams, and what waits to be sent."""

from __future__ import annotations

import asyncio
import json
from collections import deque
from collections.abc import Callable, Coroutine
from contextlib import suppress
from typing import Any

from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed

from gazelle.studio.errors import StudioError, error_value, unknown
from gazelle.studio.json_text import json_text
from gazelle.studio.protocol import METHODS, STREAMS
from gazelle.studio.request_params import Params
from gazelle.studio.streams import Channel, OpenStream, StreamKind
from gazelle.studio.studio import Studio
from gazelle.studio.workers import in_thread

__all__ = ["Connection"]

_MAX_CALLS = 256
_MAX_CHANNELS = 500
_MAX_CHANNEL = 65_535
_PAUSE_BYTES = 64 << 20
_MAX_WAITING_BYTES = 256 << 20
_LONG_TEXT = 64 << 10
_CLOSE_MISUSE = 1008


class _Open:
    """A channel with its stream; what is done to it is done in the order asked for."""

    def __init__(self, channel: Channel, name: str, kind: StreamKind[Studio]) -> None:
        self.channel = channel
        self.name = name
        self.kind = kind
        self.turn = asyncio.Lock()
        self.stream: OpenStream | None = None


class Connection:
    """Runs one WebSocket until it closes."""

    def __init__(self, studio: Studio, socket: ServerConnection) -> None:
        """Prepare; `run` does the work."""
        self._studio = studio
        self._socket = socket
        self._loop = asyncio.get_running_loop()
        self._out: deque[tuple[str | bytes, Callable[[], None] | None]] = deque()
        self._out_bytes = 0
        self._filled = asyncio.Event()
        self._emptied = asyncio.Event()
        self._emptied.set()
        self._channels: dict[int, _Open] = {}
        self._used: set[int] = set()
        self._calls: set[asyncio.Task[None]] = set()
        self._tasks: set[asyncio.Task[None]] = set()
        self._closed = False

    async def run(self) -> None:
        """Serve the page until it goes."""
        writer = asyncio.create_task(self._write())
        self._studio.pages.enter(self)
        for greeting in self._studio.pages.hello():
            self.post(json_text(greeting))
        try:
            async for message in self._socket:
                await self._take(message)
                await self._emptied.wait()
        except ConnectionClosed:
            pass  # it went without a word, as pages that are reloaded do
        finally:
            self._closed = True
            self._studio.pages.leave(self)
            writer.cancel()
            for one in self._channels.values():
                one.channel.shut()
            await asyncio.gather(*(self._close(one) for one in list(self._channels.values())))
            # Nobody waits for their answers any more; what opens streams has to close them yet.
            for call in self._calls:
                call.cancel()
            await asyncio.gather(*self._calls, *self._tasks, return_exceptions=True)

    def post(self, data: str | bytes, on_sent: Callable[[], None] | None = None) -> None:
        """Send a frame; from any thread."""
        self._soon(self._put, data, on_sent)

    def later(self, delay_s: float, call: Callable[[], None]) -> None:
        """Call something in the event loop; from any thread."""
        self._soon(self._loop.call_later, delay_s, call)

    def _soon(self, call: Callable[..., Any], *arguments: Any) -> None:
        # The loop may close at any moment, and with it everybody who could be told.
        with suppress(RuntimeError):
            if not self._closed:
                self._loop.call_soon_threadsafe(call, *arguments)

    def _put(self, data: str | bytes, on_sent: Callable[[], None] | None) -> None:
        self._out.append((data, on_sent))
        self._out_bytes += len(data)
        if self._out_bytes > _MAX_WAITING_BYTES:
            self._socket.transport.abort()
        elif self._out_bytes > _PAUSE_BYTES:
            self._emptied.clear()
        self._filled.set()

    async def _write(self) -> None:
        try:
            while True:
                await self._filled.wait()
                self._filled.clear()
                while self._out:
                    data, on_sent = self._out.popleft()
                    await self._socket.send(data)
                    self._out_bytes -= len(data)
                    if on_sent is not None:
                        on_sent()
                    if self._out_bytes <= _PAUSE_BYTES:
                        self._emptied.set()
        except ConnectionClosed:
            self._emptied.set()

    async def _take(self, message: str | bytes) -> None:
        if isinstance(message, bytes):
            await self._refuse("binary frames come from the server only")
            return
        try:
            long = len(message) > _LONG_TEXT
            value = await in_thread(json.loads, message) if long else json.loads(message)
        except (ValueError, RecursionError):
            await self._refuse("this is not JSON")
            return
        op = value.get("op") if isinstance(value, dict) else None
        act = _OPERATIONS.get(op) if isinstance(op, str) else None
        if act is None:
            text = f"'op' is one of {', '.join(_OPERATIONS)}"
            self._fail("error", {"id": None}, StudioError(text))
            return
        act(self, value)

    async def _refuse(self, text: str) -> None:
        await self._socket.close(_CLOSE_MISUSE, text)

    def _spawn(
        self, work: Coroutine[Any, Any, None], kept: set[asyncio.Task[None]] | None = None
    ) -> None:
        kept = self._tasks if kept is None else kept
        task = asyncio.create_task(work)
        kept.add(task)
        task.add_done_callback(kept.discard)

    def _fail(self, op: str, key: dict[str, Any], error: BaseException) -> None:
        self.post(json_text({"op": op, **key, "error": error_value(error)}))

    def _on_call(self, value: dict[str, Any]) -> None:
        key = {"id": _plain(value.get("id"))}
        if len(self._calls) >= _MAX_CALLS:
            error = StudioError(f"more than {_MAX_CALLS} calls have no answer yet")
            self._fail("error", key, error)
            return
        work = self._call(key, value.get("method"), value.get("params"))
        self._spawn(work, self._calls)

    async def _call(self, key: dict[str, Any], method: Any, params: Any) -> None:
        try:
            handler = METHODS.get(method) if isinstance(method, str) else None
            if handler is None:
                raise unknown("method", str(_plain(method)), METHODS)
            text = await in_thread(
                lambda: json_text(
                    {"op": "result", **key, "value": handler(self._studio, Params(method, params))}
                )
            )
            self.post(text)
        except Exception as error:  # noqa: BLE001 - every call has an answer
            self._fail("error", key, error)

    def _on_open(self, value: dict[str, Any]) -> None:
        number, name = value.get("ch"), value.get("stream")
        kind = STREAMS.get(name) if isinstance(name, str) else None
        error = self._why_not(number)
        if error is None and kind is None:
            error = unknown("stream", str(_plain(name)), STREAMS)
        if error is not None or kind is None or not isinstance(number, int):
            self._fail("failed", {"ch": _plain(number)}, error or StudioError("'ch' is a number"))
            return
        channel = Channel(number, latest=kind.latest, frame_sink=self, workers=self._studio.workers)
        self._used.add(number)
        one = self._channels[number] = _Open(channel, str(name), kind)
        self._spawn(self._open(one, value.get("params")))

    def _why_not(self, number: Any) -> StudioError | None:
        is_whole = isinstance(number, int) and not isinstance(number, bool)
        if not is_whole or not 1 <= number <= _MAX_CHANNEL:
            return StudioError(f"'ch' is a whole number from 1 to {_MAX_CHANNEL}")
        if number in self._used:
            return StudioError(f"channel {number} was used before on this connection")
        if len(self._channels) >= _MAX_CHANNELS:
            return StudioError(f"more than {_MAX_CHANNELS} streams are open")
        return None

    async def _open(self, one: _Open, params: Any) -> None:
        async with one.turn:
            try:
                one.stream = await self._started(one, params)
            except Exception as error:  # noqa: BLE001 - every request has an answer
                self._channels.pop(one.channel.number, None)
                one.channel.shut()
                self._fail("failed", {"ch": one.channel.number}, error)

    async def _started(self, one: _Open, params: Any) -> OpenStream:
        wanted = Params(one.name, params)
        stream = await in_thread(one.kind.open, self._studio, one.channel, wanted)
        one.channel.begin(stream.info)
        return stream

    def _on_change(self, value: dict[str, Any]) -> None:
        one = self._find(value)
        if one is not None:
            self._spawn(self._change(one, value.get("params")))

    async def _change(self, one: _Open, params: Any) -> None:
        async with one.turn:
            old = one.stream
            if old is None:
                return
            try:
                wanted = Params(one.name, params)
                if old.change is not None:
                    await in_thread(old.change, wanted)
                    return
                one.stream = await in_thread(one.kind.open, self._studio, one.channel, wanted)
                await in_thread(old.close)
            except Exception as error:  # noqa: BLE001 - the stream goes on as it was
                one.channel.status("error", str(error))

    def _on_ack(self, value: dict[str, Any]) -> None:
        one = self._find(value)
        if one is not None:
            one.channel.acknowledge()

    def _on_close(self, value: dict[str, Any]) -> None:
        one = self._find(value)
        if one is not None:
            one.channel.shut()
            del self._channels[one.channel.number]
            self._spawn(self._close(one))

    async def _close(self, one: _Open) -> None:
        async with one.turn:
            stream, one.stream = one.stream, None
            if stream is not None:
                await in_thread(stream.close)

    def _find(self, value: dict[str, Any]) -> _Open | None:
        number = value.get("ch")
        return self._channels.get(number) if isinstance(number, int) else None


def _plain(key: Any) -> Any:
    """Return an id to answer with; none for a list or an object, which may be nested deeply."""
    return None if isinstance(key, list | dict) else key


_OPERATIONS: dict[str, Callable[[Connection, dict[str, Any]], None]] = {
    "call": Connection._on_call,
    "open": Connection._on_open,
    "change": Connection._on_change,
    "ack": Connection._on_ack,
    "close": Connection._on_close,
}
