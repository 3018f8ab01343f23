"""Messages as arrays and back, as ros_numpy's documentation has it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gazelle.compat.ros_numpy import geometry, msgify, numpify, point_cloud2
from gazelle.interfaces import message_type, ros1_message_type


def ros1(name: str) -> Any:
    return ros1_message_type(name)


@pytest.mark.parametrize("make", [ros1, message_type])
@pytest.mark.parametrize(
    ("encoding", "kind", "shape"),
    [
        ("rgb8", np.uint8, (3, 5, 3)),
        ("mono8", np.uint8, (3, 5)),
        ("16UC1", np.uint16, (3, 5)),
        ("32FC1", np.float32, (3, 5)),
        ("64FC4", np.float64, (3, 5, 4)),
    ],
)
def test_images_survive_the_way_there_and_back(
    make: Any, encoding: str, kind: Any, shape: Any
) -> None:
    pixels = np.arange(np.prod(shape)).reshape(shape).astype(kind)
    image = msgify(make("sensor_msgs/Image"), pixels, encoding=encoding)
    assert (image.height, image.width, image.encoding) == (3, 5, encoding)
    assert image.step * 3 == len(bytes(image.data)) == pixels.nbytes
    again = numpify(image)
    assert again.dtype == pixels.dtype
    np.testing.assert_array_equal(again, pixels)


def test_rows_with_a_gap_and_big_endian_values_are_read() -> None:
    data = bytes([0, 1, 0, 2, 9, 9, 0, 3, 0, 4, 9, 9])
    image = ros1("sensor_msgs/Image")(
        height=2, width=2, encoding="mono16", is_bigendian=1, step=6, data=data
    )
    assert numpify(image).tolist() == [[1, 2], [3, 4]]
    image.data = data[:9]
    with pytest.raises(ValueError, match="have 9 bytes, 2×2 mono16 with step 6 needs 10"):
        numpify(image)


@pytest.mark.parametrize(
    ("pixels", "encoding", "text"),
    [
        (np.zeros((2, 2, 3), np.uint8), "rgba8", "Array has 3 channels, rgba8 requires 4"),
        (np.zeros((2, 2), float), "mono8", "Array is float64, mono8 requires uint8"),
        (np.zeros(2, np.uint8), "mono8", "must be two or three dimensional"),
        (np.zeros((2, 2), np.uint8), "momo8", r"Unrecognized image encoding \[momo8\]; .*mono8"),
    ],
)
def test_array_that_is_no_such_image_is_refused(pixels: Any, encoding: str, text: str) -> None:
    with pytest.raises(TypeError, match=text):
        msgify(ros1("sensor_msgs/Image"), pixels, encoding=encoding)


@pytest.mark.parametrize("make", [ros1, message_type])
def test_clouds_survive_the_way_there_and_back(make: Any) -> None:
    kind = [("x", "f4"), ("y", "f4"), ("z", "f4"), ("ring", "u2"), ("n", "f4", (2,))]
    points = np.zeros(4, kind)
    points["x"] = [1, 2, np.nan, 4]
    points["ring"] = [7, 8, 9, 10]
    points["n"][3] = [5, 6]
    made = msgify(make("sensor_msgs/PointCloud2"), points, frame_id="lidar")
    assert (made.height, made.width, made.point_step, made.row_step) == (1, 4, 22, 88)
    assert (made.header.frame_id, made.is_dense) == ("lidar", False)
    assert [(one.name, one.offset, one.datatype, one.count) for one in made.fields] == [
        ("x", 0, 7, 1),
        ("y", 4, 7, 1),
        ("z", 8, 7, 1),
        ("ring", 12, 4, 1),
        ("n", 14, 7, 2),
    ]
    again = numpify(made)
    assert again.shape == (4,) and again["n"][3].tolist() == [5, 6]
    assert numpify(made, squeeze=False).shape == (1, 4)
    xyz = point_cloud2.pointcloud2_to_xyz_array(made)
    assert xyz.tolist() == [[1, 0, 0], [2, 0, 0], [4, 0, 0]]
    assert len(point_cloud2.get_xyz_points(again, remove_nans=False)) == 4
    assert numpify(made.fields, point_step=22).names == ("x", "y", "z", "ring", "n")
    made.data = bytes(made.data)[:50]
    with pytest.raises(ValueError, match="have 50 bytes, 4×1 points of 22 bytes need 88"):
        numpify(made)


def test_colours_are_packed_as_pcl_does() -> None:
    points = np.array([(1.0, 255, 128, 1)], [("x", "f4"), ("r", "u1"), ("g", "u1"), ("b", "u1")])
    packed = point_cloud2.merge_rgb_fields(points)
    assert packed.dtype.names == ("x", "rgb")
    assert packed["rgb"].view(np.uint32)[0] == 0xFF8001
    assert point_cloud2.split_rgb_field(packed).tolist() == [(1.0, 255, 128, 1)]


def test_unknown_cells_of_a_map_are_masked() -> None:
    grid = ros1("nav_msgs/OccupancyGrid")(data=[0, 100, -1, 50, -1, 0])
    grid.info.width, grid.info.height = 3, 2
    cells = numpify(grid)
    assert cells.shape == (2, 3) and cells.mask.tolist() == [[0, 0, 1], [0, 1, 0]]
    assert cells.max() == 100 and cells.min() == 0
    again = msgify(ros1("nav_msgs/OccupancyGrid"), cells, info=grid.info)
    assert list(again.data) == [0, 100, -1, 50, -1, 0]
    with pytest.raises(TypeError, match="Array must be of int8s, this one is of float64"):
        msgify(ros1("nav_msgs/OccupancyGrid"), np.zeros((2, 2)))


@pytest.mark.parametrize("make", [ros1, message_type])
def test_poses_are_homogeneous_matrices(make: Any) -> None:
    pose = make("geometry_msgs/Pose")()
    pose.position.x, pose.orientation.z, pose.orientation.w = 2.0, np.sqrt(0.5), np.sqrt(0.5)
    matrix = numpify(pose)
    np.testing.assert_allclose(matrix @ [1, 0, 0, 1], [2, 1, 0, 1], atol=1e-12)
    transform = msgify(make("geometry_msgs/Transform"), matrix)
    assert transform.translation.x == 2.0
    np.testing.assert_allclose(numpify(transform), matrix, atol=1e-12)
    several = msgify(make("geometry_msgs/Pose"), np.stack([np.eye(4), matrix]))
    assert several.shape == (2,) and several[1].position.x == 2.0
    with pytest.raises(ValueError, match=r"a 4×4 matrix, this array is of shape \(3, 3\)"):
        msgify(make("geometry_msgs/Pose"), np.eye(3))


def test_vectors_and_points_differ_when_homogeneous() -> None:
    vector, point = ros1("geometry_msgs/Vector3"), ros1("geometry_msgs/Point")
    assert numpify(vector(1, 2, 3), hom=True).tolist() == [1, 2, 3, 0]
    assert numpify(point(1, 2, 3), hom=True).tolist() == [1, 2, 3, 1]
    assert msgify(point, np.array([2, 4, 6, 2])) == point(1, 2, 3)
    assert isinstance(geometry.numpy_to_vector3(np.arange(3)), vector)
    assert msgify(vector, np.zeros((2, 3))).tolist() == [vector(), vector()]
    with pytest.raises(ValueError, match="the fourth value of a homogeneous vector is 0"):
        msgify(vector, np.ones(4))
    with pytest.raises(ValueError, match="a quaternion has 4 values"):
        msgify(ros1("geometry_msgs/Quaternion"), np.ones(3))


def test_other_types_are_refused_with_those_there_are() -> None:
    with pytest.raises(ValueError, match="Unable to convert message std_msgs/msg/String - only"):
        numpify(ros1("std_msgs/String")())
    with pytest.raises(ValueError, match="Unable to build message sensor_msgs/msg/Imu"):
        msgify(ros1("sensor_msgs/Imu"), np.zeros(3))
    with pytest.raises(ValueError, match="empty Collection"):
        numpify([])
    assert numpify(None) is None


def test_ros_numpy_is_importable_in_nodes(passes: Callable[..., Any]) -> None:
    passes("""
import numpy as np
import ros_numpy, rospy
from ros_numpy.point_cloud2 import array_to_pointcloud2, pointcloud2_to_xyz_array
from ros_numpy import geometry, image, numpy_msg, occupancy_grid
from sensor_msgs.msg import Image, PointCloud2
from rospy.numpy_msg import numpy_msg as by_rospy
assert numpy_msg is by_rospy
cloud = array_to_pointcloud2(np.zeros(3, [(n, np.float32) for n in 'xyz']),
                             stamp=rospy.Time(5), frame_id='a')
assert isinstance(cloud, PointCloud2) and cloud.header.stamp.secs == 5
assert pointcloud2_to_xyz_array(cloud).shape == (3, 3)
picture = ros_numpy.msgify(Image, np.zeros((2, 2, 3), np.uint8), encoding='bgr8')
assert ros_numpy.numpify(picture).shape == (2, 2, 3)
assert ros_numpy.numpify(numpy_msg(Image)(height=1, width=1, step=1, encoding='mono8',
                                          data=b'x')).tolist() == [[120]]
""")
