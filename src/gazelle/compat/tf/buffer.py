"""tf2_ros's buffer, for rospy and for rclpy."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any
from weakref import WeakSet

from gazelle.compat.rclpy.task import Future
from gazelle.compat.rospy.state import STATE
from gazelle.compat.tf.buffer_interface import BufferInterface
from gazelle.compat.tf.conversions import nanoseconds, ros_version, stamped, time_of
from gazelle.compat.tf.exceptions import TransformException, as_tf2_error
from gazelle.graph import Node
from gazelle.graph import tf as graph_tf
from gazelle.interfaces import ros1_service_type, service_type
from gazelle.interfaces.poses import pose_of_transform

__all__ = ["Buffer"]

_SLICE_S = 0.1
# Nodes whose service tells frames.
_ASKED: WeakSet[Node] = WeakSet()


class Buffer(BufferInterface):
    """Keeps transforms of the last ten seconds.

    Args:
        cache_time: how far back, a Duration.
        node: of rclpy; its transforms take the form of ROS 2. In rospy programs this place is
            ``debug``.
        debug: offer rospy's node's service ``~tf2_frames``; rclpy's node offers ``tf2_frames``.
    """

    def __init__(self, cache_time: Any = None, node: Any = None, debug: bool = True) -> None:
        super().__init__()
        self._node = node if hasattr(node, "graph_node") else None
        cache_ns = nanoseconds(cache_time) if cache_time is not None else 10_000_000_000
        self.core = graph_tf.TransformBuffer(cache_ns, on_warning=self._warn)
        if self._node is not None:
            kind = service_type("tf2_msgs/srv/FrameGraph")
            self._offer_frames(self._node.graph_node, "tf2_frames", kind)
        elif debug and node is not False and STATE.node is not None:
            self._offer_frames(STATE.node, "~tf2_frames", ros1_service_type("tf2_msgs/FrameGraph"))

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = 0
    ) -> Any:
        """Return the ``TransformStamped`` that takes source coordinates to the target frame.

        Args:
            target_frame: frame to express things in.
            source_frame: frame they are given in.
            time: when; `rospy.Time(0)` for the latest.
            timeout: how long to wait for it.

        Raises:
            LookupException, ConnectivityException, ExtrapolationException,
            InvalidArgumentException: it is not known.
        """
        try:
            found = self.core.lookup_transform(
                target_frame,
                source_frame,
                nanoseconds(time),
                timeout_s=nanoseconds(timeout) / 1e9,
            )
        except graph_tf.TransformError as error:
            raise as_tf2_error(error) from None
        return stamped(found, ros_version(self._node))

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = 0,
    ) -> Any:
        """Return a transform between two times by way of a fixed frame.

        Raises:
            TransformException: it is not known.
        """
        try:
            found = self.core.lookup_transform_full(
                target_frame,
                nanoseconds(target_time),
                source_frame,
                nanoseconds(source_time),
                fixed_frame,
                timeout_s=nanoseconds(timeout) / 1e9,
            )
        except graph_tf.TransformError as error:
            raise as_tf2_error(error) from None
        return stamped(found, ros_version(self._node))

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Any,
        timeout: Any = 0,
        return_debug_tuple: bool = False,
    ) -> Any:
        """Return whether a transform is known, with the reason if asked for."""
        reason = self.core.why_not(
            target_frame, source_frame, nanoseconds(time), timeout_s=nanoseconds(timeout) / 1e9
        )
        return (not reason, reason) if return_debug_tuple else not reason

    # rclpy's awaitable twins.

    def wait_for_transform_async(self, target_frame: str, source_frame: str, time: Any) -> Future:
        """Return a future that is done with True once a transform is known."""
        return self._wait(lambda: self.can_transform(target_frame, source_frame, time))

    def wait_for_transform_full_async(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
    ) -> Future:
        """Return a future that is done with True once a transform between times is known."""
        times = (target_time, source_frame, source_time, fixed_frame)
        return self._wait(lambda: self.can_transform_full(target_frame, *times))

    async def lookup_transform_async(self, target_frame: str, source_frame: str, time: Any) -> Any:
        """Return a transform as soon as it is known."""
        await self.wait_for_transform_async(target_frame, source_frame, time)
        return self.lookup_transform(target_frame, source_frame, time)

    async def lookup_transform_full_async(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
    ) -> Any:
        """Return a transform between two times as soon as it is known."""
        times = (target_time, source_frame, source_time, fixed_frame)
        await self.wait_for_transform_full_async(target_frame, *times)
        return self.lookup_transform_full(target_frame, *times)

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = 0,
        return_debug_tuple: bool = False,
    ) -> Any:
        """Return whether a transform between two times is known, with the reason if asked for."""
        times = (target_time, source_frame, source_time, fixed_frame)
        reason = ""
        try:
            self.lookup_transform_full(target_frame, *times, timeout)
        except TransformException as error:
            reason = str(error)
        return (not reason, reason) if return_debug_tuple else not reason

    def use_node(self, node: Any) -> None:
        """Belong to a node of rclpy from now on: a listener's."""
        self._node = self._node or node

    def set_transform(self, transform: Any, authority: str) -> None:
        """Add a ``TransformStamped``."""
        self._set(transform, authority, is_static=False)

    def set_transform_static(self, transform: Any, authority: str) -> None:
        """Add a ``TransformStamped`` that never changes."""
        self._set(transform, authority, is_static=True)

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Any:
        """Return the latest time that all frames in between know.

        Raises:
            TransformException: there is no way from one to the other.
        """
        try:
            stamp_ns = self.core.latest_common_time_ns(target_frame, source_frame)
        except graph_tf.TransformError as error:
            raise as_tf2_error(error) from None
        return time_of(stamp_ns, ros_version(self._node))

    def all_frames_as_yaml(self) -> str:
        """Return all frames as YAML."""
        return graph_tf.frames_as_yaml(self.core)

    def all_frames_as_string(self) -> str:
        """Return all frames as sentences."""
        return graph_tf.frames_as_string(self.core)

    def clear(self) -> None:
        """Forget all moving frames."""
        self.core.clear()

    def _set(self, transform: Any, authority: str, *, is_static: bool) -> None:
        self.core.set_transform(
            transform.header.frame_id,
            transform.child_frame_id,
            nanoseconds(transform.header.stamp),
            pose_of_transform(transform.transform),
            authority=authority,
            is_static=is_static,
        )

    def _wait(self, is_there: Callable[[], bool]) -> Future:
        future = Future(executor=getattr(self._node, "executor", None))
        if is_there():
            future.set_result(True)
            return future
        threading.Thread(
            target=self._watch, args=(is_there, future), name="tf wait", daemon=True
        ).start()
        return future

    def _watch(self, is_there: Callable[[], bool], future: Future) -> None:
        while not future.cancelled() and not getattr(self._node, "is_destroyed", False):
            self.core.wait_for_change(_SLICE_S)
            if is_there():
                future.set_result(True)
                return

    def _offer_frames(self, owner: Node, name: str, kind: Any) -> None:
        """Answer with all frames; as in tf2_ros the first buffer of a node does."""
        if owner in _ASKED:
            return
        _ASKED.add(owner)

        def answer(_request: object) -> Any:
            response = (kind.Response if hasattr(kind, "Response") else kind._response_class)()
            response.frame_yaml = self.all_frames_as_yaml()
            return response

        owner.create_service(name, kind, answer)

    def _warn(self, text: str) -> None:
        if self._node is not None:
            self._node.get_logger().warning(text)
        elif STATE.node is not None:
            STATE.node.log("warn", text, padded=False)
