"""``flat_world_imu_node``: an IMU as on flat ground (``imu_in`` to ``imu_out``).

The accelerations become 0, 0 and 9.8 m/s²; messages that are not newer than the last are left
out. It serves cartographer, which needs gravity (turtlebot3_slam, noetic).
"""

from __future__ import annotations

import threading
from copy import deepcopy
from typing import Any

from gazelle.graph import Graph
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import start_node

__all__ = ["Flattener", "run"]

_GRAVITY_M_S2 = 9.8


class Flattener:
    """Makes flat measurements, each newer than the one before."""

    def __init__(self) -> None:
        """Take any first message."""
        self._last = (0, 0)

    def flat(self, imu: Any) -> Any | None:
        """Return the message as it goes on, None when it is left out."""
        stamp = (imu.header.stamp.sec, imu.header.stamp.nanosec)
        if self._last != (0, 0) and stamp <= self._last:
            return None
        self._last = stamp
        flat = deepcopy(imu)
        acceleration = flat.linear_acceleration
        acceleration.x, acceleration.y, acceleration.z = 0.0, 0.0, _GRAVITY_M_S2
        return flat


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Pass measurements on until told to stop."""
    node = start_node(arguments, graph)
    kind: Any = message_type("sensor_msgs/msg/Imu")
    out, flattener = node.create_publisher("imu_out", kind, queue_size=10), Flattener()

    def on_imu(imu: Any) -> None:
        flat = flattener.flat(imu)
        if flat is not None:
            out.publish(flat)

    node.create_subscription("imu_in", kind, on_imu, queue_size=150)
    stop.wait()
    node.shutdown()
    return 0
