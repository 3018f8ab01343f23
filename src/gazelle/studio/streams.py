"""Streams: what flows to the page on one channel, and how much of it may wait.

*latest*: at most two frames are under way without an ``ack``; of what waits, only the newest is
made into a frame, so a slow page costs nothing. *batch*: nothing is lost; items that come close
together travel together.
"""

from __future__ import annotations

import struct
import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, Protocol, TypeVar

from gazelle.errors import GazelleError
from gazelle.studio.errors import error_value
from gazelle.studio.json_text import json_text

if TYPE_CHECKING:
    from gazelle.studio.request_params import Params
    from gazelle.studio.workers import Workers

__all__ = [
    "MAX_BEHIND_BYTES",
    "Channel",
    "Frame",
    "FrameSink",
    "OpenStream",
    "Pace",
    "StreamKind",
    "every",
]

MAX_BEHIND_BYTES = 8 << 20
"""What may wait for the page on one batch channel."""

_CREDITS = 2
_GATHER_S = 0.03
_HEADER = struct.Struct("<HHId")
_Part = TypeVar("_Part")


class Frame(NamedTuple):
    """A binary frame.

    Attributes:
        kind: what the payload is, see docs/studio_protocol.md.
        number: how many of them, the protocol's ``count``.
        stamp_s: time of the data.
        parts: the payload's bytes or arrays, one behind the other.
    """

    kind: int
    number: int
    stamp_s: float
    parts: tuple[Any, ...]


class OpenStream(NamedTuple):
    """A stream at work.

    Attributes:
        close: ends it; called once.
        info: goes with ``opened``.
        change: takes new parameters; without it the stream is opened anew and then closed.
    """

    close: Callable[[], None]
    info: Any = None
    change: Callable[[Params], None] | None = None


class StreamKind(NamedTuple, Generic[_Part]):
    """A row of the table of streams, over the part that it works on.

    Attributes:
        latest: its delivery class; False is batch.
        open: starts a stream; runs in a thread of its own and may wait.
    """

    latest: bool
    open: Callable[[_Part, Channel, Params], OpenStream]


class FrameSink(Protocol):
    """Where frames go; both methods may be called from any thread."""

    def post(self, data: str | bytes, on_sent: Callable[[], None] | None = None) -> None:
        """Send a text or binary frame; `on_sent` is called when it is on its way."""

    def later(self, delay_s: float, call: Callable[[], None]) -> None:
        """Call something in the event loop."""


