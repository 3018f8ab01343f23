"""Serialised messages: CDR and ROS 1's own bytes, and what nodes and pages make of them."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from tests.fuzzing.kind import Kind

from gazelle.diagnostics import Diagnostics
from gazelle.errors import GazelleError
from gazelle.graph.ros2_parameter_values import value_from_message, value_message
from gazelle.interfaces import (
    from_cdr,
    from_ros1,
    message_type,
    ros1_message_type,
    strify,
    to_cdr,
    to_plain,
    to_ros1,
)
from gazelle.nodes.map_server.occupancy_grid import grid_of_message
from gazelle.nodes.navigation.observations import cloud_points
from gazelle.studio.displays.image_encodings import PictureSettings, encoded_picture
from gazelle.studio.displays.points import points_of
from gazelle.workspace import Workspace

__all__ = ["MESSAGES"]

Use = Callable[[Any], object]


def _cdr(
    type_name: str, use: Use, path: Path, _diagnostics: Diagnostics, _workspace: Workspace
) -> None:
    message = from_cdr(message_type(type_name), path.read_bytes())
    to_cdr(message)
    to_plain(message)
    strify(message)
    use(message)


def _ros1(
    type_name: str, use: Use, path: Path, _diagnostics: Diagnostics, _workspace: Workspace
) -> None:
    message = from_ros1(ros1_message_type(type_name), path.read_bytes())
    to_ros1(message)
    to_cdr(message)
    strify(message)
    use(message)


def _nothing(_message: Any) -> None:
    """Only read it."""


def _points(message: Any) -> None:
    points_of(message, 1000, ("intensity",), True)
    try:
        cloud_points(message)
    except ValueError as error:
        # All nodes that take clouds catch it.
        raise GazelleError(str(error)) from None


def _scan(message: Any) -> None:
    points_of(message, 1000, ("intensity",), True)


def _picture(message: Any) -> None:
    encoded_picture(message, PictureSettings())


def _map(message: Any) -> None:
    try:
        grid_of_message(message)
    except ValueError as error:
        # All nodes that take maps catch it.
        raise GazelleError(str(error)) from None


def _values(message: Any) -> None:
    for one in (*message.new_parameters, *message.changed_parameters):
        value_from_message(one.value)


def _cloud(make: Callable[[str], Any]) -> Any:
    cloud = make("sensor_msgs/PointCloud2")
    cloud.header.frame_id = "lidar"
    cloud.height, cloud.width, cloud.point_step, cloud.row_step = 1, 3, 16, 48
    names = ("x", "y", "z", "intensity")
    for place, name in enumerate(names):
        field = make("sensor_msgs/PointField")
        field.name, field.offset, field.datatype, field.count = name, 4 * place, 7, 1
        cloud.fields = [*cloud.fields, field]
    cloud.data = np.arange(12, dtype=np.float32).tobytes()
    return cloud


def _grid(make: Callable[[str], Any]) -> Any:
    grid = make("nav_msgs/OccupancyGrid")
    grid.header.frame_id = "map"
    grid.info.width, grid.info.height, grid.info.resolution = 3, 2, 0.05
    grid.info.origin.orientation.w = 1.0
    grid.data = [0, 100, -1, 0, 50, 0]
    return grid


def _transforms(make: Callable[[str], Any]) -> Any:
    message = make("tf2_msgs/TFMessage")
    one = make("geometry_msgs/TransformStamped")
    one.header.frame_id, one.child_frame_id = "odom", "base_link"
    one.transform.rotation.w = 1.0
    message.transforms = [one, one]
    return message


def _event(make: Callable[[str], Any]) -> Any:
    event = make("rcl_interfaces/ParameterEvent")
    event.node = "/talker"
    rows = []
    for name, value in (("a", 1), ("b", [1.0, 2.0]), ("c", ["x", "y"]), ("d", b"\x01\x02")):
        row = make("rcl_interfaces/Parameter")
        row.name, row.value = name, value_message(value)
        rows.append(row)
    event.new_parameters, event.changed_parameters = rows[:2], rows[2:]
    return event


def _laser(make: Callable[[str], Any]) -> Any:
    scan = make("sensor_msgs/LaserScan")
    scan.angle_min, scan.angle_max, scan.angle_increment = -1.0, 1.0, 0.5
    scan.range_min, scan.range_max = 0.1, 10.0
    scan.ranges, scan.intensities = [1.0, 2.0, 3.0, 4.0, 5.0], [1.0] * 5
    return scan


def _image(encoding: str, pixel_bytes: int, make: Callable[[str], Any]) -> Any:
    image = make("sensor_msgs/Image")
    image.header.frame_id = "camera"
    image.encoding, image.width, image.height = encoding, 4, 2
    image.step = 4 * pixel_bytes
    image.data = bytes(range(8 * pixel_bytes))
    return image


def _markers(make: Callable[[str], Any]) -> Any:
    array = make("visualization_msgs/MarkerArray")
    marker = make("visualization_msgs/Marker")
    marker.ns, marker.type, marker.text = "a", 9, "hello"
    marker.points = [make("geometry_msgs/Point"), make("geometry_msgs/Point")]
    array.markers = [marker]
    return array


def _new(name: str) -> Any:
    return message_type(name.replace("/", "/msg/"))()


def _old(name: str) -> Any:
    return ros1_message_type(name)()


def _kind_cdr(make: Callable[..., Any], use: Use = _nothing) -> Kind:
    type_name = make(_new).TYPE_NAME
    return Kind(lambda: to_cdr(make(_new)), "a.cdr", partial(_cdr, type_name, use))


def _kind_ros1(make: Callable[..., Any], use: Use = _nothing) -> Kind:
    type_name = make(_old)._type
    return Kind(lambda: to_ros1(make(_old)), "a.ros1", partial(_ros1, type_name, use))


MESSAGES: dict[str, Kind] = {
    "cdr_cloud": _kind_cdr(_cloud, _points),
    "cdr_depth": _kind_cdr(partial(_image, "16UC1", 2), _picture),
    "cdr_grid": _kind_cdr(_grid, _map),
    "cdr_image": _kind_cdr(partial(_image, "rgb8", 3), _picture),
    "cdr_markers": _kind_cdr(_markers),
    "cdr_parameters": _kind_cdr(_event, _values),
    "cdr_scan": _kind_cdr(_laser, _scan),
    "cdr_tf": _kind_cdr(_transforms),
    "ros1_cloud": _kind_ros1(_cloud),
    "ros1_grid": _kind_ros1(_grid),
    "ros1_markers": _kind_ros1(_markers),
    "ros1_tf": _kind_ros1(_transforms),
}
