"""Filling a buffer from ``/tf`` and ``/tf_static``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.graph.tf.buffer import TransformBuffer
from gazelle.graph.wire import resolve_type
from gazelle.interfaces.poses import pose_of_transform
from gazelle.interfaces.stamps import ns_of

if TYPE_CHECKING:
    from gazelle.graph.node import Node
    from gazelle.graph.subscription import MessageInfo

__all__ = ["TransformListener"]

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
