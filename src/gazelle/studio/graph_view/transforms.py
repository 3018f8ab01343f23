"""``tf`` and ``tf.tree``: where frames are, and who says so."""

from __future__ import annotations

from typing import TypedDict

import numpy as np

from gazelle.studio.frame_manager import NO_POSE, Frames, pose_values, poses_in
from gazelle.studio.request_params import Params
from gazelle.studio.streams import Channel, Frame, OpenStream, Pace, every

__all__ = ["KIND_FRAMES", "FrameNames", "FrameRow", "TfFrame", "open_tf", "open_tree"]

KIND_FRAMES = 2
_TREE_S = 1.0


class TfFrame(TypedDict):
    """A frame of the stream `tf`, in the order of the poses."""

    name: str
    parent: str
    static: bool


class FrameNames(TypedDict):
    """What the stream `tf` tells ahead of poses whenever it changes."""

    frames: list[TfFrame]


class FrameRow(TypedDict):
    """A frame of the stream `tf.tree`.

    Attributes:
        rate_hz: null where it is static.
        age_s: of the newest transform; null where it is static.
        broadcaster: the node that says so.
    """

    frame: str
    parent: str
    rate_hz: float | None
    age_s: float | None
    broadcaster: str
    static: bool


def open_tf(frames: Frames, channel: Channel, params: Params) -> OpenStream:
    """Stream ``tf``: poses in a fixed frame, their names ahead whenever these change."""
    poses = _Poses(frames, params.text("fixed_frame"))
    rate_hz = params.number("rate_hz", 30.0, least=0.1, most=100.0)
    pace = Pace(channel, lambda: channel.offer(poses.frames), rate_hz)
    leave = frames.use(pace)
    pace()
    return OpenStream(leave)


def open_tree(frames: Frames, channel: Channel, _params: Params) -> OpenStream:
    """Stream ``tf.tree``."""
    every(channel, _TREE_S, lambda: channel.offer(lambda: _tree(frames)))
    return OpenStream(frames.use())


class _Poses:
    def __init__(self, frames: Frames, fixed_frame: str) -> None:
        self._frames = frames
        self._fixed = fixed_frame
        self._told: list[TfFrame] | None = None

    def frames(self) -> Frame | tuple[FrameNames, Frame]:
        """Return the frames to send: names first if they are not those told last."""
        latest = self._frames.buffer.latest()
        poses = poses_in(latest, self._fixed)
        rows = sorted(poses)
        static = {one.name for one in self._frames.buffer.frames() if one.is_static}
        names: list[TfFrame] = [
            {
                "name": name,
                "parent": latest[name].frame_id if name in latest else "",
                "static": name in static,
            }
            for name in rows
        ]
        values = [NO_POSE if (pose := poses[name]) is None else pose_values(pose) for name in rows]
        data = np.array(values, np.float32).reshape(-1, 7)
        frame = Frame(KIND_FRAMES, len(rows), self._frames.clock.now_ns() * 1e-9, (data,))
        if names == self._told:
            return frame
        self._told = names
        told: FrameNames = {"frames": names}
        return (told, frame)


def _tree(frames: Frames) -> list[FrameRow]:
    now_ns = frames.clock.now_ns()
    return [
        {
            "frame": one.name,
            "parent": one.parent,
            "rate_hz": None if one.is_static else one.rate_hz,
            "age_s": None if one.is_static else (now_ns - one.latest_ns) * 1e-9,
            "broadcaster": one.authority,
            "static": one.is_static,
        }
        for one in frames.buffer.frames()
    ]
