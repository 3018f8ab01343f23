"""What comes from the other half."""

from __future__ import annotations

from collections import deque
from typing import Any

from .endpoints import Endpoints
from .frames import Frame, FrameKind, Pipes

__all__ = ["Inbox"]


class Inbox:
    """Reads frames: messages are published at once, all else waits for the executor's thread."""

    def __init__(self, pipes: Pipes, node: Any, endpoints: Endpoints) -> None:
        """Read nothing yet."""
        self._pipes = pipes
        self._endpoints = endpoints
        self._waiting: deque[Frame] = deque()
        self._guard = node.create_guard_condition(self._work_off)

    def run(self) -> None:
        """Read until the other half has gone.

        Raises:
            EOFError: it has.
        """
        while True:
            frame = self._pipes.receive()
            if frame.kind == FrameKind.MESSAGE:
                self._endpoints.publish(frame.channel, frame.data)
            else:
                self._waiting.append(frame)
                self._guard.trigger()

    def _work_off(self) -> None:
        while self._waiting:
            frame = self._waiting.popleft()
            if frame.kind == FrameKind.CONTROL:
                self._endpoints.obey(frame.control())
            elif frame.kind == FrameKind.REQUEST:
                self._endpoints.call(frame.channel, frame.number, frame.data)
            else:
                is_failure = frame.kind == FrameKind.FAILURE
                self._endpoints.answer(
                    frame.channel, frame.number, None if is_failure else frame.data
                )
