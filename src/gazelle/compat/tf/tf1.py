"""The old `tf` module: listeners and broadcasters that speak in tuples."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.compat.rospy.rostime import Time
from gazelle.compat.rospy.state import STATE
from gazelle.compat.tf.buffer import Buffer
from gazelle.compat.tf.conversions import nanoseconds
from gazelle.compat.tf.exceptions import (
    ConnectivityException,
    ExtrapolationException,
    LookupException,
    TransformException,
    as_tf2_error,
)
from gazelle.compat.tf.listener_and_broadcasters import TransformListener as Tf2TransformListener
from gazelle.compat.tf.tf2_geometry_msgs import (
    do_transform_point,
    do_transform_pose,
    do_transform_vector3,
)
from gazelle.geometry import Pose
from gazelle.graph import tf as graph_tf
from gazelle.interfaces import ros1_message_type
from gazelle.interfaces.poses import pose_of_transform, quat_xyzw_of, set_quat_xyzw, xyz_of

__all__ = [
    "ConnectivityException",
    "Exception",
    "ExtrapolationException",
    "LookupException",
    "TransformBroadcaster",
    "TransformListener",
    "Transformer",
    "TransformerROS",
    "strip_leading_slash",
    "xyz_to_mat44",
    "xyzw_to_mat44",
]

Exception = TransformException

Translation = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]


class Transformer:
    """Keeps transforms; names may start with a slash, as in tf's days.

    Args:
        interpolate: without effect, as in tf since it rests on tf2: it always does.
        cache_time: how far back, a Duration.
    """

    def __init__(self, interpolate: bool = True, cache_time: Any = None) -> None:
        self._buffer = Buffer(cache_time, debug=False)

    def lookupTransform(
        self, target_frame: str, source_frame: str, time: Any
    ) -> tuple[Translation, Quaternion]:
        """Return translation and quaternion (x, y, z, w) from source to target.

        Raises:
            LookupException, ConnectivityException, ExtrapolationException: it is not known.
        """
        found = self._buffer.lookup_transform(_bare(target_frame), _bare(source_frame), time)
        pose = pose_of_transform(found.transform)
        return pose.position_m, pose.quat_xyzw

    def lookupTransformFull(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
    ) -> tuple[Translation, Quaternion]:
        """Return (x, y, z) in m and (x, y, z, w) between two times by way of a fixed frame.

        Raises:
            Exception: it is not known.
        """
        found = self._buffer.lookup_transform_full(
            _bare(target_frame), target_time, _bare(source_frame), source_time, _bare(fixed_frame)
        )
        pose = pose_of_transform(found.transform)
        return pose.position_m, pose.quat_xyzw

    def canTransform(self, target_frame: str, source_frame: str, time: Any) -> bool:
        """Return whether the transform is known."""
        known = self._buffer.can_transform(_bare(target_frame), _bare(source_frame), time)
        return bool(known)

    def waitForTransform(
        self,
        target_frame: str,
        source_frame: str,
        time: Any,
        timeout: Any,
        polling_sleep_duration: Any = None,
    ) -> None:
        """Wait until the transform is known, which is heard of and not polled.

        Raises:
            Exception: it was not in time; the text says why.
        """
        self._buffer.lookup_transform(_bare(target_frame), _bare(source_frame), time, timeout)

    def canTransformFull(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
    ) -> bool:
        """Return whether the transform between two times is known."""
        target, source, fixed = map(_bare, (target_frame, source_frame, fixed_frame))
        times = target_time, source_time
        return bool(self._buffer.can_transform_full(target, times[0], source, times[1], fixed))

    def waitForTransformFull(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any,
        polling_sleep_duration: Any = None,
    ) -> None:
        """Wait until the transform between two times is known, heard of and not polled.

        Raises:
            Exception: it was not in time; the text says why.
        """
        target, source, fixed = map(_bare, (target_frame, source_frame, fixed_frame))
        times = target_time, source_time
        self._buffer.lookup_transform_full(target, times[0], source, times[1], fixed, timeout)

    def setUsingDedicatedThread(self, value: bool) -> None:
        """Take either: frames always come in a thread of their own."""

    def getLatestCommonTime(self, source_frame: str, dest_frame: str) -> Time:
        """Return the latest time that all frames in between know.

        Raises:
            Exception: there is no way from one to the other.
        """
        frames = _bare(dest_frame), _bare(source_frame)
        latest: Time = self._buffer.get_latest_common_time(*frames)
        return latest

    def setTransform(self, transform: Any, authority: str = "") -> None:
        """Add a ``TransformStamped``."""
        self._buffer.set_transform(transform, authority)

    def frameExists(self, frame_id: str) -> bool:
        """Return whether a frame is known."""
        return self._buffer.core.has_frame(_bare(frame_id))

    def getFrameStrings(self) -> list[str]:
        """Return the names of all frames."""
        return list(self._buffer.core.frame_names())

    def chain(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
    ) -> list[str]:
        """Return the frames from source to target, which are the same at all times."""
        try:
            return self._buffer.core.chain(_bare(target_frame), _bare(source_frame))
        except graph_tf.TransformError as error:
            raise as_tf2_error(error) from None

    def allFramesAsString(self) -> str:
        """Return all frames as sentences."""
        return self._buffer.all_frames_as_string()

    def allFramesAsDot(self, current_time: Any = None) -> str:
        """Return all frames as a Graphviz graph, recorded at a time when one is given."""
        now_ns = 0 if current_time is None else nanoseconds(current_time)
        return graph_tf.frames_as_dot(self._buffer.core, now_ns)

    def clear(self) -> None:
        """Forget all moving frames."""
        self._buffer.clear()

    def getTFPrefix(self) -> str:
        """Return an empty prefix: tf2 has none."""
        return ""


class TransformerROS(Transformer):
    """Transforms messages that have a header."""

    def asMatrix(self, target_frame: str, hdr: Any) -> NDArray[np.float64]:
        """Return the 4×4 matrix from a header's frame to the target frame.

        Raises:
            Exception: it is not known.
        """
        translation, rotation = self.lookupTransform(target_frame, hdr.frame_id, hdr.stamp)
        return self.fromTranslationRotation(translation, rotation)

    def fromTranslationRotation(
        self, translation: Translation, rotation: Quaternion
    ) -> NDArray[np.float64]:
        """Return the 4×4 matrix of a translation and a quaternion (x, y, z, w)."""
        return _pose(translation, rotation).matrix()

    def transformPoint(self, target_frame: str, ps: Any) -> Any:
        """Return a ``PointStamped`` in another frame."""
        return do_transform_point(ps, self._found(target_frame, ps))

    def transformVector3(self, target_frame: str, v3s: Any) -> Any:
        """Return a ``Vector3Stamped`` in another frame."""
        return do_transform_vector3(v3s, self._found(target_frame, v3s))

    def transformPose(self, target_frame: str, ps: Any) -> Any:
        """Return a ``PoseStamped`` in another frame."""
        return do_transform_pose(ps, self._found(target_frame, ps))

    def transformQuaternion(self, target_frame: str, ps: Any) -> Any:
        """Return a ``QuaternionStamped`` in another frame."""
        found = self._found(target_frame, ps)
        own = Pose(quat_xyzw=quat_xyzw_of(ps.quaternion))
        pose = pose_of_transform(found.transform) @ own
        result = type(ps)()
        result.header.stamp, result.header.frame_id = ps.header.stamp, target_frame
        set_quat_xyzw(result.quaternion, pose.quat_xyzw)
        return result

    def transformPointCloud(self, target_frame: str, point_cloud: Any) -> Any:
        """Return a ``PointCloud`` in another frame; its channels go with it."""
        found = self._found(target_frame, point_cloud)
        pose = pose_of_transform(found.transform)
        result = type(point_cloud)(channels=point_cloud.channels)
        result.header.stamp = point_cloud.header.stamp
        result.header.frame_id = target_frame
        point = ros1_message_type("geometry_msgs/Point32")
        given = [(one.x, one.y, one.z) for one in point_cloud.points]
        for x, y, z in pose.transform(np.array(given, float).reshape(-1, 3)):
            result.points.append(point(float(x), float(y), float(z)))
        return result

    def _found(self, target_frame: str, message: Any) -> Any:
        header = message.header
        return self._buffer.lookup_transform(
            _bare(target_frame), _bare(header.frame_id), header.stamp
        )


class TransformListener(TransformerROS):
    """A transformer that listens to ``/tf`` and ``/tf_static``."""

    def __init__(self, interpolate: bool = True, cache_time: Any = None) -> None:
        super().__init__(interpolate, cache_time)
        self._listener = Tf2TransformListener(self._buffer)


class TransformBroadcaster:
    """Sends frames.

    Args:
        queue_size: told to others; the graph sends at once, so nothing waits here.
    """

    def __init__(self, queue_size: int = 100) -> None:
        node = STATE.require("TransformBroadcaster")
        self._core = graph_tf.TransformBroadcaster(node, queue_size=queue_size)

    def sendTransform(
        self, translation: Translation, rotation: Quaternion, time: Any, child: str, parent: str
    ) -> None:
        """Send the pose of `child` in `parent` at a time; rotation is (x, y, z, w)."""
        pose = _pose(translation, rotation)
        stamp_ns = nanoseconds(time)
        self._core.send(graph_tf.StampedPose(_bare(parent), _bare(child), stamp_ns, pose))

    def sendTransformMessage(self, transform: Any) -> None:
        """Send a ``TransformStamped``."""
        self._core.send(transform)


def strip_leading_slash(s: str) -> str:
    """Return a frame's name without the slash that tf's names began with."""
    return s.removeprefix("/")


def xyz_to_mat44(pos: Any) -> NDArray[np.float64]:
    """Return the 4×4 matrix of a ``Point`` or ``Vector3``."""
    return Pose(xyz_of(pos)).matrix()


def xyzw_to_mat44(ori: Any) -> NDArray[np.float64]:
    """Return the 4×4 matrix of a ``Quaternion``."""
    return Pose(quat_xyzw=quat_xyzw_of(ori)).matrix()


_bare = strip_leading_slash


def _pose(translation: Sequence[float], rotation: Sequence[float]) -> Pose:
    x, y, z = map(float, translation)
    qx, qy, qz, qw = map(float, rotation)
    return Pose((x, y, z), (qx, qy, qz, qw))
