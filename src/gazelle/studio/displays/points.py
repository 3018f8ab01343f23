"""LaserScan, point clouds, sensors of one number: coloured points, as many as the page wants.

Positions of large clouds go in half the bytes: 16 bits for each axis of the cloud's own cube.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry import Pose
from gazelle.studio.displays.point_colours import Colouring, ramp
from gazelle.studio.displays.topic_display import Site, open_newest
from gazelle.studio.errors import StudioError
from gazelle.studio.frame_manager import pose_values
from gazelle.studio.streams import Frame, OpenStream
from gazelle.studio.subscriptions import Sample, stamp_s

__all__ = [
    "BUDGET",
    "KIND_PACKED_POINTS",
    "KIND_POINTS",
    "PackedPositions",
    "Points",
    "budget_of",
    "open_points",
    "pack",
    "points_frame",
    "points_of",
]

_MIN_COUNT = 4096
_LEVELS = 65_535
_COARSEST_M = 0.002
KIND_POINTS = 20
KIND_PACKED_POINTS = 29

BUDGET = 100_000
"""Points of one message that a page gets unless it says otherwise."""

_MAX_BUDGET = 5_000_000
# By sensor_msgs/PointField's numbers.
_FIELD_TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}


class PackedPositions(NamedTuple):
    """Positions as whole numbers: ``origin_m + step_m * levels``.

    Attributes:
        origin_m: x, y and z of the cube's lowest corner.
        step_m: metres per level.
        levels: (N, 3) uint16.
    """

    origin_m: float
    step_m: float
    levels: NDArray[np.uint16]


def pack(xyz: NDArray[np.float32]) -> PackedPositions | None:
    """Return positions packed; None where that saves little or would move points by millimetres.

    Args:
        xyz: (N, 3) finite positions, metres.
    """
    if len(xyz) < _MIN_COUNT:
        return None
    values = np.ravel(xyz)
    low, high = float(values.min()), float(values.max())
    step = (high - low) / _LEVELS
    if not step <= _COARSEST_M:
        return None
    if step == 0.0:
        step = 1.0
    # One step for all axes: passes over plain arrays are much faster than over rows of three.
    levels = values * np.float32(1.0 / step)
    levels += np.float32(0.5 - low / step)
    np.clip(levels, 0.0, _LEVELS, out=levels)
    return PackedPositions(low, step, levels.astype(np.uint16).reshape(xyz.shape))


class Points(NamedTuple):
    """Points of a message, decimated and finite.

    Attributes:
        xyz: (N, 3) float32, metres, in the message's frame.
        channels: name → (N,) values.
        rgb: (N,) packed RGBA, None where the message has no colours.
        total: points of the message, those left out included.
    """

    xyz: NDArray[np.float32]
    channels: dict[str, NDArray[Any]]
    rgb: NDArray[np.uint32] | None = None
    total: int = 0


def open_points(site: Site) -> OpenStream:
    """Display of points of any of these messages."""
    colouring = Colouring.read(site.params)
    budget = budget_of(site)

    def make(sample: Sample) -> Frame:
        message = site.headed(sample)
        pose = site.pose(message.header)
        wanted = (colouring.channel,) if colouring.transformer in ("", "Intensity") else ()
        points = points_of(message, budget, wanted, colouring.transformer in ("", "RGB8"))
        return points_frame(points, pose, colouring, stamp_s(message, sample.time_s))

    return open_newest(site, make)


def budget_of(site: Site) -> int:
    """Return the most points that a page wants of one message."""
    return site.params.whole("Point Budget", BUDGET, least=1, most=_MAX_BUDGET)


def points_of(message: Any, budget: int, channels: tuple[str, ...], with_rgb: bool) -> Points:
    """Return points of a message, evenly chosen.

    Args:
        message: ``LaserScan``, ``PointCloud2``, ``PointCloud``, or one of a sensor of one number.
        budget: most points.
        channels: fields that are wanted, where there are such.
        with_rgb: colours are wanted, where there are some.

    Raises:
        StudioError: the message is of another type, or contradicts itself.
    """
    read = _READERS.get(message.TYPE_NAME)
    if read is None:
        raise StudioError(f"{message.TYPE_NAME} holds no points", known=_READERS)
    return read(message, budget, channels, with_rgb)


def points_frame(points: Points, pose: Pose, colouring: Colouring, at_s: float) -> Frame:
    """Return the frame of points at a pose in the fixed frame."""
    count = len(points.xyz)
    head = np.array([*pose_values(pose), points.total or count], np.float32)
    colours = _colours(points, pose, colouring)
    packed = pack(points.xyz)
    if packed is None:
        return Frame(KIND_POINTS, count, at_s, (head, points.xyz, colours))
    cube = np.array([packed.origin_m, packed.step_m], np.float32)
    parts = (head, cube, colours, packed.levels)
    return Frame(KIND_PACKED_POINTS, count, at_s, parts)


def _from_cloud2(message: Any, budget: int, channels: tuple[str, ...], with_rgb: bool) -> Points:
    fields = {one.name: one for one in message.fields}
    missing = [name for name in "xyz" if name not in fields]
    if missing:
        text = f"the cloud has no field '{missing[0]}'"
        raise StudioError(text, known=tuple(fields))
    cloud = _Cloud(message, budget)
    xyz = cloud.positions(fields)
    wanted = {name: cloud.column(fields[name]) for name in channels if name in fields}
    colour = next((fields[name] for name in ("rgb", "rgba") if name in fields), None)
    rgb = _packed_rgb(cloud.column(colour, "u4")) if with_rgb and colour is not None else None
    return _finite(Points(xyz, wanted, rgb, cloud.total))


class _Cloud:
    """Looks at every k-th point of a cloud's bytes."""

    def __init__(self, message: Any, budget: int) -> None:
        self._data = message.data
        self._order = ">" if message.is_bigendian else "<"
        self._step = int(message.point_step)
        self._size = len(self._data)
        width, height, row = int(message.width), int(message.height), int(message.row_step)
        count = width * height
        if count and (self._step < 1 or self._size < count * self._step):
            raise StudioError(
                f"the cloud says {width}×{height} points of {self._step} bytes, but brings "
                f"{self._size} bytes"
            )
        if height > 1 and row > width * self._step and self._size >= row * height:
            self._data = _without_padding(self._data, height, row, width * self._step)
            self._size = len(self._data)
        self.total = count
        self._every = max(1, -(-count // budget))
        self.count = -(-count // self._every)

    def positions(self, fields: dict[str, Any]) -> NDArray[np.float32]:
        x, y, z = (fields[name] for name in "xyz")
        together = y.offset == x.offset + 4 and z.offset == x.offset + 8
        if together and all(one.datatype == 7 for one in (x, y, z)):
            # As items of twelve bytes they are copied twice as fast as as rows of three.
            packed = np.ascontiguousarray(self._view(int(x.offset), "V12")).view(np.uint8)
            return packed.view(self._order + "f4").reshape(-1, 3).astype(np.float32, copy=False)
        columns = [self.column(one) for one in (x, y, z)]
        return np.ascontiguousarray(np.stack(columns, axis=1), np.float32)

    def column(self, field: Any, kind: str = "") -> NDArray[Any]:
        kind = kind or _FIELD_TYPES.get(field.datatype, "")
        if not kind:
            raise StudioError(f"field '{field.name}' is of the unknown type {field.datatype}")
        return self._view(int(field.offset), self._order + kind)

    def _view(self, offset: int, kind: str) -> NDArray[Any]:
        item = np.dtype(kind)
        if offset + item.itemsize > self._step:
            raise StudioError("a field of the cloud lies outside of its points")
        if not self.count:
            # Nothing that it says of its points needs to be true.
            return np.empty(0, item)
        strides = (self._step * self._every,)
        return np.ndarray((self.count,), item, self._data, offset, strides)


def _from_scan(message: Any, budget: int, channels: tuple[str, ...], _with_rgb: bool) -> Points:
    ranges = np.asarray(message.ranges, np.float32)
    every = max(1, -(-len(ranges) // budget))
    ways = _directions(len(ranges), message.angle_min, message.angle_increment)[::every]
    ranges = ranges[::every]
    good = (ranges >= message.range_min) & (ranges <= message.range_max)
    xyz = np.zeros((int(good.sum()), 3), np.float32)
    xyz[:, :2] = ways[good] * ranges[good, None]
    intensities = np.asarray(message.intensities, np.float32)[::every]
    found = {"intensity": intensities[good]} if len(intensities) == len(ranges) else {}
    return Points(xyz, {name: values for name, values in found.items() if name in channels})


def _from_cloud(message: Any, budget: int, channels: tuple[str, ...], with_rgb: bool) -> Points:
    every = max(1, math.ceil(len(message.points) / budget))
    chosen = message.points[::every]
    xyz = np.array([(one.x, one.y, one.z) for one in chosen], np.float32).reshape(-1, 3)
    named = {one.name: np.asarray(one.values, np.float32)[::every] for one in message.channels}
    fitting = {name: values for name, values in named.items() if len(values) == len(xyz)}
    wanted = {name: fitting[name] for name in channels if name in fitting}
    rgb = None
    if with_rgb and "rgb" in fitting:
        rgb = _packed_rgb(np.ascontiguousarray(fitting["rgb"]).view(np.uint32))
    return _finite(Points(xyz, wanted, rgb, len(message.points)))


def _from_reading(message: Any, _budget: int, channels: tuple[str, ...], _with_rgb: bool) -> Points:
    """A sensor of one number is a point in its own frame, as in RViz."""
    name = message.FIELDS[1].name
    values = {name: np.array([getattr(message, name)])}
    xyz = np.zeros((1, 3), np.float32)
    return Points(xyz, {name: found for name, found in values.items() if name in channels})


def _colours(points: Points, pose: Pose, colouring: Colouring) -> NDArray[np.uint32]:
    chosen = colouring.transformer
    if points.rgb is not None and chosen in ("", "RGB8"):
        return points.rgb
    values = points.channels.get(colouring.channel)
    if values is not None and chosen in ("", "Intensity"):
        return ramp(values, colouring.bounds, colouring.colours)
    if chosen == "AxisColor":
        values = points.xyz[:, colouring.axis]
        if colouring.in_fixed_frame:
            row = pose.matrix()[colouring.axis].astype(np.float32)
            values = points.xyz @ row[:3] + row[3]
        return ramp(values, colouring.axis_bounds, colouring.colours)
    return np.full(len(points.xyz), colouring.flat, np.uint32)


def _without_padding(data: Any, height: int, row: int, used: int) -> NDArray[np.uint8]:
    flat = np.frombuffer(data, np.uint8, row * height)
    return np.ascontiguousarray(flat.reshape(height, row)[:, :used]).reshape(-1)


def _packed_rgb(values: NDArray[Any]) -> NDArray[np.uint32]:
    """PCL packs blue into the lowest byte, the page wants red there."""
    bgr = np.asarray(values, np.uint32)
    red_blue = (bgr & 0xFF) << 16 | bgr >> 16 & 0xFF
    return np.asarray(red_blue | bgr & 0xFF00 | 0xFF000000, np.uint32)


def _finite(points: Points) -> Points:
    """Points that measured nothing are NaN; most clouds have none of them."""
    good = np.isfinite(points.xyz)
    if good.all():
        return points
    kept = good.all(axis=1)
    return Points(
        points.xyz[kept],
        {name: values[kept] for name, values in points.channels.items()},
        None if points.rgb is None else points.rgb[kept],
        points.total,
    )


@lru_cache(maxsize=16)
def _directions(count: int, first_rad: float, step_rad: float) -> NDArray[np.float32]:
    angles = first_rad + step_rad * np.arange(count)
    return np.stack([np.cos(angles), np.sin(angles)], axis=1).astype(np.float32)


_READERS: dict[str, Callable[[Any, int, tuple[str, ...], bool], Points]] = {
    "sensor_msgs/msg/FluidPressure": _from_reading,
    "sensor_msgs/msg/Illuminance": _from_reading,
    "sensor_msgs/msg/LaserScan": _from_scan,
    "sensor_msgs/msg/PointCloud": _from_cloud,
    "sensor_msgs/msg/PointCloud2": _from_cloud2,
    "sensor_msgs/msg/RelativeHumidity": _from_reading,
    "sensor_msgs/msg/Temperature": _from_reading,
}
