"""What move_base says about input that is wrong, and that it drives all the same."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from tests.nodes.move_base.test_node import _PARAMETERS, _goal
from tests.nodes.navigation.plane_world import PlaneWorld, room
from tests.patience import stretched

from gazelle.geometry import Pose
from gazelle.graph.actions import ActionClient
from gazelle.graph.tf import StampedPose, StaticTransformBroadcaster, TransformBroadcaster
from gazelle.interfaces import message_type


@pytest.fixture
def world(bench: Any) -> Iterator[PlaneWorld]:
    made = PlaneWorld(bench.node, room())
    yield made
    made.close()


def _map(resolution: float) -> Any:
    message: Any = message_type("nav_msgs/msg/OccupancyGrid")()
    message.header.frame_id = "map"
    message.info.resolution = resolution
    message.info.width = message.info.height = 4
    message.info.origin.orientation.w = 1.0
    message.data = [0] * 16
    return message


def test_bad_input_is_told_and_the_robot_drives_on(
    bench: Any, world: PlaneWorld, capfd: pytest.CaptureFixture[str]
) -> None:
    bench.node.parameters.set("/move_base", _PARAMETERS)
    bench.start("move_base/move_base")
    client = ActionClient(bench.node, "move_base", "move_base_msgs/MoveBase")
    client.require_server(stretched(20.0))
    world.start()
    scans = bench.node.create_publisher("/scan", "sensor_msgs/msg/LaserScan")
    maps = bench.node.create_publisher("/map", "nav_msgs/msg/OccupancyGrid")
    tf, fixed = TransformBroadcaster(bench.node), StaticTransformBroadcaster(bench.node)
    said: list[str] = []

    def told(words: str, again: Callable[[], object]) -> None:
        def found() -> bool:
            again()
            said.extend(capfd.readouterr())
            return words in "".join(said)

        bench.eventually(found)

    def scan(frame: str, *ranges: float) -> None:
        message = scans.message_class()
        message.header.frame_id = frame
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(world.now_ns, 10**9)
        message.ranges, message.angle_increment = list(ranges), math.tau / max(len(ranges), 1)
        message.range_min, message.range_max = 0.1, 3.5
        scans.publish(message)

    told("a LaserScan of frame 'nowhere' on scan cannot be used", lambda: scan("nowhere", 1.0))

    def bad_maps() -> None:
        for bad in (0.0, -0.05, math.nan):
            maps.publish(_map(bad))

    # The other costmap may have told of the scan before this one listens to maps.
    told("the map is left out: resolution_m is", bad_maps)
    loop = StampedPose("base_footprint", "odom", 0, Pose())

    def loops() -> None:
        tf.send(loop._replace(stamp_ns=world.now_ns))

    told("The tf tree is invalid because it contains a loop", loops)
    mended = StampedPose("map", "odom", 0, Pose((*world.drift, 0.0)))
    fixed.send(mended)
    goal = client.send_goal(_goal(4.0, 3.0))

    def arrives() -> bool:
        # It is another topic: the last loop may come after it.
        fixed.send(mended)
        scan("base_scan", *[math.nan] * 90)
        scan("base_scan")
        return bool(goal.is_done)

    bench.eventually(arrives)
    assert goal.text == "Goal reached."
    assert not world.touched
    assert bench.stop() == [0]
