"""What all displays of a topic share: the newest message, and its pose in the fixed frame.

Path, Odometry, Pose, Range and the like are no more than that: the page draws their messages.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from gazelle.geometry import Pose
from gazelle.graph.tf import TransformError
from gazelle.interfaces.stamps import ns_of
from gazelle.studio.errors import StudioError
from gazelle.studio.frame_manager import Frames, pose_values
from gazelle.studio.json_text import message_value
from gazelle.studio.request_params import Params
from gazelle.studio.scenes.assets import Assets
from gazelle.studio.streams import Channel, OpenStream, every
from gazelle.studio.subscriptions import Sample, Subscriptions, stamp_s

__all__ = ["DisplayContext", "Site", "open_newest", "open_on", "open_plain"]

_RETRY_S = 0.5


@dataclass(frozen=True)
class DisplayContext:
    """What all displays are shown with.

    Attributes:
        subscriptions: topics; its node calls services for displays.
        frames: where frames are.
        assets: keeps meshes for pages.
    """

    subscriptions: Subscriptions
    frames: Frames
    assets: Assets


class Site:
    """Where a display is shown.

    Attributes:
        subscriptions: topics; its node calls services for displays.
        assets: keeps meshes for pages.
        channel: where its frames go.
        params: topic, fixed frame and the display's own properties.
        frames: where frames are.
        leave: ends the interest in frames, with the display.
    """

    def __init__(
        self,
        context: DisplayContext,
        channel: Channel,
        params: Params,
        convert: Callable[[Any], Any] | None = None,
    ) -> None:
        """Note the site of a display; `convert` makes a message into one that it shows."""
        self.subscriptions = context.subscriptions
        self.assets = context.assets
        self.channel = channel
        self.params = params
        self.frames = context.frames
        self.leave = self.frames.use() if "fixed_frame" in params else lambda: None
        self._fixed = params.text("fixed_frame", "map")
        self._convert = convert

    def message(self, sample: Sample) -> Any:
        """Return what a sample brings for this display.

        Raises:
            StudioError: it cannot be made into what the display shows.
        """
        message = sample.message()
        if self._convert is None:
            return message
        try:
            return self._convert(message)
        except Exception as error:
            text = f"{sample.raw.type_name} cannot be converted: {type(error).__name__}: {error}"
            raise StudioError(text) from error

    def headed(self, sample: Sample) -> Any:
        """Return a sample's message, which must have a header.

        Raises:
            StudioError: it has none, so nobody knows where it is.
        """
        message = self.message(sample)
        if not hasattr(message, "header"):
            raise StudioError(f"{sample.raw.type_name} has no header, so it has no place")
        return message

    def pose(self, header: Any) -> Pose:
        """Return ``T_fixed_frame`` of a message's header.

        Raises:
            StudioError: there is no way from its frame to the fixed one; in RViz's words.
        """
        try:
            return self.frames.pose(self._fixed, header.frame_id, ns_of(header.stamp))
        except TransformError as error:
            raise StudioError(
                f"No transform from [{header.frame_id}] to [{self._fixed}]: {error}"
            ) from error


def open_on(site: Site, opener: Callable[[Site], OpenStream]) -> OpenStream:
    """Open a display on a site that ends with it."""
    try:
        stream = opener(site)
    except BaseException:
        site.leave()
        raise

    def close() -> None:
        stream.close()
        site.leave()

    return OpenStream(close, stream.info)


def open_newest(
    site: Site, make: Callable[[Sample], Any], *, topic: str = "", refresh_s: float = 0.0
) -> OpenStream:
    """Show the newest message of a topic.

    Args:
        site: where.
        make: message → what is sent, None for nothing. While it raises `StudioError` it is tried
            again, since a transform may come later.
        topic: the site's own when empty.
        refresh_s: try again so often also when it went well, for what stays and moves along.
    """
    newest = _Newest(site, make)
    leave = site.subscriptions.listen(topic or site.params.text("topic"), newest.take)
    every(site.channel, refresh_s or _RETRY_S, newest.again_always if refresh_s else newest.again)
    return OpenStream(leave)


class _Newest:
    def __init__(self, site: Site, make: Callable[[Sample], Any]) -> None:
        self._site = site
        self._make = make
        self._sample: Sample | None = None
        self._failed = False

    def take(self, sample: Sample) -> None:
        """Runs in the transport's thread."""
        self._sample = sample
        self._site.channel.offer(self._made)

    def again(self) -> None:
        if self._failed:
            self._site.channel.offer(self._made)

    def again_always(self) -> None:
        if self._sample is not None:
            self._site.channel.offer(self._made)

    def _made(self) -> Any:
        sample = self._sample
        if sample is None:
            return None
        self._failed = True
        made = self._make(sample)
        self._failed = False
        return made


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
