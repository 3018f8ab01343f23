"""Displays whose messages the page draws itself: Path, Odometry, Pose, Range and the like."""

from __future__ import annotations

from typing import Any

from gazelle.studio.displays.topic_display import Site, open_newest
from gazelle.studio.frames import pose_values
from gazelle.studio.json_text import message_value
from gazelle.studio.stamps import stamp_s
from gazelle.studio.streams import OpenStream
from gazelle.studio.subscriptions import Sample

__all__ = ["open_plain"]


def open_plain(site: Site) -> OpenStream:
    """Send each message with the pose of its frame in the fixed one."""

    def make(sample: Sample) -> Any:
        message = site.headed(sample)
        # Joint states have no frame; efforts are drawn at the robot's joints.
        framed = bool(message.header.frame_id) or hasattr(message, "pose")
        pose = pose_values(site.pose(message.header)) if framed else None
        return {
            "pose": pose,
            "stamp_s": stamp_s(message, sample.time_s),
            "frame": message.header.frame_id,
            "message": message_value(message, None),
        }

    return open_newest(site, make)
