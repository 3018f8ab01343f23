"""What an action's client hears, handled in one order: no result overtakes the feedback before."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.graph.callback_queue import CallbackQueue
from gazelle.graph.subscription import MAX_WAITING, Backlog

if TYPE_CHECKING:
    from gazelle.graph.node import Node

__all__ = ["ClientEvents"]


class ClientEvents:
    """One queue for all that comes, with a thread of its own.

    What is told once, such as a result, is never dropped. Feedback and status come all the time:
    while a callback does not end, the newest of each topic are kept, see
    `Backlog`.
    """

    def __init__(self, node: Node, name: str) -> None:
        """Start empty.

        Args:
            node: told what a user's callback raises, and that messages are dropped.
            name: of the action.
        """
        self._node = node
        self._name = name
        self._callback_queue = CallbackQueue(self._take, size=0, name=f"action {name}")

    def put(self, work: Callable[[], None]) -> None:
        """Have something done behind what came before it."""
        self._callback_queue.put(work)

    def topic(self, name: str, callback: Callable[[Any], None]) -> Callable[[Any], None]:
        """Return what takes the messages of a topic, from any thread.

        Args:
            name: of the topic, for messages.
            callback: called with each message, in the queue's thread.
        """

        def overflowed() -> None:
            self._node.log(
                "warn",
                f"a callback of the action {self._name} is slower than {name}: {MAX_WAITING} "
                "messages wait, and the oldest are dropped from now on",
            )

        return Backlog(self._callback_queue.put, callback, overflowed).put

    def close(self) -> None:
        """Handle nothing more."""
        self._callback_queue.close()

    def _take(self, work: Callable[[], None]) -> None:
        try:
            work()
        except Exception:  # noqa: BLE001 - a user's callback may raise anything
            self._node.log("error", f"bad callback: {traceback.format_exc().rstrip()}")
