"""Map: an occupancy grid with its updates; of what changes only the part that did is sent."""

from __future__ import annotations

import contextlib
import itertools
import threading
from collections import deque
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry import Pose
from gazelle.interfaces.poses import unit_pose_of
from gazelle.studio.displays.topic_display import Site, open_newest
from gazelle.studio.errors import StudioError
from gazelle.studio.frame_manager import pose_values
from gazelle.studio.streams import Frame, OpenStream
from gazelle.studio.subscriptions import Sample, stamp_s

__all__ = ["KIND_MAP", "KIND_MAP_PART", "open_map"]

KIND_MAP, KIND_MAP_PART = 21, 30
_REFRESH_S = 0.5
# A page that is hidden for long asks for no frames; what waits then is put in place meanwhile.
_MAX_UPDATES = 100
_NUMBERS = itertools.count(1)


def open_map(site: Site) -> OpenStream:
    """Display Map; it moves along when its frame moves in the fixed one."""
    grid = _Grid(site)
    topic, listen = site.params.text("topic"), site.subscriptions.listen
    # The grid hears of a map before it is asked for a frame of it.
    leaves = [listen(topic, grid.base), listen(f"{topic}_updates", grid.update)]
    stream = open_newest(site, grid.frame, refresh_s=_REFRESH_S)

    def close() -> None:
        stream.close()
        for leave in leaves:
            leave()

    return OpenStream(close)


class _Rect(NamedTuple):
    """A part of a map: columns and rows from ``x, y`` up to, not including, ``right, top``."""

    x: int
    y: int
    right: int
    top: int

    def with_(self, other: _Rect) -> _Rect:
        """Return what holds both."""
        x, y = min(self.x, other.x), min(self.y, other.y)
        return _Rect(x, y, max(self.right, other.right), max(self.top, other.top))


class _Grid:
    def __init__(self, site: Site) -> None:
        self._site = site
        self._lock = threading.Lock()
        self._newest: tuple[int, Sample] | None = None
        self._source = 0
        self._message: Any = None
        self._cells: NDArray[np.int8] = np.zeros((0, 0), np.int8)
        self._number = 0
        self._told: tuple[int, float, Pose] | None = None
        self._changed: _Rect | None = None
        self._updates: deque[tuple[int, Sample]] = deque(maxlen=10 * _MAX_UPDATES)

    def base(self, sample: Sample) -> None:
        """A whole map has come; runs in the transport's thread."""
        self._newest = ((self._newest[0] if self._newest else 0) + 1, sample)

    def update(self, sample: Sample) -> None:
        """Keep a part of the map for the next frame; runs in the transport's thread."""
        if self._newest is None:
            return
        self._updates.append((self._newest[0], sample))
        if len(self._updates) > _MAX_UPDATES:
            # What is wrong with a map is told by its frame.
            with self._lock, contextlib.suppress(StudioError):
                self._catch_up()

    def frame(self, sample: Sample) -> Frame | None:
        """Return the map or what of it changed, None when it is as it was sent last."""
        with self._lock:
            self._catch_up()
            message = self._message
            # A grid does not wait for tf of its own stamp: map servers stamp it once.
            T_fixed_map = self._newest_pose(message.header)
            now = (self._number, message.info.resolution, T_fixed_map @ _origin(message))
            changed, self._changed = self._changed, None
            if self._told == now and changed is None:
                return None
            whole = self._told is None or self._told[0] != self._number
            self._told = now
            at_s = stamp_s(message, sample.time_s)
            if whole:
                return self._frame(KIND_MAP, now, _Rect(0, 0, *self._size), at_s)
            return self._frame(KIND_MAP_PART, now, changed or _Rect(0, 0, 0, 0), at_s)

    @property
    def _size(self) -> tuple[int, int]:
        height, width = self._cells.shape
        return width, height

    def _frame(self, kind: int, now: tuple[int, float, Pose], part: _Rect, at_s: float) -> Frame:
        number, resolution_m, pose = now
        columns, rows = part.right - part.x, part.top - part.y
        head = np.zeros(16, np.float32)
        head[:7], head[7] = pose_values(pose), resolution_m
        counts = [*self._size, number, part.x, part.y, columns, rows]
        head[8:15] = np.array(counts, np.uint32).view(np.float32)
        cells = self._cells[part.y : part.top, part.x : part.right]
        return Frame(kind, columns * rows, at_s, (head, cells.tobytes()))

    def _catch_up(self) -> None:
        newest = self._newest
        if newest is not None and newest[0] != self._source:
            self._load(newest[1])
            self._source = newest[0]
        while self._updates and self._updates[0][0] <= self._source:
            source, sample = self._updates.popleft()
            # A map that came after a part holds it already, or is another one.
            if source == self._source:
                self._apply(sample.message())

    def _apply(self, message: Any) -> None:
        """Put a part over the map; one that does not fit is left out, as in RViz."""
        if not hasattr(message, "x") or message.x < 0 or message.y < 0:
            return
        width, height = self._size
        rect = _Rect(message.x, message.y, message.x + message.width, message.y + message.height)
        part = np.asarray(message.data, np.int8)
        fits = rect.right <= width and rect.top <= height
        if not fits or not part.size or part.size != message.width * message.height:
            return
        cells = self._cells[rect.y : rect.top, rect.x : rect.right]
        cells[...] = part.reshape(cells.shape)
        self._touch(rect)

    def _touch(self, rect: _Rect) -> None:
        self._changed = rect if self._changed is None else self._changed.with_(rect)

    def _newest_pose(self, header: Any) -> Pose:
        newest = type(header)(frame_id=header.frame_id)
        return self._site.pose(newest)

    def _load(self, sample: Sample) -> None:
        message = self._site.message(sample)
        if not hasattr(message, "info"):
            raise StudioError(f"{sample.raw.type_name} is no map")
        width, height = int(message.info.width), int(message.info.height)
        cells = np.array(message.data, np.int8)
        if cells.size != width * height or not cells.size:
            raise StudioError(f"the map says {width}×{height} cells, but brings {cells.size}")
        cells = cells.reshape(height, width)
        if cells.shape != self._cells.shape:
            self._number, self._changed = next(_NUMBERS), None
        elif (rect := _difference(self._cells, cells)) is not None:
            self._touch(rect)
        self._message, self._cells = message, cells


def _difference(old: NDArray[np.int8], new: NDArray[np.int8]) -> _Rect | None:
    """Return the smallest part outside which two maps of one size are equal; None if all is."""
    differs = old != new
    rows = np.flatnonzero(differs.any(axis=1))
    if not rows.size:
        return None
    columns = np.flatnonzero(differs[rows[0] : rows[-1] + 1].any(axis=0))
    return _Rect(int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1)


def _origin(message: Any) -> Pose:
    # Map servers that leave the orientation at zero mean none.
    return unit_pose_of(message.info.origin)
