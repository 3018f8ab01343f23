"""rclpy's functions: init, spin and shutdown."""

from __future__ import annotations

import enum
from collections.abc import Sequence
from typing import Any

from gazelle.compat.rclpy.context import Context, get_default_context, handle_signals
from gazelle.compat.rclpy.executors import Executor, SingleThreadedExecutor
from gazelle.compat.rclpy.node import Node
from gazelle.compat.rclpy.task import Future

__all__ = [
    "InitContextManager",
    "SignalHandlerOptions",
    "create_node",
    "get_global_executor",
    "init",
    "ok",
    "shutdown",
    "spin",
    "spin_once",
    "spin_until_future_complete",
    "try_shutdown",
]


class SignalHandlerOptions(enum.IntEnum):
    """Which signals shut the default context down."""

    NO = 0
    SIGINT = 1
    SIGTERM = 2
    ALL = 3


class InitContextManager:
    """What `init` returns: ``with rclpy.init(): …`` shuts down at the end."""

    def __init__(self, context: Context) -> None:
        self.context = context

    def __enter__(self) -> InitContextManager:
        return self

    def __exit__(self, *exc_info: object) -> None:
        self.context.shutdown()


_executors: list[Executor] = []


def init(
    *,
    args: Sequence[str] | None = None,
    context: Context | None = None,
    domain_id: int | None = None,
    signal_handler_options: SignalHandlerOptions | None = None,
) -> InitContextManager:
    """Join the graph; SIGINT and SIGTERM then end spinning.

    Raises:
        RuntimeError: it was called before.
        GraphError: one of the arguments after ``--ros-args`` is not understood.
    """
    used = context or get_default_context()
    used.init(args, domain_id=domain_id)
    if signal_handler_options is not SignalHandlerOptions.NO and context is None:
        handle_signals()
    return InitContextManager(used)


def ok(*, context: Context | None = None) -> bool:
    """Tell whether `init` was called and no shutdown since."""
    return (context or get_default_context()).ok()


def shutdown(*, context: Context | None = None, uninstall_handlers: bool | None = None) -> None:
    """Leave the graph. After a signal this ends what the signal began.

    Args:
        context: the default one when None.
        uninstall_handlers: without effect: they pass signals on to what was there before, and do
            nothing else once the context is shut down.
    """
    (context or get_default_context()).shutdown()
    if context is None:
        _executors.clear()


try_shutdown = shutdown


def get_global_executor() -> Executor:
    """Return the executor that `spin` uses where none is named."""
    if not _executors:
        _executors.append(SingleThreadedExecutor())
    return _executors[0]


def create_node(node_name: str, **options: Any) -> Node:
    """Make a node; see `Node`."""
    return Node(node_name, **options)


def spin_once(
    node: Node, *, executor: Executor | None = None, timeout_sec: float | None = None
) -> None:
    """Run one callback of a node, waiting for it as long as told."""
    used = executor or get_global_executor()
    try:
        used.add_node(node)
        used.spin_once(timeout_sec=timeout_sec)
    finally:
        used.remove_node(node)


def spin(node: Node, executor: Executor | None = None) -> None:
    """Run the callbacks of a node until the shutdown."""
    used = executor or get_global_executor()
    try:
        used.add_node(node)
        while used.context.ok():
            used.spin_once()
    finally:
        used.remove_node(node)


def spin_until_future_complete(
    node: Node,
    future: Future,
    executor: Executor | None = None,
    timeout_sec: float | None = None,
) -> None:
    """Run the callbacks of a node until a future is done, or time is up."""
    used = executor or get_global_executor()
    try:
        used.add_node(node)
        used.spin_until_future_complete(future, timeout_sec)
    finally:
        used.remove_node(node)
