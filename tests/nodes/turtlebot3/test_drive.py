"""The wanderer: where it goes for what it sees."""

from __future__ import annotations

import itertools
import math

import pytest

from gazelle.interfaces import message_type
from gazelle.nodes.turtlebot3.drive import Ranges, Wanderer, ranges_of

_RIGHT, _LEFT = (0.0, -1.5), (0.0, 1.5)


def _scan(ranges, **fields):
    values = {"angle_min": 0.0, "angle_increment": 2 * math.pi / 360, "range_max": 3.5, **fields}
    return message_type("sensor_msgs/msg/LaserScan")(ranges=list(ranges), **values)


@pytest.mark.parametrize(
    ("ranges", "command"),
    [
        (Ranges(3.5, 3.5, 3.5), (0.3, 0.0)),
        (Ranges(0.69, 3.5, 3.5), _RIGHT),
        (Ranges(0.71, 0.59, 3.5), _RIGHT),
        (Ranges(0.71, 3.5, 0.59), _LEFT),
        (Ranges(0.71, 0.5, 0.5), _RIGHT),
    ],
)
def test_goes_where_it_is_free(ranges: Ranges, command: tuple[float, float]) -> None:
    wanderer = Wanderer()
    wanderer.ranges = ranges
    assert wanderer.next() is None
    assert wanderer.next() == command


def test_turn_ends_where_the_heading_goes_round_as_in_the_original() -> None:
    wanderer = Wanderer()
    wanderer.yaw_rad = -math.pi + 0.1
    assert wanderer.next() is None
    assert wanderer.next() == _RIGHT
    wanderer.yaw_rad = math.pi - 0.1
    assert wanderer.next() is None


def test_ranges_are_those_at_0_30_and_330_degrees() -> None:
    assert ranges_of(_scan(float(n) for n in range(360))) == (0.0, 30.0, 330.0)
    half = _scan((float(n) for n in range(180)), angle_increment=2 * math.pi / 180)
    assert ranges_of(half) == (0.0, 15.0, 165.0)
    ahead = _scan((float(n) for n in range(181)), angle_min=-math.pi / 2)
    assert ranges_of(ahead)[:2] == (90.0, 120.0)


def test_what_is_not_seen_is_far() -> None:
    assert ranges_of(_scan([math.inf] * 360)) == (3.5, 3.5, 3.5)
    assert ranges_of(_scan([math.nan] * 360)) == (3.5, 3.5, 3.5)
    assert ranges_of(_scan([])) == (3.5, 3.5, 3.5)


def test_node_drives_on_the_topic_of_its_parameter_and_stops_at_the_end(bench) -> None:
    bench.node.parameters.set("/cmd_vel_topic_name", "/wander")
    twists = bench.listen("/wander", "geometry_msgs/msg/Twist")
    bench.start("turtlebot3_gazebo/turtlebot3_drive")
    # Nothing seen yet counts as blocked.
    assert bench.eventually(lambda: twists)[-1].angular.z == -1.5
    odometry = message_type("nav_msgs/msg/Odometry")
    scan_out = bench.node.create_publisher("/scan", "sensor_msgs/msg/LaserScan")
    odom_out = bench.node.create_publisher("/odom", odometry)
    bench.eventually(lambda: scan_out.matched and odom_out.matched)
    headings_rad = itertools.count()

    def drives() -> bool:
        # It turns until it has turned enough, and on if it had not seen the scan by then.
        scan_out.publish(_scan([3.0] * 360))
        turned, half_rad = odometry(), next(headings_rad) / 2
        turned.pose.pose.orientation.z = math.sin(half_rad)
        turned.pose.pose.orientation.w = math.cos(half_rad)
        odom_out.publish(turned)
        return bool(twists[-1].linear.x == 0.3)

    bench.eventually(drives)
    assert bench.stop() == [0]
    bench.eventually(lambda: (twists[-1].linear.x, twists[-1].angular.z) == (0.0, 0.0))
