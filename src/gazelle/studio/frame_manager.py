"""Coordinate frames: one buffer for all displays, and poses of everything in a fixed frame."""

from __future__ import annotations

import threading
from collections.abc import Callable

from gazelle.geometry import Pose
from gazelle.geometry.pose import IDENTITY_POSE
from gazelle.graph import Node
from gazelle.graph.tf import ExtrapolationError, StampedPose, TransformBuffer, TransformListener

__all__ = ["NO_POSE", "Frames", "pose_values", "poses_in"]

NO_POSE = (float("nan"),) * 7
_TELL_S = 0.02
_LOOK_S = 0.5


class Frames:
    """The frames of a graph.

    Attributes:
        clock: its time.
        buffer: all of them.
    """

    def __init__(self, node: Node) -> None:
        """Prepare; nothing is listened to before `use`."""
        self.buffer = TransformBuffer()
        self.clock = node.clock
        self._node = node
        self._lock = threading.Lock()
        self._users: tuple[Callable[[], None], ...] = ()
        self._end: Callable[[], None] | None = None

    def use(self, on_change: Callable[[], None] = lambda: None) -> Callable[[], None]:
        """Listen to ``/tf`` and ``/tf_static`` while somebody is interested.

        Args:
            on_change: something short that is called when frames have moved.

        Returns:
            What ends the interest.
        """

        def user() -> None:
            on_change()

        with self._lock:
            self._users += (user,)
            if self._end is None:
                self._end = self._start()

        def leave() -> None:
            with self._lock:
                self._users = tuple(one for one in self._users if one is not user)
                end, self._end = (None, self._end) if self._users else (self._end, None)
            if end is not None:
                end()

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

    def _start(self) -> Callable[[], None]:
        listener = TransformListener(self.buffer, self._node)
        ended = threading.Event()
        thread = threading.Thread(target=self._run, args=(ended,), name="studio tf", daemon=True)
        thread.start()

        def end() -> None:
            ended.set()
            listener.close()
            self.buffer.clear()

        return end

    def _run(self, ended: threading.Event) -> None:
        while not ended.is_set():
            if self.buffer.wait_for_change(_LOOK_S):
                for user in self._users:
                    user()
            # What comes together is told once.
            ended.wait(_TELL_S)


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
