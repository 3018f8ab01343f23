"""``motion.path``: planned paths of a topic, whole."""

from __future__ import annotations

from typing import Any

from gazelle.studio.errors import StudioError
from gazelle.studio.json_text import message_value
from gazelle.studio.request_params import Params
from gazelle.studio.streams import Channel, OpenStream
from gazelle.studio.subscriptions import Sample, Taps

__all__ = ["open_path"]


def open_path(taps: Taps, channel: Channel, params: Params) -> OpenStream:
    """Send each ``moveit_msgs/DisplayTrajectory`` of a ``topic``."""

    def value(sample: Sample) -> Any:
        message: Any = sample.message()
        if not hasattr(message, "trajectory_start"):
            raise StudioError(f"{message.TYPE_NAME} is no moveit_msgs/DisplayTrajectory")
        return message_value(message, None)

    def take(sample: Sample) -> None:
        channel.offer(lambda: value(sample))

    return OpenStream(taps.listen(params.text("topic"), take))
