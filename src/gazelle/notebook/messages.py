"""Messages of topics: those with a picture as one, all others as a table of their fields."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from gazelle.interfaces.message_base import MessageBase
from gazelle.interfaces.poses import pose_of_transform
from gazelle.notebook.cameras import pixels_bundle
from gazelle.notebook.charts import chart_bundle
from gazelle.notebook.clouds import cloud_bundle
from gazelle.notebook.frames import Edge, frame_tree
from gazelle.notebook.html_parts import figure, number_text, table
from gazelle.notebook.joint_motions import joint_lines
from gazelle.notebook.maps import grid_bundle, path_bundle
from gazelle.notebook.scans import polar_bundle
from gazelle.rich_display import Bundle

__all__ = ["field_rows", "message_bundle"]

_MAX_ROWS = 120
_MAX_ITEMS = 8


def message_bundle(message: MessageBase) -> Bundle:
    """Return a message of either version of ROS."""
    renderer = _RENDERERS.get(message.TYPE_NAME)
    if renderer is not None:
        bundle = renderer(message)
        if bundle:
            return bundle
    return _fields_bundle(message)


def field_rows(message: Any, prefix: str = "") -> Iterator[tuple[str, str]]:
    """Yield names and values of a message's fields, those of messages inside with their path."""
    for item in message.FIELDS:
        value: Any = getattr(message, item.name, None)
        name = f"{prefix}{item.name}"
        if hasattr(value, "FIELDS"):
            yield from field_rows(value, f"{name}.")
        elif _is_list(value) and len(value) and hasattr(value[0], "FIELDS"):
            for number, inner in enumerate(value[:_MAX_ITEMS]):
                yield from field_rows(inner, f"{name}[{number}].")
            if len(value) > _MAX_ITEMS:
                yield f"{name}[…]", f"{len(value)} items"
        else:
            yield name, _value_text(value)


def _fields_bundle(message: MessageBase) -> Bundle:
    rows = []
    for row in field_rows(message):
        rows.append(row)
        if len(rows) > _MAX_ROWS:
            rows[-1] = ("…", "")
            break
    return {"text/html": figure(table((), rows), message.TYPE_NAME)}


def _value_text(value: Any) -> str:
    if isinstance(value, str):
        return number_text(value)
    if _is_list(value):
        if len(value) > _MAX_ITEMS:
            return f"{len(value)} items: {_items_text(value[:_MAX_ITEMS])}, …"
        return f"[{_items_text(value)}]"
    if hasattr(value, "to_sec"):
        return f"{value.to_sec():.9g} s"
    return number_text(value)


def _items_text(values: Any) -> str:
    return ", ".join(number_text(one) for one in values)


def _is_list(value: Any) -> bool:
    return isinstance(value, list | tuple | bytes | bytearray | np.ndarray)


def _image(message: Any) -> Bundle:
    from gazelle.studio.displays.image_encodings import pixels_rgb

    caption = f"{message.width}×{message.height} {message.encoding}{_frame_text(message)}"
    return pixels_bundle(pixels_rgb(message), caption)


def _compressed_image(message: Any) -> Bundle:
    import io

    from PIL import Image

    from gazelle.studio.displays.image_encodings import PictureSettings, encoded_picture

    jpeg = encoded_picture(message, PictureSettings()).jpeg
    with Image.open(io.BytesIO(jpeg)) as image:
        pixels = np.asarray(image.convert("RGB"))
    return pixels_bundle(
        pixels, f"{message.format}, {len(message.data)} bytes{_frame_text(message)}"
    )


def _laser_scan(message: Any) -> Bundle:
    ranges = np.asarray(message.ranges, np.float64)
    far = (ranges < message.range_min) | (ranges > message.range_max)
    bearings = message.angle_min + message.angle_increment * np.arange(len(ranges))
    return polar_bundle(bearings, np.where(far, np.nan, ranges))


