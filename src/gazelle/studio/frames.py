"""Coordinate frames: one buffer for all displays, and poses of everything in a fixed frame."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

from gazelle.geometry import Pose
from gazelle.geometry.pose import IDENTITY_POSE
from gazelle.graph.tf import ExtrapolationError, StampedPose, TransformBuffer, TransformListener

if TYPE_CHECKING:
    from gazelle.studio.session import Studio

__all__ = ["NO_POSE", "Frames", "pose_values", "poses_in"]

NO_POSE = (float("nan"),) * 7
_TELL_S = 0.01
_LOOK_S = 0.5


class Frames:
    """The frames of a Studio's graph.

    Attributes:
        buffer: all of them.
    """

    def __init__(self, studio: Studio) -> None:
        """Listen to ``/tf`` and ``/tf_static``."""
        self.buffer = TransformBuffer()
        self._listener = TransformListener(self.buffer, studio.node)
        self._followers: tuple[Callable[[], None], ...] = ()
        self._lock = threading.Lock()
        self._closed = False
        studio.on_close(self._close)
        threading.Thread(target=self._run, name="studio frames", daemon=True).start()

    def follow(self, follower: Callable[[], None]) -> Callable[[], None]:
        """Call something short when frames have moved; returns what ends that."""
        with self._lock:
            self._followers += (follower,)
        follower()

        def leave() -> None:
            with self._lock:
                self._followers = tuple(one for one in self._followers if one is not follower)

        return leave

    def pose(self, fixed_frame: str, frame: str, stamp_ns: int) -> Pose:
        """Return ``T_fixed_frame`` at a time; the newest one where tf lags behind the data.

        Raises:
            TransformError: there is no way, or the data are older than all that tf remembers.
        """
        fixed, frame = fixed_frame.removeprefix("/"), frame.removeprefix("/")
        if fixed == frame and frame:
            return IDENTITY_POSE
        try:
            return self.buffer.lookup_transform(fixed, frame, stamp_ns).pose
        except ExtrapolationError:
            newest = self.buffer.lookup_transform(fixed, frame)
            if newest.stamp_ns > stamp_ns:
                raise
            return newest.pose

    def _close(self) -> None:
        self._closed = True
        self._listener.close()

    def _run(self) -> None:
        pause = threading.Event()
        while not self._closed:
            if self.buffer.wait_for_change(_LOOK_S):
                for follower in self._followers:
                    follower()
            # What comes together is told once.
            pause.wait(_TELL_S)


def poses_in(latest: dict[str, StampedPose], fixed_frame: str) -> dict[str, Pose | None]:
    """Return the newest pose of every frame in a fixed one, None where there is no way.

    Args:
        latest: frame → pose in its parent, see `TransformBuffer.latest`.
        fixed_frame: it need not exist.
    """
    in_root: dict[str, tuple[str, Pose]] = {}
    names = {*latest, *(one.frame_id for one in latest.values())}
    for name in names:
        _climb(name, latest, in_root)
    fixed = in_root.get(fixed_frame.removeprefix("/"))
    if fixed is None:
        return dict.fromkeys(names)
    root, T_root_fixed = fixed
    T_fixed_root = T_root_fixed.inverse()
    return {
        name: T_fixed_root @ in_root[name][1] if in_root[name][0] == root else None
        for name in names
    }


def pose_values(pose: Pose) -> tuple[float, ...]:
    """Return x, y, z, qx, qy, qz, qw."""
    return (*pose.position_m, *pose.quat_xyzw)


def _climb(name: str, latest: dict[str, StampedPose], in_root: dict[str, tuple[str, Pose]]) -> None:
    """Find a frame's root and its pose in it; a loop ends where it closes."""
    way: list[str] = []
    while name not in in_root and name in latest and name not in way:
        way.append(name)
        name = latest[name].frame_id
    root, pose = in_root.setdefault(name, (name, IDENTITY_POSE))
    for frame in reversed(way):
        if frame not in in_root:
            pose = pose @ latest[frame].pose
            in_root[frame] = (root, pose)
        else:
            root, pose = in_root[frame]
