"""Sending transforms."""

from __future__ import annotations

import threading
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from gazelle.graph.tf.buffer import StampedPose, TransformBuffer
from gazelle.graph.type_support import resolve_type
from gazelle.interfaces.poses import pose_of_transform, set_transform
from gazelle.interfaces.stamps import ns_of, set_header

if TYPE_CHECKING:
    from gazelle.graph.key_expressions import Qos
    from gazelle.graph.node import Node
    from gazelle.graph.subscription import MessageInfo

__all__ = ["StaticTransformBroadcaster", "TransformBroadcaster", "TransformListener", "to_message"]


_TYPE = "tf2_msgs/msg/TFMessage"


class TransformListener:
    """Puts what is published on ``/tf`` and ``/tf_static`` into a buffer.

    Moving frames are forgotten when simulated time goes backwards.
    """

    def __init__(
        self,
        buffer: TransformBuffer,
        node: Node,
        *,
        moving: str = "/tf",
        static: str = "/tf_static",
    ) -> None:
        """Start to listen.

        Args:
            buffer: is filled.
            node: the node that subscribes.
            moving: topic of frames that move.
            static: topic of frames that do not.
        """
        self.buffer = buffer
        message_class = resolve_type(_TYPE)
        self._subscriptions = [
            node.create_subscription(topic, message_class, callback, queue_size=100, with_info=True)
            for topic, callback in ((moving, self._on_moving), (static, self._on_static))
        ]
        node.clock.on_jump(self._on_jump)

    def close(self) -> None:
        """Listen no more; calling it twice does nothing."""
        for one in self._subscriptions:
            one.unregister()

    def _on_jump(self, _delta_ns: int) -> None:
        self.buffer.clear()

    def _on_moving(self, message: Any, info: MessageInfo) -> None:
        self._store(message, info, is_static=False)

    def _on_static(self, message: Any, info: MessageInfo) -> None:
        self._store(message, info, is_static=True)

    def _store(self, message: Any, info: MessageInfo, *, is_static: bool) -> None:
        authority = info.publisher or "unknown_publisher"
        for one in message.transforms:
            self.buffer.set_transform(
                one.header.frame_id,
                one.child_frame_id,
                ns_of(one.header.stamp),
                pose_of_transform(one.transform),
                authority=authority,
                is_static=is_static,
            )


class TransformBroadcaster:
    """Publishes moving frames on ``/tf``."""

    def __init__(self, node: Node, *, queue_size: int = 100, qos: Qos | None = None) -> None:
        """Offer ``/tf``.

        Args:
            node: the node that publishes.
            queue_size: told to others.
            qos: likewise, in place of the queue's size.
        """
        self._message_class = resolve_type(_TYPE)
        self._publisher = node.create_publisher(
            "/tf", self._message_class, queue_size=queue_size, qos=qos
        )

    def send(self, transforms: StampedPose | Iterable[Any] | Any) -> None:
        """Send one or several transforms: `StampedPose` or ``geometry_msgs/TransformStamped``."""
        messages = [to_message(one) for one in _as_list(transforms)]
        self._publisher.publish(self._message_class(transforms=messages))

    def close(self) -> None:
        """Offer ``/tf`` no more."""
        self._publisher.unregister()


class StaticTransformBroadcaster:
    """Publishes frames that never move on ``/tf_static``.

    Late listeners get one message with all frames this broadcaster ever sent, the last one of
    each child frame.
    """

    def __init__(self, node: Node) -> None:
        """Offer ``/tf_static``, latched."""
        self._message_class = resolve_type(_TYPE)
        self._publisher = node.create_publisher(
            "/tf_static", self._message_class, latch=True, queue_size=1
        )
        self._sent: dict[str, Any] = {}
        self._lock = threading.Lock()

    def send(self, transforms: StampedPose | Iterable[Any] | Any) -> None:
        """Send one or several transforms: `StampedPose` or ``geometry_msgs/TransformStamped``."""
        messages = [to_message(one) for one in _as_list(transforms)]
        with self._lock:
            self._sent |= {one.child_frame_id: one for one in messages}
            self._publisher.publish(self._message_class(transforms=list(self._sent.values())))

    def close(self) -> None:
        """Offer ``/tf_static`` no more."""
        self._publisher.unregister()


def to_message(transform: Any) -> Any:
    """Return a ``geometry_msgs/msg/TransformStamped``; one of ROS 1 is translated."""
    from gazelle.graph.type_support import convert

    wanted = resolve_type("geometry_msgs/msg/TransformStamped")
    if not isinstance(transform, StampedPose):
        return convert(transform, wanted)
    message = wanted()
    set_header(message, transform.stamp_ns, transform.frame_id)
    message.child_frame_id = transform.child_frame_id
    set_transform(message.transform, transform.pose)
    return message


def _as_list(transforms: Any) -> list[Any]:
    if isinstance(transforms, StampedPose) or hasattr(transforms, "child_frame_id"):
        return [transforms]
    return list(transforms)
