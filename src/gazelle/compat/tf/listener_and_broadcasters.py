"""tf2_ros's listener and broadcasters, for rospy and for rclpy."""

from __future__ import annotations

from typing import Any

from gazelle.compat.rospy.state import STATE
from gazelle.compat.tf.buffer import Buffer
from gazelle.compat.warn_once import warn_once
from gazelle.graph import Node, Qos
from gazelle.graph import tf as graph_tf

__all__ = [
    "DEFAULT_STATIC_TF_TOPIC",
    "DEFAULT_TF_TOPIC",
    "StaticTransformBroadcaster",
    "TransformBroadcaster",
    "TransformListener",
]

DEFAULT_TF_TOPIC = "/tf"
DEFAULT_STATIC_TF_TOPIC = "/tf_static"


class TransformListener:
    """Fills a buffer from ``/tf`` and ``/tf_static``, whether the node spins or not.

    Args:
        buffer: is filled.
        node: of rclpy. In rospy programs this place is ``queue_size``.
        buff_size, tcp_nodelay, queue_size: of rospy; without effect, for frames are taken as they
            come.
        spin_thread: of rclpy; without effect, for frames come in a thread of their own.
        qos, static_qos: of rclpy; without effect, for this graph connects ends of any quality and
            every frame that reaches the process is taken.
        tf_topic, tf_static_topic: of rclpy: where frames come from.
    """

    def __init__(  # noqa: PLR0913 - tf2_ros's signature, in both versions
        self,
        buffer: Buffer,
        node: Any = None,
        buff_size: int = 65536,
        tcp_nodelay: bool = False,
        *,
        queue_size: int | None = None,
        spin_thread: bool = False,
        qos: Any = None,
        static_qos: Any = None,
        tf_topic: str = DEFAULT_TF_TOPIC,
        tf_static_topic: str = DEFAULT_STATIC_TF_TOPIC,
    ) -> None:
        self.buffer = buffer
        if hasattr(node, "graph_node"):
            buffer.use_node(node)
        self._listener = graph_tf.TransformListener(
            buffer.core,
            _graph_node(node, "TransformListener"),
            moving=tf_topic,
            static=tf_static_topic,
        )

    def unregister(self) -> None:
        """Stop listening."""
        self._listener.close()


class TransformBroadcaster:
    """Sends moving frames.

    Args:
        node: of rclpy; rospy programs give none.
        qos: of rclpy: a profile or a depth, which others are told.
    """

    def __init__(self, node: Any = None, qos: Any = None) -> None:
        owner = _graph_node(node, "TransformBroadcaster")
        self._core = graph_tf.TransformBroadcaster(owner, qos=_announced_qos(qos))

    def sendTransform(self, transform: Any) -> None:
        """Send one ``TransformStamped`` or a list of them."""
        self._core.send(transform)


class StaticTransformBroadcaster:
    """Sends frames that never move; late listeners get them all.

    Args:
        node: of rclpy; rospy programs give none.
        qos: of rclpy; told once where it would keep frames from late listeners.
    """

    def __init__(self, node: Any = None, qos: Any = None) -> None:
        wanted = _announced_qos(qos)
        if wanted is not None and not wanted.latched:
            warn_once("StaticTransformBroadcaster: late listeners get its frames whatever the QoS")
        self._core = graph_tf.StaticTransformBroadcaster(
            _graph_node(node, "StaticTransformBroadcaster")
        )

    def sendTransform(self, transform: Any) -> None:
        """Send one ``TransformStamped`` or a list of them."""
        self._core.send(transform)


def _announced_qos(qos: Any) -> Qos | None:
    """Return what others are told of rclpy's QoS, None for the usual."""
    if qos is None:
        return None
    from gazelle.compat.rclpy.qos import announced_qos, as_profile

    return announced_qos(as_profile(qos))


def _graph_node(node: Any, who: str) -> Node:
    if hasattr(node, "graph_node"):
        found: Node = node.graph_node
        return found
    return STATE.require(who)
