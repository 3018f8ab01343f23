"""The tree of coordinate frames over the last seconds, and transforms between any two of them."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable
from typing import NamedTuple

from gazelle.diagnostics import nearest_names
from gazelle.geometry import Pose
from gazelle.geometry.pose import IDENTITY_POSE
from gazelle.graph.errors import coded
from gazelle.graph.tf.exceptions import (
    ConnectivityError,
    ExtrapolationError,
    InvalidFrameError,
    TransformError,
    UnknownFrameError,
    gap_text,
)
from gazelle.graph.tf.history import History, Sample, StaticHistory
from gazelle.rich_display import shown_by

__all__ = ["FrameInfo", "StampedPose", "TransformBuffer"]

DEFAULT_CACHE_NS = 10_000_000_000
_MAX_DEPTH = 1000
_NORM_TOLERANCE = 10e-3


class StampedPose(NamedTuple):
    """A transform at a time.

    Attributes:
        frame_id: the target frame.
        child_frame_id: the source frame.
        stamp_ns: the time, 0 when only static frames are involved.
        pose: ``T_target_source``, takes coordinates in the source frame to the target frame.
    """

    frame_id: str
    child_frame_id: str
    stamp_ns: int
    pose: Pose


class FrameInfo(NamedTuple):
    """One frame of the tree.

    Attributes:
        name: the frame.
        parent: its parent.
        authority: the node that publishes it.
        is_static: whether it never moves.
        rate_hz: mean rate of its samples; 10000 for a static one, as tf2 says.
        latest_ns: time of the newest sample.
        oldest_ns: time of the oldest.
    """

    name: str
    parent: str
    authority: str
    is_static: bool
    rate_hz: float
    latest_ns: int
    oldest_ns: int


@shown_by("frames:buffer_bundle")
class TransformBuffer:
    """Keeps transforms and answers questions about them, with tf2's rules and words.

    Safe to use from many threads. Frames have no leading slash; one that comes in is removed, as
    tf2 does, one asked for is an error.
    """

    def __init__(
        self,
        cache_ns: int = DEFAULT_CACHE_NS,
        *,
        on_warning: Callable[[str], None] | None = None,
    ) -> None:
        """Start empty.

        Args:
            cache_ns: how far back moving frames are kept, nanoseconds.
            on_warning: told what is wrong with the transforms that come in, each once.
        """
        self.cache_ns = cache_ns
        self._frames: dict[str, History | StaticHistory] = {}
        self._authorities: dict[str, list[str]] = {}
        self._known: set[str] = set()
        self._changed = threading.Condition(threading.RLock())
        self._on_warning = on_warning
        self._warned: set[str] = set()

    def set_transform(
        self,
        frame_id: str,
        child_frame_id: str,
        stamp_ns: int,
        pose: Pose,
        *,
        authority: str = "default_authority",
        is_static: bool = False,
    ) -> bool:
        """Add ``T_frame_child`` at a time; return whether it was taken."""
        frame, child = frame_id.removeprefix("/"), child_frame_id.removeprefix("/")
        problem = _problem(frame, child, pose, authority)
        if problem:
            self._warn(problem)
            return False
        sample = Sample(stamp_ns, frame, pose)
        with self._changed:
            history = self._frames.get(child)
            if history is None:
                self._frames[child] = StaticHistory(sample) if is_static else History(sample)
                refused = ""
            else:
                refused = history.add(sample, self.cache_ns)
            if not refused:
                self._note_authority(child, authority)
                self._known.update((frame, child))
                self._changed.notify_all()
        if refused == "TF_OLD_DATA":
            self._warn(
                f"TF_OLD_DATA ignoring data from the past for frame {child} (parent {frame}) "
                f"according to authority {authority}\n  see http://wiki.ros.org/tf/Errors%20explained"
            )
        return not refused

    def lookup_transform(
        self, target_frame: str, source_frame: str, stamp_ns: int = 0, *, timeout_s: float = 0.0
    ) -> StampedPose:
        """Return ``T_target_source`` at a time.

        Args:
            target_frame: the frame to express things in.
            source_frame: the frame they are given in.
            stamp_ns: nanoseconds, 0 for the latest time that all frames in between know.
            timeout_s: how long to wait for it, wall seconds.

        Raises:
            InvalidFrameError: a name is empty or starts with a slash.
            UnknownFrameError: a frame does not exist, or the frames form a loop.
            ConnectivityError: there is no way from one to the other.
            ExtrapolationError: the time is outside what is known.
        """
        return self._waiting(lambda: self._lookup(target_frame, source_frame, stamp_ns), timeout_s)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_ns: int,
        source_frame: str,
        source_ns: int,
        fixed_frame: str,
        *,
        timeout_s: float = 0.0,
    ) -> StampedPose:
        """Return ``T_target_source`` between two times, by way of a frame that stands still.

        Raises:
            TransformError: as `lookup_transform`.
        """

        def look() -> StampedPose:
            self._check(fixed_frame, "lookupTransform argument fixed_frame")
            to_fixed = self._lookup(fixed_frame, source_frame, source_ns)
            to_target = self._lookup(target_frame, fixed_frame, target_ns)
            return StampedPose(
                target_frame, source_frame, to_target.stamp_ns, to_target.pose @ to_fixed.pose
            )

        return self._waiting(look, timeout_s)

    def can_transform(
        self, target_frame: str, source_frame: str, stamp_ns: int = 0, *, timeout_s: float = 0.0
    ) -> bool:
        """Return whether `lookup_transform` would succeed."""
        return not self.why_not(target_frame, source_frame, stamp_ns, timeout_s=timeout_s)

    def why_not(
        self, target_frame: str, source_frame: str, stamp_ns: int = 0, *, timeout_s: float = 0.0
    ) -> str:
        """Return why `lookup_transform` would fail, empty when it would not."""
        try:
            self.lookup_transform(target_frame, source_frame, stamp_ns, timeout_s=timeout_s)
        except TransformError as error:
            return str(error)
        return ""

    def latest_common_time_ns(self, target_frame: str, source_frame: str) -> int:
        """Return the latest time all frames in between know, 0 when all of them are static.

        Raises:
            TransformError: there is no way from one to the other.
        """
        with self._changed:
            return self._common_time(target_frame, source_frame)

    def chain(self, target_frame: str, source_frame: str) -> list[str]:
        """Return the frames from source to target, both included.

        Raises:
            TransformError: there is no way from one to the other.
        """
        with self._changed:
            up = self._ancestors(source_frame)
            down = self._ancestors(target_frame)
            meeting = next((frame for frame in up if frame in down), None)
            if meeting is None:
                raise self._unconnected(target_frame, source_frame)
            return up[: up.index(meeting) + 1] + down[: down.index(meeting)][::-1]

    def frames(self) -> tuple[FrameInfo, ...]:
        """Return all frames that have a parent, in the order they came."""
        with self._changed:
            return tuple(
                FrameInfo(
                    name,
                    history.latest.parent,
                    self._authorities[name][-1],
                    history.is_static,
                    len(history) / max((history.latest.stamp_ns - history.oldest_ns) / 1e9, 1e-4),
                    history.latest.stamp_ns,
                    history.oldest_ns,
                )
                for name, history in self._frames.items()
            )

    def latest(self) -> dict[str, StampedPose]:
        """Return every frame that has a parent with its newest ``T_parent_frame``."""
        with self._changed:
            newest = [(name, history.latest) for name, history in self._frames.items()]
        return {
            name: StampedPose(sample.parent, name, sample.stamp_ns, sample.pose)
            for name, sample in newest
        }

    def frame_names(self) -> tuple[str, ...]:
        """Return the names of all frames, roots included, sorted."""
        with self._changed:
            return tuple(sorted(self._known))

    def has_frame(self, frame: str) -> bool:
        """Return whether the frame exists."""
        return frame in self._known

    def wait_for_change(self, timeout_s: float) -> bool:
        """Wait until a transform comes in; False when time is up."""
        with self._changed:
            return self._changed.wait(timeout_s)

    def clear(self) -> None:
        """Forget the moving frames, as after a jump of time; static ones stay."""
        with self._changed:
            self._frames = {
                name: history for name, history in self._frames.items() if history.is_static
            }

    def _lookup(self, target: str, source: str, stamp_ns: int) -> StampedPose:
        with self._changed:
            self._check(target, "lookupTransform argument target_frame")
            self._check(source, "lookupTransform argument source_frame")
            if target == source:
                latest = self._frames.get(target)
                known_ns = latest.latest.stamp_ns if latest and not stamp_ns else stamp_ns
                return StampedPose(target, source, known_ns, IDENTITY_POSE)
            common_ns = self._common_time(target, source)
            stamp_ns = stamp_ns or common_ns
            return StampedPose(target, source, stamp_ns, self._walk(target, source, stamp_ns))

    def _walk(self, target: str, source: str, stamp_ns: int) -> Pose:
        """Go up from the source, then from the target until the ways meet."""
        T_frame_source: dict[str, Pose] = {}
        failure: ExtrapolationError | None = None
        frame, pose = source, IDENTITY_POSE
        for _ in range(_MAX_DEPTH):
            T_frame_source[frame] = pose
            history = self._frames.get(frame)
            if history is None or frame == target:
                break
            try:
                sample = history.at(stamp_ns)
            except ExtrapolationError as error:
                failure = error
                break
            frame, pose = sample.parent, sample.pose @ pose
        frame, pose = target, IDENTITY_POSE
        for _ in range(_MAX_DEPTH):
            if frame in T_frame_source:
                return pose.inverse() @ T_frame_source[frame]
            history = self._frames.get(frame)
            if history is None:
                break
            try:
                sample = history.at(stamp_ns)
            except ExtrapolationError as error:
                failure = error
                break
            frame, pose = sample.parent, sample.pose @ pose
        if failure is None:
            raise self._unconnected(target, source)
        raise ExtrapolationError(
            f"{failure}, when looking up transform from frame [{source}] to frame [{target}]",
            is_past=failure.is_past,
        )

    def _common_time(self, target: str, source: str) -> int:
        links = self.chain(target, source)
        meeting = {frame for frame in links if self._parent(frame) not in links}
        stamps = [
            self._frames[frame].latest.stamp_ns
            for frame in links
            if frame in self._frames and frame not in meeting
        ]
        return min((stamp for stamp in stamps if stamp), default=0)

    def _parent(self, frame: str) -> str:
        history = self._frames.get(frame)
        return history.latest.parent if history else ""

    def _ancestors(self, frame: str) -> list[str]:
        found = [frame]
        while parent := self._parent(found[-1]):
            found.append(parent)
            self._check_depth(len(found))
        return found

    def _check_depth(self, depth: int) -> None:
        if depth > _MAX_DEPTH:
            listing = "".join(
                f"Frame {name} exists with parent {history.latest.parent}.\n"
                for name, history in self._frames.items()
            )
            raise UnknownFrameError(
                f"The tf tree is invalid because it contains a loop.\n{listing}"
            )

    def _check(self, frame: str, argument: str) -> None:
        if not frame:
            raise InvalidFrameError(
                f"Invalid argument passed to {argument} in tf2 frame_ids cannot be empty"
            )
        if frame.startswith("/"):
            raise InvalidFrameError(
                f'Invalid argument "{frame}" passed to {argument} in tf2 frame_ids cannot start '
                "with a '/' like: "
            )
        if frame not in self._known:
            text = f'"{frame}" passed to {argument} does not exist. '
            nearest = nearest_names(frame, self._known)
            if nearest:
                text += f"Did you mean {' or '.join(nearest)}?"
            raise UnknownFrameError(text)

    def _unconnected(self, target: str, source: str) -> ConnectivityError:
        return ConnectivityError(
            f"Could not find a connection between '{target}' and '{source}' because they are not "
            "part of the same tree.Tf has two or more unconnected trees.\n"
            f"  {gap_text(self._root(target), self._root(source))}"
        )

    def _root(self, frame: str) -> str:
        return self._ancestors(frame)[-1]

    def _waiting(self, look: Callable[[], StampedPose], timeout_s: float) -> StampedPose:
        deadline = time.monotonic() + timeout_s
        with self._changed:
            while True:
                try:
                    return look()
                except InvalidFrameError:
                    raise
                except TransformError:
                    left = deadline - time.monotonic()
                    if left <= 0:
                        raise
                self._changed.wait(left)

    def _note_authority(self, child: str, authority: str) -> None:
        """Warn when publishers take turns; one that follows another for good is fine."""
        past = self._authorities.setdefault(child, [])
        if past and past[-1] == authority:
            return
        if authority in past:
            past.remove(authority)
            one, other = sorted((past[-1], authority))
            text = f"frame '{child}' is published by {one} and by {other}, so it jumps between them"
            self._warn(coded("graph.tf-two-authorities", text))
        past.append(authority)

    def _warn(self, text: str) -> None:
        if self._on_warning is not None and text not in self._warned:
            self._warned.add(text)
            self._on_warning(text)


def _problem(frame: str, child: str, pose: Pose, authority: str) -> str:
    """Return tf2's complaint about a transform, empty when it is fine."""
    if frame == child:
        return (
            f'TF_SELF_TRANSFORM: Ignoring transform from authority "{authority}" with frame_id and '
            f'child_frame_id  "{child}" because they are the same'
        )
    if not child:
        return (
            f'TF_NO_CHILD_FRAME_ID: Ignoring transform from authority "{authority}" because '
            "child_frame_id not set "
        )
    if not frame:
        return (
            f'TF_NO_FRAME_ID: Ignoring transform with child_frame_id "{child}"  from authority '
            f'"{authority}" because frame_id not set'
        )
    x, y, z, w = pose.quat_xyzw
    error = x * x + y * y + z * z + w * w - 1.0
    # Written out: every transform of a robot comes by here, and nearly all of them end here.
    if -_NORM_TOLERANCE <= error <= _NORM_TOLERANCE and not math.isnan(sum(pose.position_m)):
        return ""
    about = f'Ignoring transform for child_frame_id "{child}" from authority "{authority}" because'
    values = (*pose.position_m, *pose.quat_xyzw)
    if any(math.isnan(value) for value in values):
        return f"TF_NAN_INPUT: {about} of a nan value in the transform {values}"
    if abs(error) > _NORM_TOLERANCE:
        return (
            f"TF_DENORMALIZED_QUATERNION: {about} of an invalid quaternion in the transform "
            f"({' '.join(f'{value:f}' for value in pose.quat_xyzw)})"
        )
    return ""
