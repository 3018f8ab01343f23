"""The `launch_testing` package of ROS 2: unit tests beside and after a launch.

User code imports it as ``launch_testing`` (`gazelle.compat.modules`).
"""

from __future__ import annotations

from gazelle.launch.ros2.launch_testing import actions, asserts, event_handlers, markers, tools
from gazelle.launch.ros2.launch_testing.markers import (
    parametrize,
    post_shutdown_test,
    ready_to_test_action_timeout,
)
from gazelle.launch.ros2.launch_testing.process_handlers import (
    ActiveIoHandler,
    ActiveProcInfoHandler,
    IoHandler,
    ProcInfoHandler,
)
from gazelle.launch.ros2.launch_testing.ready_aggregator import ReadyAggregator

__all__ = [
    "ActiveIoHandler",
    "ActiveProcInfoHandler",
    "IoHandler",
    "ProcInfoHandler",
    "ReadyAggregator",
    "actions",
    "asserts",
    "event_handlers",
    "markers",
    "parametrize",
    "post_shutdown_test",
    "ready_to_test_action_timeout",
    "tools",
]
