"""What messages of sensors show."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.nodes.navigation.observations import cloud_points, observation_of

_LASER = Pose((1.0, 0.0, 0.2), (0.0, 0.0, math.sin(math.pi / 4), math.cos(math.pi / 4)))


def _scan(*ranges: float):
    return message_type("sensor_msgs/msg/LaserScan")(
        ranges=list(ranges), angle_min=0.0, angle_increment=math.pi / 2, range_min=0.1,
        range_max=3.5,
    )  # fmt: skip


def _cloud(points, *, big: bool = False, fields: str = "xyz", kind: int = 7):
    field = message_type("sensor_msgs/msg/PointField")
    size = 4 if kind == 7 else 8
    data = np.array(points, (">" if big else "<") + f"f{size}").tobytes()
    return message_type("sensor_msgs/msg/PointCloud2")(
        fields=[field(name=n, offset=size * i, datatype=kind, count=1)
                for i, n in enumerate(fields)],
        width=len(points), height=1, point_step=3 * size, row_step=3 * size * len(points),
        is_bigendian=big, data=data,
    )  # fmt: skip


def test_beams_end_where_the_lidar_says() -> None:
    seen = observation_of(_scan(2.0, 1.0, math.inf, math.nan), _LASER)
    assert seen.origin == (1.0, 0.0, 0.2)
    np.testing.assert_allclose(seen.points, [[1.0, 2.0, 0.2], [0.0, 0.0, 0.2]], atol=1e-9)
    assert seen.ends is not None
    assert len(seen.ends) == 0


@pytest.mark.parametrize("bad", [0.05, 3.5, 9.0, -1.0, 0.0])
def test_ranges_beyond_the_limits_are_nothing(bad) -> None:
    assert len(observation_of(_scan(bad), _LASER).points) == 0


def test_infinite_beams_clear_where_they_are_valid() -> None:
    seen = observation_of(_scan(math.inf), Pose(), inf_is_valid=True)
    assert seen.ends is not None
    np.testing.assert_allclose(seen.ends, [[3.4999, 0.0, 0.0]])


def test_clouds_of_both_byte_orders_and_sizes_are_read() -> None:
    points = [[1.0, 2.0, 3.0], [math.nan, 0.0, 0.0], [4.0, 5.0, 6.0]]
    for big in (False, True):
        for kind in (7, 8):
            found = cloud_points(_cloud(points, big=big, kind=kind))
            np.testing.assert_array_equal(found, [points[0], points[2]])


def test_clouds_that_cannot_be_read_say_why() -> None:
    with pytest.raises(ValueError, match="the cloud has fields a, b, c, not x, y and z"):
        cloud_points(_cloud([[0.0] * 3], fields="abc"))
    short = _cloud([[0.0] * 3])
    short.width = 9
    with pytest.raises(ValueError, match="the cloud says 9 points and has 12 bytes"):
        cloud_points(short)
    whole = _cloud([[0.0] * 3])
    whole.fields[0].datatype = 5
    with pytest.raises(ValueError, match="field x of the cloud is no float"):
        cloud_points(whole)


def test_another_frame_may_be_the_sensors() -> None:
    seen = observation_of(_scan(1.0), _LASER, origin=Pose((9.0, 9.0, 1.0)))
    assert seen.origin == (9.0, 9.0, 1.0)
