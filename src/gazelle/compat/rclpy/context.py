"""The context: a process' membership in the graph (rclpy.context, rclpy.utilities)."""

from __future__ import annotations

import _thread
import signal
import sys
import threading
from collections.abc import Callable, Sequence
from types import FrameType
from typing import Any

from gazelle.compat.rclpy.exceptions import NotInitializedException
from gazelle.graph import Graph
from gazelle.graph.ros2_arguments import RosArguments, parse_ros_arguments

__all__ = ["Context", "get_default_context", "handle_signals"]


class Context:
    """Joins the graph with `init` and leaves it with `shutdown`."""

    def __init__(self) -> None:
        self._graph: Graph | None = None
        self._lock = threading.RLock()
        self._ok = self._is_ending = False
        self._listeners: list[Callable[[], Any]] = []
        self._wakers: list[Callable[[], Any]] = []
        self.arguments = RosArguments()
        self.interrupted = False

    @property
    def graph(self) -> Graph:
        """The graph.

        Raises:
            NotInitializedException: `init` has not been called.
        """
        if self._graph is None:
            raise NotInitializedException
        return self._graph

    def init(self, args: Sequence[str] | None = None, *, domain_id: int | None = None) -> None:
        """Join the graph.

        Args:
            args: the program's arguments with ``--ros-args``, those of the process by default.
            domain_id: ``ROS_DOMAIN_ID`` by default.

        Raises:
            RuntimeError: it was called before.
            GraphError: an argument is not understood.
        """
        import os

        with self._lock:
            if self._ok:
                raise RuntimeError("Context.init() must only be called once")
            self.arguments = parse_ros_arguments(sys.argv if args is None else args)
            environ = dict(os.environ)
            if domain_id is not None:
                environ["ROS_DOMAIN_ID"] = str(domain_id)
            self._graph = Graph.open(environ=environ)
            self._ok, self._is_ending, self.interrupted = True, False, False

    def ok(self) -> bool:
        """Tell whether `init` was called and no shutdown since."""
        return self._ok

    def shutdown(self) -> None:
        """Leave the graph; nodes end with it. Twice does nothing."""
        self.invalidate()
        with self._lock:
            graph, self._graph = self._graph, None
        if graph is not None:
            graph.close()

    try_shutdown = shutdown

    def invalidate(self) -> None:
        """End spinning and sleeping, and leave the graph itself for later."""
        with self._lock:
            if not (self._ok or self._is_ending):
                return
            self._ok = self._is_ending = False
            listeners, self._listeners = self._listeners, []
        if self._graph is not None:
            self._graph.clock.close()
        for listener in listeners:
            listener()
        for wake in tuple(self._wakers):
            wake()

    def end_by_signal(self, number: int) -> None:
        """Be no longer `ok`, and end what waits: in a thread, as a handler may hold up locks."""
        self.interrupted = self.interrupted or number == signal.SIGINT
        if self._ok:
            self._ok, self._is_ending = False, True
            _thread.start_new_thread(self.invalidate, ())

    def on_shutdown(self, callback: Callable[[], Any]) -> None:
        """Call something once at the shutdown."""
        self._listeners.append(callback)

    def add_waker(self, wake: Callable[[], Any]) -> None:
        """Call something at every shutdown: an executor's wake."""
        self._wakers.append(wake)

    def get_domain_id(self) -> int:
        """Return ``ROS_DOMAIN_ID``."""
        return self.graph.domain

    def __enter__(self) -> Context:
        if not self._ok:
            self.init()
        return self

    def __exit__(self, *exc_info: object) -> None:
        self.shutdown()


_DEFAULT: list[Context] = []
_PREVIOUS: dict[int, Any] = {}


def get_default_context(*, shutting_down: bool = False) -> Context:
    """Return the context that is used where none is named.

    Args:
        shutting_down: give it up, so that the next call makes another one.
    """
    if not _DEFAULT:
        _DEFAULT.append(Context())
    return _DEFAULT.pop() if shutting_down else _DEFAULT[0]


def handle_signals() -> None:
    """Shut the default context down on SIGINT and SIGTERM; Python's own handlers go on."""
    if threading.current_thread() is not threading.main_thread():
        return
    for number in (signal.SIGINT, signal.SIGTERM):
        if number not in _PREVIOUS:
            _PREVIOUS[number] = signal.getsignal(number)
            signal.signal(number, _on_signal)


def _on_signal(number: int, frame: FrameType | None) -> None:
    get_default_context().end_by_signal(number)
    previous = _PREVIOUS.get(number)
    if callable(previous):
        previous(number, frame)
