"""launch_ros.ros_adapters: rclpy in a launch."""

from __future__ import annotations

import os
import threading
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from gazelle.compat import rclpy
from gazelle.compat.rclpy.context import Context
from gazelle.compat.rclpy.executors import SingleThreadedExecutor
from gazelle.launch.ros2.event_handlers import OnShutdown

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["ROSAdapter", "get_ros_adapter", "get_ros_node"]

_ADAPTER = "ros_adapter"
_SPIN_S = 0.2


class ROSAdapter:
    """A node of rclpy in a thread that spins it.

    Attributes:
        argv: words for rclpy.
        ros_context: its context.
        ros_node: the node.
        ros_executor: what spins it.
    """

    def __init__(self, *, argv: Sequence[str] | None = None, autostart: bool = True) -> None:
        self.argv = argv
        self.ros_context: Any = None
        self.ros_node: Any = None
        self.ros_executor: Any = None
        self._thread: threading.Thread | None = None
        self._ended = threading.Event()
        if autostart:
            self.start()

    def start(self) -> None:
        """Begin to spin.

        Raises:
            RuntimeError: it spins already.
        """
        if self._thread is not None:
            raise RuntimeError("Cannot start a ROS adapter that is already running")
        self._ended.clear()
        self.ros_context = Context()
        rclpy.init(args=self.argv, context=self.ros_context)
        name = f"launch_ros_{os.getpid()}"
        self.ros_node = rclpy.create_node(name, context=self.ros_context)
        self.ros_executor = SingleThreadedExecutor(context=self.ros_context)
        self.ros_executor.add_node(self.ros_node)
        self._thread = threading.Thread(target=self._spin, daemon=True)
        self._thread.start()

    def shutdown(self) -> None:
        """End spinning and the node.

        Raises:
            RuntimeError: it does not spin.
        """
        if self._thread is None:
            raise RuntimeError("Cannot shutdown a ROS adapter that is not running")
        self._ended.set()
        self._thread.join()
        self._thread = None
        self.ros_executor.remove_node(self.ros_node)
        self.ros_node.destroy_node()
        rclpy.shutdown(context=self.ros_context)

    def _spin(self) -> None:
        while not self._ended.is_set():
            self.ros_executor.spin_once(timeout_sec=_SPIN_S)


def get_ros_adapter(context: LaunchContext) -> ROSAdapter:
    """Return the adapter of a launch, made when it is first asked for; it ends with the launch."""
    adapter: ROSAdapter | None = context.get_locals_as_dict().get(_ADAPTER)
    if adapter is None:
        made = adapter = ROSAdapter()
        context.extend_globals({_ADAPTER: adapter})
        context.register_event_handler(OnShutdown(on_shutdown=lambda *_: made.shutdown()))
    return adapter


def get_ros_node(context: LaunchContext) -> Any:
    """Return the node of a launch's adapter."""
    return get_ros_adapter(context).ros_node