class Channel:
    """One channel of one page, as a stream sees it. All methods may be called from any thread.

    Attributes:
        number: ``ch`` of the protocol.
        latest: its delivery class.
    """

    def __init__(
        self, number: int, *, latest: bool, frame_sink: FrameSink, workers: Workers
    ) -> None:
        """Open an empty channel."""
        self.number = number
        self.latest = latest
        self._frame_sink = frame_sink
        self._workers = workers
        self._lock = threading.Lock()
        self._closed = False
        self._credits = _CREDITS
        self._next: Callable[[], Any] | None = None
        self._making = False
        self._items: list[str] = []
        self._behind_bytes = 0
        self._failed = ""
        self._held: list[tuple[str | bytes, Callable[[], None] | None]] | None = []

    @property
    def closed(self) -> bool:
        """True when nothing more can be sent."""
        return self._closed

    def offer(self, make: Callable[[], Any]) -> None:
        """Give the newest data of a *latest* stream; whatever waited is forgotten.

        Args:
            make: returns a `Frame`, a JSON value, a tuple of these, or None for nothing; it is
                called in a worker's thread once the page has room. Its `GazelleError` becomes the
                channel's status.
        """
        with self._lock:
            if self._closed:
                return
            self._next = make
            start = self._credits > 0 and not self._making
            self._making = self._making or start
        if start:
            self._workers.submit(self._make)

    def send(self, value: Any) -> None:
        """Send one item of a *batch* stream: a JSON value or a `Frame`."""
        self._post(self._encoded(value))

    def add(self, item: Any) -> None:
        """Add an item to the list that goes with the next frame of a *batch* stream."""
        text = json_text(item)
        with self._lock:
            if self._closed:
                return
            self._items.append(text)
            first = len(self._items) == 1
        if first:
            self._frame_sink.later(_GATHER_S, self._flush)

    def later(self, delay_s: float, call: Callable[[], None]) -> None:
        """Call something short in the event loop."""
        self._frame_sink.later(delay_s, call)

    def work(self, job: Callable[[], None]) -> None:
        """Do a job that takes its time in a worker's thread, soon; it must not raise."""
        self._workers.submit(job)

    def status(self, level: str, text: str = "") -> None:
        """Set the status line: ``ok``, ``warn`` or ``error``."""
        if not self._closed:
            value = {"op": "status", "ch": self.number, "level": level, "text": text}
            self._out(json_text(value))

    def begin(self, info: Any) -> None:
        """Send ``opened`` and then whatever the stream has given so far."""
        with self._lock:
            value = {"op": "opened", "ch": self.number, "info": info}
            self._frame_sink.post(json_text(value))
            held, self._held = self._held or [], None
            for data, on_sent in held:
                self._frame_sink.post(data, on_sent)

    def end(self, error: BaseException | None = None) -> None:
        """Say that the stream is over; nothing is sent afterwards."""
        with self._lock:
            if self._closed:
                return
            self._closed = True
            self._next = None
        value: dict[str, Any] = {"op": "ended", "ch": self.number}
        if error is not None:
            value["error"] = error_value(error)
        self._out(json_text(value))

    def acknowledge(self) -> None:
        """The page has drawn a frame: it has room for another."""
        with self._lock:
            self._credits = min(self._credits + 1, _CREDITS)
            start = self._next is not None and not self._making and not self._closed
            self._making = self._making or start
        if start:
            self._workers.submit(self._make)

    def shut(self) -> None:
        """Send nothing more."""
        with self._lock:
            self._closed = True
            self._next = None
            self._items = []

    def _make(self) -> None:
        make = self._take_next()
        frames: tuple[Any, ...] = ()
        if make is not None and not self._closed:
            frames = self._made(make)
        with self._lock:
            # Before they are sent: the page may have drawn them before this goes on.
            self._credits -= len(frames)
        # Before another worker may make the next: the newest is sent last.
        self._send_frames(frames)
        with self._lock:
            again = self._next is not None and self._credits > 0 and not self._closed
            self._making = again
        if again:
            self._workers.submit(self._make)

    def _take_next(self) -> Callable[[], Any] | None:
        with self._lock:
            make, self._next = self._next, None
        return make

    def _send_frames(self, frames: tuple[Any, ...]) -> None:
        for frame in frames:
            if not self._closed:
                self._out(self._encoded(frame))

    def _made(self, make: Callable[[], Any]) -> tuple[Any, ...]:
        try:
            made = make()
        except GazelleError as error:
            self._tell_failure(str(error))
            return ()
        except Exception as error:  # noqa: BLE001 - one bad message must not end the display
            self._tell_failure(f"{type(error).__name__}: {error}")
            return ()
        if self._failed and made is not None:
            self._failed = ""
            self.status("ok")
        if made is None:
            return ()
        plain_tuple = type(made) is tuple
        return made if plain_tuple else (made,)

    def _tell_failure(self, text: str) -> None:
        if text != self._failed:
            self._failed = text
            self.status("error", text)

    def _flush(self) -> None:
        with self._lock:
            items, self._items = self._items, []
        if items and not self._closed:
            self._post(f'{{"op":"data","ch":{self.number},"value":[{",".join(items)}]}}')

    def _post(self, data: str | bytes) -> None:
        size = len(data)
        with self._lock:
            if self._closed:
                return
            self._behind_bytes += size
            too_far = self._behind_bytes > MAX_BEHIND_BYTES and self._behind_bytes > size
        if too_far:
            limit = MAX_BEHIND_BYTES >> 20
            self.end(GazelleError(f"the page is more than {limit} MiB behind on this stream"))
            return
        self._out(data, lambda: self._sent(size))

    def _out(self, data: str | bytes, on_sent: Callable[[], None] | None = None) -> None:
        with self._lock:
            if self._held is not None:
                self._held.append((data, on_sent))
            else:
                self._frame_sink.post(data, on_sent)

    def _sent(self, size: int) -> None:
        with self._lock:
            self._behind_bytes -= size

    def _encoded(self, value: Any) -> str | bytes:
        if isinstance(value, Frame):
            head = _HEADER.pack(self.number, value.kind, value.number, value.stamp_s)
            return b"".join((head, *value.parts))
        return f'{{"op":"data","ch":{self.number},"value":{json_text(value)}}}'


class Pace:
    """Lets something happen at most `rate_hz` times a second, the last one never lost."""

    def __init__(self, channel: Channel, act: Callable[[], None], rate_hz: float) -> None:
        """Call `act` in the thread that is due or in the event loop; it must be short."""
        self._channel = channel
        self._act = act
        self._period_s = 1.0 / rate_hz
        self._lock = threading.Lock()
        self._due_s = 0.0
        self._waiting = False

    def __call__(self) -> None:
        """Something new is there."""
        now_s = time.monotonic()
        with self._lock:
            if self._waiting:
                return
            wait_s = self._due_s - now_s
            if wait_s > 0:
                self._waiting = True
            else:
                self._due_s = now_s + self._period_s
        if wait_s > 0:
            self._channel.later(wait_s, self._late)
        else:
            self._act()

    def _late(self) -> None:
        with self._lock:
            self._waiting = False
            self._due_s = time.monotonic() + self._period_s
        if not self._channel.closed:
            self._act()


def every(channel: Channel, period_s: float, act: Callable[[], None]) -> None:
    """Call `act` now and so often until the channel closes; in the event loop, so be short."""

    def again() -> None:
        if not channel.closed:
            act()
            channel.later(period_s, again)

    again()
