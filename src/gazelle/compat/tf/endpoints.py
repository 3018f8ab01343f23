"""tf2_ros's listener and broadcasters, for rospy and for rclpy."""

from __future__ import annotations

from typing import Any

from gazelle.compat.rospy.state import STATE
from gazelle.compat.tf.buffer import Buffer
from gazelle.graph import Node
from gazelle.graph import tf as graph_tf

__all__ = ["StaticTransformBroadcaster", "TransformBroadcaster", "TransformListener"]


class TransformListener:
    """Fills a buffer from ``/tf`` and ``/tf_static``, whether the node spins or not.

    Args:
        buffer: is filled.
        node: of rclpy. In rospy programs this place is ``queue_size``.
        options: ``spin_thread``, ``qos``, ``static_qos`` of rclpy, ``queue_size``, ``buff_size``,
            ``tcp_nodelay`` of rospy: nothing here depends on them.
    """

    def __init__(self, buffer: Buffer, node: Any = None, *_more: Any, **_options: Any) -> None:
        self.buffer = buffer
        if hasattr(node, "graph_node"):
            buffer.use_node(node)
        self._listener = graph_tf.TransformListener(buffer.core, _node(node, "TransformListener"))

    def unregister(self) -> None:
        """Stop listening."""
        self._listener.close()


class TransformBroadcaster:
    """Sends moving frames.

    Args:
        node: of rclpy; rospy programs give none.
    """

    def __init__(self, node: Any = None, qos: Any = None) -> None:
        del qos
        self._core = graph_tf.TransformBroadcaster(_node(node, "TransformBroadcaster"))

    def sendTransform(self, transform: Any) -> None:
        """Send one ``TransformStamped`` or a list of them."""
        self._core.send(transform)


class StaticTransformBroadcaster:
    """Sends frames that never move; late listeners get them all.

    Args:
        node: of rclpy; rospy programs give none.
    """

    def __init__(self, node: Any = None, qos: Any = None) -> None:
        del qos
        self._core = graph_tf.StaticTransformBroadcaster(_node(node, "StaticTransformBroadcaster"))

    def sendTransform(self, transform: Any) -> None:
        """Send one ``TransformStamped`` or a list of them."""
        self._core.send(transform)


def _node(node: Any, who: str) -> Node:
    if hasattr(node, "graph_node"):
        found: Node = node.graph_node
        return found
    return STATE.require(who)
