"""``image``, the displays Image and Camera, and ``turtles``, the canvas that turtlesim draws."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.interfaces import Message
from gazelle.studio.displays.image_encodings import (
    KIND_JPEG,
    PictureSettings,
    checked_colormap,
    encoded_picture,
)
from gazelle.studio.displays.topic_display import DisplayContext, Site, open_newest, open_on
from gazelle.studio.errors import StudioError
from gazelle.studio.frame_manager import pose_values
from gazelle.studio.json_text import message_value
from gazelle.studio.request_params import Params
from gazelle.studio.streams import Channel, Frame, OpenStream
from gazelle.studio.subscriptions import Sample, Subscriptions, stamp_s

__all__ = ["CameraInfo", "info_topic", "open_camera", "open_image", "open_picture", "open_turtles"]

_SUFFIXES = ("/compressedDepth", "/compressed")
_MAX_PX = 16_384
_NODE = "/turtlesim"
_QUALITY = 92


def open_image(context: DisplayContext, channel: Channel, params: Params) -> OpenStream:
    """Stream ``image``."""
    return open_on(Site(context, channel, params), open_picture)


def open_picture(site: Site) -> OpenStream:
    """Display Image: the pictures of a topic as JPEG."""
    return open_newest(site, _maker(site))


def open_camera(site: Site) -> OpenStream:
    """Display Camera: the pictures, and the camera and where it stands ahead of them."""
    make = _maker(site)
    topic = site.params.text("topic")
    info = CameraInfo(site.subscriptions, info_topic(topic))
    told: Any = None

    def with_camera(sample: Sample) -> Any:
        nonlocal told
        frame = make(sample)
        camera = info.message()
        if camera is None:
            text = f"No CameraInfo received on [{info.topic}]. Topic may not exist."
            site.channel.status("warn", text)
            return frame
        header = site.headed(sample).header
        value = {
            "camera_info": message_value(camera, None),
            "pose": pose_values(site.pose(header)),
            "frame": header.frame_id,
        }
        value["camera_info"]["header"] = None
        if value == told:
            return frame
        told = value
        return (value, frame)

    stream = open_newest(site, with_camera)

    def close() -> None:
        stream.close()
        info.close()

    return OpenStream(close)


class CameraInfo:
    """The ``camera_info`` beside a picture's topic.

    Attributes:
        topic: where it comes from.
        close: listens no more.
    """

    def __init__(self, subscriptions: Subscriptions, topic: str) -> None:
        """Listen to the topic."""
        self.topic = topic
        self._sample: Sample | None = None
        self.close: Callable[[], None] = subscriptions.listen(topic, self._take)

    def message(self) -> Message | None:
        """Return the last one, None before it."""
        return None if self._sample is None else self._sample.message()

    def _take(self, sample: Sample) -> None:
        self._sample = sample


def info_topic(topic: str) -> str:
    """Return the topic of the camera that a picture's topic belongs to, as image_transport does."""
    for suffix in _SUFFIXES:
        topic = topic.removesuffix(suffix)
    return f"{topic.rpartition('/')[0]}/camera_info"


def open_turtles(context: DisplayContext, channel: Channel, params: Params) -> OpenStream:
    """Stream ``turtles`` of a ``node``: its hidden topic ``~_canvas`` as pictures."""
    node = context.subscriptions.node.resolve_name(params.text("node", _NODE))
    wanted = Params(params.where, {"topic": f"{node}/_canvas", "quality": _QUALITY})
    return open_picture(Site(context, channel, wanted))


def _settings(params: Params) -> PictureSettings:
    low = high = None
    if not params.flag("Normalize Range", True):
        low, high = params.number("Min Value", 0.0), params.number("Max Value", 1.0)
    return PictureSettings(
        params.whole("quality", 80, least=1, most=95),
        params.whole("max_width", 1280, least=16, most=_MAX_PX),
        checked_colormap(params.text("colormap", "gray")),
        low,
        high,
    )


def _maker(site: Site) -> Callable[[Sample], Frame]:
    settings = _settings(site.params)

    def make(sample: Sample) -> Frame:
        message = site.message(sample)
        if not hasattr(message, "data") or not (
            hasattr(message, "encoding") or hasattr(message, "format")
        ):
            raise StudioError(f"{sample.raw.type_name} is no picture")
        made = encoded_picture(message, settings)
        # Sides share a number of 32 bits.
        size = min(made.width_px, 0xFFFF) << 16 | min(made.height_px, 0xFFFF)
        return Frame(KIND_JPEG, size, stamp_s(message, sample.time_s), (made.jpeg,))

    return make
