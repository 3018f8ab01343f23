"""Point clouds: ROS 1's tuples, ROS 2's arrays, moving and projecting."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.compat.clouds import point_cloud2_ros1 as ros1
from gazelle.compat.clouds import point_cloud2_ros2 as ros2
from gazelle.compat.clouds.laser_geometry import LaserProjection
from gazelle.compat.clouds.tf2_sensor_msgs import do_transform_cloud
from gazelle.interfaces import message_type, ros1_message_type

Field1 = ros1_message_type("sensor_msgs/PointField")
Field2 = message_type("sensor_msgs/PointField")
Header1 = ros1_message_type("std_msgs/Header")
Header2 = message_type("std_msgs/Header")
_Float = st.floats(width=32, allow_nan=False)


@pytest.mark.reference
def test_cloud_of_ros1_has_the_bytes_of_the_original() -> None:
    cloud = ros1.create_cloud_xyz32(Header1(frame_id="m"), [(1, 2, 3), (4, 5, math.nan)])
    assert (cloud.point_step, cloud.row_step, cloud.width, cloud.height) == (12, 24, 2, 1)
    assert (cloud.is_dense, cloud.is_bigendian, cloud.header.frame_id) == (False, False, "m")
    wanted = b"\x00\x00\x80?\x00\x00\x00@\x00\x00@@\x00\x00\x80@\x00\x00\xa0@\x00\x00\xc0\x7f"
    assert bytes(cloud.data) == wanted
    fields = [Field1("x", 0, 7, 1), Field1("i", 4, 4, 2), Field1("rgb", 16, 6, 1)]
    padded = ros1.create_cloud(Header1(), fields, [(1.5, 2, 3, 7)])
    wanted = b"\x00\x00\xc0?\x02\x00\x03" + bytes(9) + b"\x07\x00\x00\x00"
    assert padded.point_step == 20 and bytes(padded.data) == wanted
    assert list(ros1.read_points(padded)) == [(1.5, 2, 3, 7)]
    assert list(ros1.read_points(padded, ["rgb", "i"])) == [(7, 2, 3)]


def test_points_are_chosen_by_field_place_and_value() -> None:
    cloud = ros1.create_cloud_xyz32(Header1(), [(1, 2, 3), (4, 5, math.nan)])
    assert list(ros1.read_points(cloud, ("z", "x"), skip_nans=True)) == [(3.0, 1.0)]
    assert next(ros1.read_points(cloud, uvs=[(1, 0)]))[:2] == (4.0, 5.0)
    (point,) = ros1.read_points_list(cloud, skip_nans=True)
    assert (point.x, point.y, point.z) == (1, 2, 3)
    assert len(list(ros1.read_points(cloud, ["x"], skip_nans=True))) == 2
    with pytest.raises(ValueError, match=r"the cloud has no field 'rgbb'"):
        list(ros1.read_points(cloud, ["rgbb"]))
    cloud.data = cloud.data[:5]
    with pytest.raises(ValueError, match=r"have 5 bytes, 2×1 points of 12 bytes need 24"):
        list(ros1.read_points(cloud))


@given(st.lists(st.tuples(_Float, _Float, _Float), max_size=5))
def test_points_come_back_in_both_generations(points: list[tuple[float, float, float]]) -> None:
    assert list(ros1.read_points(ros1.create_cloud_xyz32(Header1(), points))) == points
    cloud = ros2.create_cloud_xyz32(Header2(), points)
    assert ros2.read_points(cloud).tolist() == points
    assert ros2.read_points_numpy(cloud).shape == (len(points), 3)


def test_big_endian_and_padded_rows_are_read() -> None:
    cloud: Any = message_type("sensor_msgs/PointCloud2")()
    cloud.fields = [Field2(name="x", offset=2, datatype=4, count=1)]
    cloud.width, cloud.height, cloud.point_step, cloud.row_step = 2, 2, 4, 10
    cloud.is_bigendian = True
    row = b"\0\0\x01\x02\0\0\x03\x04"
    cloud.data = row + b"\xff\xff" + row
    assert ros2.read_points(cloud)["x"].tolist() == [0x102, 0x304, 0x102, 0x304]
    assert list(ros1.read_points(cloud, uvs=[(1, 1)])) == [(0x304,)]


def test_arrays_of_ros2_may_be_structured_organised_and_chosen() -> None:
    fields = [
        Field2(name="x", offset=0, datatype=7, count=1),
        Field2(name="rgb", offset=4, datatype=6, count=1),
        Field2(name="n", offset=8, datatype=7, count=2),
    ]
    kind = ros2.dtype_from_fields(fields)
    assert kind.names == ("x", "rgb", "n_0", "n_1")
    points = np.zeros((3, 2), kind)
    points["x"] = [[0, 1], [2, 3], [4, math.nan]]
    cloud = ros2.create_cloud(Header2(), fields, points)
    assert (cloud.width, cloud.height, cloud.row_step) == (3, 2, 48)
    back = ros2.read_points(cloud, reshape_organized_cloud=True)
    assert back.shape == (3, 2) and back["x"][1, 1] == 3
    assert len(ros2.read_points(cloud, skip_nans=True)) == 5
    assert ros2.read_points(cloud, ["x"], uvs=[1, 2])["x"].tolist() == [1, 2]
    assert ros2.read_points_numpy(cloud, ["n_0", "n_1"]).shape == (6, 2)
    assert ros2.read_points_list(cloud, ["rgb"])[0].rgb == 0
    with pytest.raises(AssertionError, match=r"same datatype\. Use `read_points"):
        ros2.read_points_numpy(cloud)
    with pytest.raises(AssertionError, match=r"not in the fields of the PointCloud! 'rbg': .*rgb"):
        ros2.read_points(cloud, ["rbg"])
    with pytest.raises(AssertionError, match="Pass a structured NumPy array"):
        ros2.create_cloud(Header2(), fields, np.zeros((2, 3)))
    with pytest.raises(AssertionError, match="do not match for all fields"):
        ros2.create_cloud(Header2(), fields[:1], points)
    with pytest.raises(AssertionError, match="the cloud has no fields"):
        ros2.read_points_numpy(message_type("sensor_msgs/PointCloud2")())
    wrong = [Field2(name="x", datatype=9, count=1)]
    with pytest.raises(ValueError, match="field 'x' has datatype 9; known are 1 to 8"):
        ros2.create_cloud(Header2(), wrong, [])


def _turned(make: Any) -> Any:
    transform = make("geometry_msgs/TransformStamped")()
    transform.header.frame_id = "map"
    transform.transform.translation.x = 10.0
    transform.transform.rotation.z = transform.transform.rotation.w = math.sqrt(0.5)
    return transform


@pytest.mark.parametrize("make", [ros1_message_type, message_type])
def test_cloud_moves_and_keeps_its_other_fields(make: Any) -> None:
    scan = make("sensor_msgs/LaserScan")(angle_min=0.0, angle_increment=math.pi / 2, range_max=9.0)
    scan.ranges, scan.intensities = [1.0, 2.0, math.inf, math.nan, 9.0], [5.0, 6.0, 7.0, 8.0, 9.0]
    scan.header.frame_id = "laser"
    options = LaserProjection.ChannelOption
    every = options.DEFAULT | options.DISTANCE | options.TIMESTAMP
    cloud = LaserProjection().projectLaser(scan, channel_options=every)
    names = ["x", "y", "z", "intensity", "index", "distance", "stamps"]
    assert [field.name for field in cloud.fields] == names and cloud.header.frame_id == "laser"
    rows = list(ros1.read_points(cloud, ["x", "y", "intensity", "index", "distance"]))
    assert rows == [(1, 0, 5, 0, 1), (pytest.approx(0, abs=1e-6), 2, 6, 1, 2)]
    assert LaserProjection().projectLaser(scan, range_cutoff=1.5).width == 1
    moved = do_transform_cloud(cloud, _turned(make))
    assert moved.header.frame_id == "map" and type(moved) is make("sensor_msgs/PointCloud2")
    (first, second) = ros1.read_points(moved, ["x", "y", "index"])
    assert first == pytest.approx((10, 1, 0), abs=1e-6)
    assert second == pytest.approx((8, 0, 1), abs=1e-6)
    flat = ros1.create_cloud(Header1(), [Field1("a", 0, 7, 1)], [])
    with pytest.raises(ValueError, match="no x, y and z; it has a"):
        do_transform_cloud(flat, _turned(make))


def test_modules_are_found_where_programs_look(passes: Callable[..., Any]) -> None:
    passes(
        """
import rospy
import sensor_msgs.point_cloud2 as pc2
from sensor_msgs import point_cloud2
from sensor_msgs.msg import PointCloud2
from std_msgs.msg import Header
from laser_geometry import LaserProjection
from laser_geometry.laser_geometry import LaserProjection as Same
import tf2_ros, tf2_sensor_msgs
from tf2_sensor_msgs.tf2_sensor_msgs import do_transform_cloud
assert pc2 is point_cloud2 and Same is LaserProjection
cloud = pc2.create_cloud_xyz32(Header(), [(1, 2, 3)])
assert isinstance(cloud, PointCloud2) and list(pc2.read_points(cloud)) == [(1, 2, 3)]
assert tf2_ros.TransformRegistration().get(PointCloud2) is do_transform_cloud
from sensor_msgs_py import point_cloud2 as second
assert second.read_points_numpy(cloud).tolist() == [[1, 2, 3]]
"""
    )
