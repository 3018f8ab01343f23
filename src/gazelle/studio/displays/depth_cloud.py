"""DepthCloud: the points of a depth picture, coloured by the camera's picture."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.studio.displays.cameras import CameraInfo, info_topic
from gazelle.studio.displays.image_encodings import pixels_rgb
from gazelle.studio.displays.point_colours import Colouring
from gazelle.studio.displays.points import Points, budget_of, points_frame
from gazelle.studio.displays.topic_display import Site, open_newest
from gazelle.studio.errors import StudioError
from gazelle.studio.streams import Frame, OpenStream
from gazelle.studio.subscriptions import Sample, stamp_s

__all__ = ["open_depth_cloud"]

_MILLIMETRES = ("16UC1", "mono16")
_METRES = "32FC1"
_COLOUR = "Color Image Topic"


def open_depth_cloud(site: Site) -> OpenStream:
    """Display of a depth topic with its ``camera_info``, and ``Color Image Topic`` if named."""
    topic = site.params.text("Depth Map Topic", "") or site.params.text("topic")
    budget = budget_of(site)
    colouring = Colouring.read(site.params)
    info = CameraInfo(site.subscriptions, info_topic(topic))
    colours = _Last(site, site.params.text(_COLOUR, ""))

    def make(sample: Sample) -> Frame | None:
        message = site.headed(sample)
        camera = info.message()
        if camera is None:
            raise StudioError(f"no camera_info came on {info.topic}")
        pose = site.pose(message.header)
        points = _points(message, camera, colours.picture(), budget)
        return points_frame(points, pose, colouring, stamp_s(message, sample.time_s))

    stream = open_newest(site, make, topic=topic)

    def close() -> None:
        stream.close()
        info.close()
        colours.close()

    return OpenStream(close)


class _Last:
    """The last message of a topic that may have no name."""

    def __init__(self, site: Site, topic: str) -> None:
        self._sample: Sample | None = None
        self.close = site.subscriptions.listen(topic, self._take) if topic else lambda: None

    def _take(self, sample: Sample) -> None:
        self._sample = sample

    def picture(self) -> NDArray[np.uint8] | None:
        """Return its pixels, (H, W, 3)."""
        return None if self._sample is None else pixels_rgb(self._sample.message())


def _points(message: Any, camera: Any, colours: NDArray[np.uint8] | None, budget: int) -> Points:
    depth = _depth_m(message)
    height, width = depth.shape
    every = max(1, int(np.ceil(np.sqrt(height * width / budget))))
    rows, columns = np.mgrid[0:height:every, 0:width:every]
    z = depth[::every, ::every]
    good = np.isfinite(z) & (z > 0)
    rows, columns, z = rows[good], columns[good], z[good]
    fx, fy, cx, cy = camera.k[0], camera.k[4], camera.k[2], camera.k[5]
    if not fx or not fy:
        raise StudioError("the camera_info has no focal length")
    xyz = np.stack([(columns - cx) * z / fx, (rows - cy) * z / fy, z], axis=1)
    return Points(xyz.astype(np.float32), {}, _sampled(colours, rows, columns, depth.shape))


def _sampled(
    colours: NDArray[np.uint8] | None,
    rows: NDArray[Any],
    columns: NDArray[Any],
    shape: tuple[int, ...],
) -> NDArray[np.uint32] | None:
    if colours is None:
        return None
    picked = colours[rows * colours.shape[0] // shape[0], columns * colours.shape[1] // shape[1]]
    packed = np.full((len(picked), 4), 255, np.uint8)
    packed[:, :3] = picked
    return packed.view("<u4").reshape(-1)


def _depth_m(message: Any) -> NDArray[np.float32]:
    encoding = getattr(message, "encoding", message.TYPE_NAME)
    if encoding not in (*_MILLIMETRES, _METRES):
        raise StudioError(f"'{encoding}' is no depth picture", known=(*_MILLIMETRES, _METRES))
    kind = np.dtype("f4" if encoding == _METRES else "u2")
    kind = kind.newbyteorder(">" if message.is_bigendian else "<")
    step, used = int(message.step), int(message.width) * kind.itemsize
    data = np.frombuffer(message.data, np.uint8)
    if step < used or len(data) < step * message.height or not len(data):
        raise StudioError("the depth picture brings fewer bytes than it says")
    rows = np.ascontiguousarray(data[: step * message.height].reshape(-1, step)[:, :used])
    values = rows.view(kind).astype(np.float32)
    return values if encoding == _METRES else values * np.float32(0.001)
