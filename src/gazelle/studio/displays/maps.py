"""Map: an occupancy grid with its updates."""

from __future__ import annotations

from collections import deque
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry import Pose
from gazelle.studio.displays.showing import Site, open_newest
from gazelle.studio.errors import StudioError
from gazelle.studio.frames import pose_values
from gazelle.studio.stamps import stamp_s
from gazelle.studio.streams import Frame, OpenStream
from gazelle.studio.taps import Sample

__all__ = ["KIND_MAP", "open_map"]

KIND_MAP = 21
_REFRESH_S = 0.5
_MOST_UPDATES = 1000


def open_map(site: Site) -> OpenStream:
    """Display Map; it moves along when its frame moves in the fixed one."""
    grid = _Grid(site)
    stream = open_newest(site, grid.frame, refresh_s=_REFRESH_S)
    leave = site.studio.taps.listen(f"{site.params.text('topic')}_updates", grid.update)

    def close() -> None:
        leave()
        stream.close()

    return OpenStream(close)


class _Grid:
    def __init__(self, site: Site) -> None:
        self._site = site
        self._source: Sample | None = None
        self._message: Any = None
        self._cells: NDArray[np.int8] = np.zeros((0, 0), np.int8)
        self._told: Any = None
        self._version = 0
        self._updates: deque[Sample] = deque(maxlen=_MOST_UPDATES)

    def update(self, sample: Sample) -> None:
        """Keep a part of the map for the next frame; runs in the transport's thread."""
        self._updates.append(sample)

    def frame(self, sample: Sample) -> Frame | None:
        """Return the map, None when it is as it was sent last."""
        if sample is not self._source:
            self._load(sample)
        while self._updates:
            self._apply(self._updates.popleft().message())
        message = self._message
        origin = message.info.origin
        at, turn = origin.position, origin.orientation
        # A grid does not wait for tf of its own stamp: map servers stamp it once.
        T_fixed_map = self._newest_pose(message.header)
        pose = T_fixed_map @ Pose((at.x, at.y, at.z), _unit(turn.x, turn.y, turn.z, turn.w))
        state = (self._version, pose)
        if state == self._told:
            return None
        self._told = state
        height, width = self._cells.shape
        head = np.zeros(12, np.float32)
        head[:7] = pose_values(pose)
        head[7] = message.info.resolution
        head[8:10] = np.array([width, height], np.uint32).view(np.float32)
        at_s = stamp_s(message, sample.time_s)
        return Frame(KIND_MAP, width * height, at_s, (head, self._cells.tobytes()))

    def _apply(self, message: Any) -> None:
        """Put a part over the map; one that does not fit is left out, as in RViz."""
        if not hasattr(message, "x"):
            return
        part = np.asarray(message.data, np.int8)
        rows = slice(message.y, message.y + message.height)
        columns = slice(message.x, message.x + message.width)
        place = self._cells[rows, columns]
        if place.size == part.size and part.size:
            self._cells[rows, columns] = part.reshape(place.shape)
            self._version += 1

    def _newest_pose(self, header: Any) -> Pose:
        newest = type(header)(frame_id=header.frame_id)
        return self._site.pose(newest)

    def _load(self, sample: Sample) -> None:
        message: Any = sample.message()
        if not hasattr(message, "info"):
            raise StudioError(f"{sample.raw.type_name} is no map")
        width, height = int(message.info.width), int(message.info.height)
        cells = np.array(message.data, np.int8)
        if cells.size != width * height or not cells.size:
            raise StudioError(f"the map says {width}×{height} cells, but brings {cells.size}")
        self._source, self._message = sample, message
        self._cells = cells.reshape(height, width)
        self._version += 1


def _unit(x: float, y: float, z: float, w: float) -> tuple[float, float, float, float]:
    """Map servers that leave the orientation at zero mean none."""
    length = float(np.sqrt(x * x + y * y + z * z + w * w))
    return (0.0, 0.0, 0.0, 1.0) if length == 0 else (x / length, y / length, z / length, w / length)
