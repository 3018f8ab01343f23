"""tf2_ros for rospy programs: Buffer, listeners, broadcasters and tf2's exceptions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

from gazelle.compat.rospy.rostime import Time
from gazelle.compat.rospy.state import STATE
from gazelle.geometry import Pose
from gazelle.graph import tf as graph_tf
from gazelle.interfaces import ros1_message_type

__all__ = [
    "Buffer",
    "BufferInterface",
    "ConnectivityException",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "StaticTransformBroadcaster",
    "TimeoutException",
    "TransformBroadcaster",
    "TransformException",
    "TransformListener",
    "TransformRegistration",
    "TypeException",
    "as_tf2_error",
    "nanoseconds",
    "pose_of",
    "stamped",
]


class TransformException(Exception):  # noqa: N818 - tf2's name
    """Base of tf2's exceptions."""


class ConnectivityException(TransformException):
    """There is no way from one frame to the other."""


class LookupException(TransformException):
    """A frame does not exist."""


class ExtrapolationException(TransformException):
    """The time is outside what is known."""


class InvalidArgumentException(TransformException):
    """A frame name is not legal."""


class TimeoutException(TransformException):
    """The transform did not come in time."""


class TypeException(Exception):  # noqa: N818 - tf2_ros's name
    """No function is registered that transforms objects of this class."""


_ERRORS: dict[type[Exception], type[TransformException]] = {
    graph_tf.UnknownFrameError: LookupException,
    graph_tf.ConnectivityError: ConnectivityException,
    graph_tf.ExtrapolationError: ExtrapolationException,
    graph_tf.InvalidFrameError: InvalidArgumentException,
}


def as_tf2_error(error: graph_tf.TransformError) -> TransformException:
    """Return tf2's exception for one of the graph's."""
    return _ERRORS.get(type(error), TransformException)(str(error))


def nanoseconds(value: Any) -> int:
    """Return a time or duration in nanoseconds: rospy's, genpy's or seconds."""
    return int(value.to_nsec()) if hasattr(value, "to_nsec") else int(float(value) * 1e9)


def stamped(found: graph_tf.StampedPose) -> Any:
    """Return a ``geometry_msgs/TransformStamped`` in the form of ROS 1."""
    message: Any = ros1_message_type("geometry_msgs/TransformStamped")()
    message.header.frame_id = found.frame_id
    message.header.stamp = Time(*divmod(found.stamp_ns, 1_000_000_000))
    message.child_frame_id = found.child_frame_id
    move, turn = message.transform.translation, message.transform.rotation
    move.x, move.y, move.z = found.pose.position_m
    turn.x, turn.y, turn.z, turn.w = found.pose.quat_xyzw
    return message


def pose_of(transform: Any) -> Pose:
    """Return the pose of a ``geometry_msgs/Transform``."""
    move, turn = transform.translation, transform.rotation
    return Pose((move.x, move.y, move.z), (turn.x, turn.y, turn.z, turn.w))


class TransformRegistration:
    """Functions that transform objects, by class; ``tf2_geometry_msgs`` adds its own."""

    _functions: ClassVar[dict[type, Callable[[Any, Any], Any]]] = {}

    def add(self, key: type, callback: Callable[[Any, Any], Any]) -> None:
        """Let `callback(object, transform)` transform objects of a class."""
        self._functions[key] = callback

    def get(self, key: type) -> Callable[[Any, Any], Any]:
        """Return the function of a class.

        Raises:
            TypeException: there is none.
        """
        if key not in self._functions:
            known = ", ".join(sorted(cls.__name__ for cls in self._functions)) or "none"
            raise TypeException(
                f"Type {key} is not loaded or supported (known: {known}); "
                "import tf2_geometry_msgs for geometry messages"
            )
        return self._functions[key]


class BufferInterface:
    """What every buffer can do with objects that have a header."""

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def transform(
        self, object_stamped: Any, target_frame: str, timeout: Any = 0, new_type: Any = None
    ) -> Any:
        """Return an object in another frame at its own time.

        Raises:
            TransformException: the transform is not known.
            TypeException: its class is not registered.
        """
        del new_type
        function = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform(target_frame, header.frame_id, header.stamp, timeout)
        return function(object_stamped, found)

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = 0
    ) -> Any:
        """Return a transform; every buffer has its own way."""
        raise TypeException("this buffer looks nothing up")


class Buffer(BufferInterface):
    """Keeps transforms of the last ten seconds.

    Args:
        cache_time: how far back, a Duration.
        debug: accepted; the service ``tf2_frames`` is not offered.
    """

    def __init__(self, cache_time: Any = None, debug: bool = True) -> None:
        super().__init__()
        del debug
        cache_ns = nanoseconds(cache_time) if cache_time is not None else 10_000_000_000
        self.core = graph_tf.TransformBuffer(cache_ns, on_warning=_warn)

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
        return stamped(found)

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
        return stamped(found)

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

    def set_transform(self, transform: Any, authority: str) -> None:
        """Add a ``TransformStamped``."""
        self._set(transform, authority, is_static=False)

    def set_transform_static(self, transform: Any, authority: str) -> None:
        """Add a ``TransformStamped`` that never changes."""
        self._set(transform, authority, is_static=True)

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Time:
        """Return the latest time that all frames in between know.

        Raises:
            TransformException: there is no way from one to the other.
        """
        try:
            stamp_ns = self.core.latest_common_time_ns(target_frame, source_frame)
        except graph_tf.TransformError as error:
            raise as_tf2_error(error) from None
        return Time(*divmod(stamp_ns, 1_000_000_000))

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
            pose_of(transform.transform),
            authority=authority,
            is_static=is_static,
        )


class TransformListener:
    """Fills a buffer from ``/tf`` and ``/tf_static``."""

    def __init__(
        self,
        buffer: Buffer,
        queue_size: int | None = None,
        buff_size: int = 65536,
        tcp_nodelay: bool = False,
    ) -> None:
        del queue_size, buff_size, tcp_nodelay
        node = STATE.require("TransformListener")
        self.buffer = buffer
        self._listener = graph_tf.TransformListener(buffer.core, node)

    def unregister(self) -> None:
        """Stop listening."""
        self._listener.close()


class TransformBroadcaster:
    """Sends moving frames."""

    def __init__(self) -> None:
        self._core = graph_tf.TransformBroadcaster(STATE.require("TransformBroadcaster"))

    def sendTransform(self, transform: Any) -> None:
        """Send one ``TransformStamped`` or a list of them."""
        self._core.send(transform)


class StaticTransformBroadcaster:
    """Sends frames that never move; late listeners get them all."""

    def __init__(self) -> None:
        self._core = graph_tf.StaticTransformBroadcaster(
            STATE.require("StaticTransformBroadcaster")
        )

    def sendTransform(self, transform: Any) -> None:
        """Send one ``TransformStamped`` or a list of them."""
        self._core.send(transform)


def _warn(text: str) -> None:
    if STATE.node is not None:
        STATE.node.log("warn", text, padded=False)
