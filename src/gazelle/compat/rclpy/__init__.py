"""What `rclpy` is in Gazelle: the same names, on Gazelle's graph.

The module that users import, ``rclpy``, lies in ``compat/modules`` and re-exports this one.
Behaviour as in https://github.com/ros2/rclpy.
"""

from __future__ import annotations

from gazelle.compat.rclpy.context import Context, get_default_context
from gazelle.compat.rclpy.init_shutdown import (
    InitContextManager,
    SignalHandlerOptions,
    create_node,
    get_global_executor,
    init,
    ok,
    shutdown,
    spin,
    spin_once,
    spin_until_future_complete,
    try_shutdown,
)
from gazelle.compat.rclpy.parameter import Parameter
from gazelle.compat.rclpy.task import Future

__all__ = [
    "Context",
    "Future",
    "InitContextManager",
    "Parameter",
    "SignalHandlerOptions",
    "create_node",
    "get_default_context",
    "get_global_executor",
    "init",
    "ok",
    "shutdown",
    "spin",
    "spin_once",
    "spin_until_future_complete",
    "try_shutdown",
]
