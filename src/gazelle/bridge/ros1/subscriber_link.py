"""One TCPROS connection that carries a topic to a subscriber in ROS 1."""

from __future__ import annotations

import contextlib
import socket
import threading
from collections import deque

from gazelle.bridge.ros1.tcpros import send_all
from gazelle.bridge.ros1.types import Frame

__all__ = ["FrameQueue", "SubscriberLink"]

_MAX_FRAMES = 1000
_MAX_BYTES = 1 << 24
_MIN_FRAMES = 2


class FrameQueue:
    """Frames that wait to be sent; the oldest are dropped when they are too many or too big.

    Attributes:
        dropped: how many were.
    """

    def __init__(self, most_frames: int = _MAX_FRAMES, most_bytes: int = _MAX_BYTES) -> None:
        """Start empty; two frames may wait however big they are."""
        self._frames: deque[Frame] = deque()
        self._bytes = 0
        self._most_frames = most_frames
        self._most_bytes = most_bytes
        self._changed = threading.Condition()
        self._closed = False
        self.dropped = 0

    def put(self, frame: Frame) -> None:
        """Add a frame; never waits."""
        with self._changed:
            self._frames.append(frame)
            self._bytes += frame.size
            while self._too_much():
                self._bytes -= self._frames.popleft().size
                self.dropped += 1
            self._changed.notify()

    def take(self) -> Frame | None:
        """Return the oldest frame, waiting for one; None after `close`."""
        with self._changed:
            while not self._frames and not self._closed:
                self._changed.wait()
            if self._closed:
                return None
            frame = self._frames.popleft()
            self._bytes -= frame.size
            return frame

    def close(self) -> None:
        """Let `take` return."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()

    def _too_much(self) -> bool:
        count = len(self._frames)
        if count <= _MIN_FRAMES:
            return False
        return count > self._most_frames or self._bytes > self._most_bytes


class SubscriberLink:
    """Sends frames in a thread of its own, so a slow subscriber holds up nobody else.

    Attributes:
        subscriber: name of the node at the other end.
        sent: frames sent.
        sent_bytes: bytes sent.
    """

    def __init__(self, stream: socket.socket, subscriber: str, topic: str) -> None:
        """Keep what comes until `start`."""
        self.subscriber = subscriber
        self.sent = 0
        self.sent_bytes = 0
        self._stream = stream
        self._queue = FrameQueue()
        self._thread = threading.Thread(target=self._run, name=f"link {topic}", daemon=True)

    def start(self, header: bytes) -> None:
        """Send the connection's header, then what has come and what comes.

        Raises:
            OSError: the other side has gone.
        """
        send_all(self._stream, [header])
        self._thread.start()

    @property
    def dropped(self) -> int:
        """Frames dropped because the subscriber was too slow."""
        return self._queue.dropped

    def put(self, frame: Frame) -> None:
        """Send a frame some time soon."""
        self._queue.put(frame)

    def wait(self) -> None:
        """Return when the other side has closed the connection."""
        self._stream.settimeout(None)
        with contextlib.suppress(OSError):
            # A subscriber sends nothing behind its header.
            while self._stream.recv(1024):
                pass

    def close(self) -> None:
        """Send nothing more."""
        self._queue.close()
        with contextlib.suppress(OSError):
            self._stream.shutdown(socket.SHUT_RDWR)

    def _run(self) -> None:
        while (frame := self._queue.take()) is not None:
            try:
                send_all(self._stream, frame)
            except OSError:
                # `wait` notices that the other side has gone.
                self._queue.close()
                return
            self.sent += 1
            self.sent_bytes += frame.size