def _cloud(message: Any) -> Bundle:
    from gazelle.studio.displays.points import points_of

    xyz = points_of(message, 200_000, (), False).xyz
    return cloud_bundle(xyz, f"{message.TYPE_NAME}{_frame_text(message)}")


def _occupancy_grid(message: Any) -> Bundle:
    from gazelle.mapping.grids import OccupancyGrid

    info = message.info
    if not info.width or not info.height:
        return {}
    cells = np.asarray(message.data, np.int8).reshape(info.height, info.width)
    return grid_bundle(OccupancyGrid(cells, float(info.resolution) or 1.0))


def _path(message: Any) -> Bundle:
    places = [one.pose.position for one in message.poses]
    return path_bundle([(one.x, one.y) for one in places], _frame_text(message).lstrip(", "))


def _pose_array(message: Any) -> Bundle:
    places = [(one.position.x, one.position.y) for one in message.poses]
    return path_bundle(places, _frame_text(message).lstrip(", "))


def _joint_trajectory(message: Any) -> Bundle:
    if not message.points:
        return {}
    times = [_seconds(one.time_from_start) for one in message.points]
    positions = np.array([list(one.positions) for one in message.points], np.float64)
    lines = joint_lines(message.joint_names, times, positions)
    words = f"{len(message.joint_names)} joints, {len(times)} points"
    return chart_bundle(lines, y_label="position, rad or m", caption=words)


def _joint_state(message: Any) -> Bundle:
    columns = [("position", message.position), ("velocity", message.velocity)]
    columns.append(("effort", message.effort))
    shown = [(name, values) for name, values in columns if len(values) == len(message.name)]
    rows = [
        (name, *(float(values[number]) for _, values in shown))
        for number, name in enumerate(message.name)
    ]
    return {
        "text/html": figure(table(("joint", *(name for name, _ in shown)), rows), message.TYPE_NAME)
    }


def _transforms(message: Any) -> Bundle:
    edges = []
    for one in message.transforms:
        x, y, z = pose_of_transform(one.transform).position_m
        remark = f"{x:.3f} {y:.3f} {z:.3f} m"
        edges.append(Edge(one.header.frame_id, one.child_frame_id, remark))
    return {"text/html": figure(frame_tree(edges), f"{len(edges)} transforms")}


def _diagnostic_array(message: Any) -> Bundle:
    words = {0: "OK", 1: "WARN", 2: "ERROR", 3: "STALE"}
    rows = []
    for one in message.status:
        level = one.level if isinstance(one.level, int) else int.from_bytes(one.level, "little")
        values = ", ".join(f"{pair.key}={pair.value}" for pair in one.values)
        rows.append((words.get(level, level), one.name, one.message, values))
    return {"text/html": figure(table(("", "name", "message", "values"), rows), message.TYPE_NAME)}


def _seconds(duration: Any) -> float:
    if hasattr(duration, "to_sec"):
        return float(duration.to_sec())
    return float(duration.sec + duration.nanosec * 1e-9)


def _frame_text(message: Any) -> str:
    frame = message.header.frame_id
    return f", frame {frame}" if frame else ""


_RENDERERS: dict[str, Callable[[Any], Bundle]] = {
    "diagnostic_msgs/msg/DiagnosticArray": _diagnostic_array,
    "geometry_msgs/msg/PoseArray": _pose_array,
    "nav_msgs/msg/OccupancyGrid": _occupancy_grid,
    "nav_msgs/msg/Path": _path,
    "sensor_msgs/msg/CompressedImage": _compressed_image,
    "sensor_msgs/msg/Image": _image,
    "sensor_msgs/msg/JointState": _joint_state,
    "sensor_msgs/msg/LaserScan": _laser_scan,
    "sensor_msgs/msg/PointCloud": _cloud,
    "sensor_msgs/msg/PointCloud2": _cloud,
    "tf2_msgs/msg/TFMessage": _transforms,
    "trajectory_msgs/msg/JointTrajectory": _joint_trajectory,
}
