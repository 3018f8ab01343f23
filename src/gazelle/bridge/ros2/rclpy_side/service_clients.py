"""Calls of ROS's services on behalf of the graph, and classes of ROS's types by name."""

from __future__ import annotations

import time
from importlib import import_module
from typing import Any, NamedTuple

from .pipes import FrameKind, Pipes

__all__ = ["Calls", "MissingTypeError", "class_of"]

_PATIENCE_S = 5.0
_RETRY_S = 0.02
_OF_ACTIONS = {
    "SendGoal": "SendGoalService",
    "GetResult": "GetResultService",
    "FeedbackMessage": "FeedbackMessage",
}


class MissingTypeError(Exception):
    """ROS's Python has no such type."""


class _Call(NamedTuple):
    channel: int
    number: int
    data: bytes
    due_s: float


class Calls:
    """Clients and the calls that wait for their server; used from the executor's thread."""

    def __init__(self, pipes: Pipes, node: Any) -> None:
        """Have no client yet."""
        self._pipes = pipes
        self._clients: dict[int, Any] = {}
        self._waiting: list[_Call] = []
        self._timer = node.create_timer(_RETRY_S, self._try_again)
        self._timer.cancel()
        serialization = import_module("rclpy.serialization")
        self._serialize = serialization.serialize_message
        self._deserialize = serialization.deserialize_message

    def add(self, channel: int, client: Any) -> None:
        """Use a client for the calls of a channel."""
        self._clients[channel] = client

    def remove(self, channel: int) -> None:
        """Call no more over a channel; calls without an answer fail."""
        self._clients.pop(channel, None)

    def call(self, channel: int, number: int, data: bytes) -> None:
        """Send a request as soon as the server is known, which takes a moment at first."""
        call = _Call(channel, number, data, time.monotonic() + _PATIENCE_S)
        if not self._sent(call):
            self._waiting.append(call)
            self._timer.reset()

    def _try_again(self) -> None:
        self._waiting = [call for call in self._waiting if not self._sent(call)]
        if not self._waiting:
            self._timer.cancel()

    def _sent(self, call: _Call) -> bool:
        """Send a call or give it up; False while it has to wait."""
        client = self._clients.get(call.channel)
        if client is None or time.monotonic() > call.due_s:
            self._fail(call, "nobody answers it in ROS 2")
            return True
        if not client.service_is_ready():
            return False
        request = self._deserialize(call.data, client.srv_type.Request)
        client.call_async(request).add_done_callback(lambda future: self._answer(call, future))
        return True

    def _answer(self, call: _Call, future: Any) -> None:
        error = future.exception()
        if error is not None:
            self._fail(call, str(error))
            return
        data = self._serialize(future.result())
        self._pipes.send(FrameKind.RESPONSE, call.channel, call.number, data)

    def _fail(self, call: _Call, reason: str) -> None:
        self._pipes.send(FrameKind.FAILURE, call.channel, call.number, reason.encode())


def class_of(name: str) -> Any:
    """Return the class of ``pkg/msg/Name``, ``pkg/srv/Name`` or a piece of an action.

    The pieces are ``pkg/action/Name_SendGoal``, ``…_GetResult`` and ``…_FeedbackMessage``.

    Raises:
        MissingTypeError: it cannot be imported.
    """
    try:
        package, part, bare = name.split("/")
        module = import_module(f"{package}.{part}")
        if part != "action":
            return getattr(module, bare)
        action, _, piece = bare.rpartition("_")
        return getattr(getattr(module, action).Impl, _OF_ACTIONS[piece])
    except (ImportError, AttributeError, ValueError, KeyError) as error:
        raise MissingTypeError(f"{type(error).__name__}: {error}") from error
