"""What comes from the other half."""

from __future__ import annotations

import traceback
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
            try:
                self._handle(self._waiting.popleft())
            except Exception:  # noqa: BLE001 - told; one bad frame must not end the process
                traceback.print_exc()

    def _handle(self, frame: Frame) -> None:
        kind, channel, number, data = frame
        if kind == FrameKind.CONTROL:
            self._endpoints.obey(frame.control())
        elif kind == FrameKind.REQUEST:
            self._endpoints.call(channel, number, data)
        else:
            self._endpoints.answer(channel, number, None if kind == FrameKind.FAILURE else data)
