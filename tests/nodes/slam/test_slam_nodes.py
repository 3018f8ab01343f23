"""SLAM nodes on a robot that drives about in a room of 6 × 4 m."""

from __future__ import annotations

import itertools
import math
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.errors import LaunchError
from gazelle.geometry import Pose
from gazelle.graph.tf import StampedPose, TransformBroadcaster, TransformBuffer, TransformListener
from gazelle.interfaces import message_type, service_type
from gazelle.mapping.grids import read_map
from gazelle.nodes.host import run_node

POSES = [(0.1 * k - 1, 0.05 * k - 0.5, 0.05 * k) for k in range(20)]
# Where odometry began in the room.
START = POSES[0]


def _ranges(x: float, y: float, yaw: float) -> list[float]:
    angles = yaw + np.radians(np.arange(0, 360, 2))
    cos, sin = np.cos(angles), np.sin(angles)
    with np.errstate(divide="ignore"):
        across = np.where(cos > 0, (3 - x) / cos, (-3 - x) / cos)
        along = np.where(sin > 0, (2 - y) / sin, (-2 - y) / sin)
    return list(np.minimum(across, along))


class Robot:
    """Sends scans and transforms of the drive."""

    def __init__(self, bench: Any, capfd: pytest.CaptureFixture[str]) -> None:
        self.bench, self.base = bench, "base_footprint"
        self.console, self.said = capfd, ""
        self.tf = TransformBroadcaster(bench.node)
        self.scans = bench.node.create_publisher("/scan", "sensor_msgs/msg/LaserScan")
        self.buffer = TransformBuffer()
        self.listener = TransformListener(self.buffer, bench.node)
        self.stamp_ns = bench.node.clock.now_ns() - 2_000_000_000

    def ready(self) -> None:
        self.bench.eventually(lambda: self.scans.matched)
        self.bench.eventually(lambda: self.tf._publisher.matched)

    def begin(self, maps: list[Any]) -> None:
        """Be at the start until the first map comes: the map begins with the first scan heard."""
        self.ready()

        def is_mapped() -> bool:
            self.step(START)
            return bool(maps)

        self.bench.eventually(is_mapped)

    def step(self, pose: tuple[float, float, float], **scan: Any) -> None:
        self.stamp_ns += 50_000_000
        x, y, yaw = pose
        turn = (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))
        at = Pose((x, y, 0.0), turn)
        self.tf.send(
            [
                StampedPose("odom", self.base, self.stamp_ns, at),
                StampedPose(self.base, "laser", self.stamp_ns, Pose((0.0, 0.0, 0.2))),
            ]
        )
        values = {"angle_increment": math.radians(2), "range_min": 0.1, "range_max": 20.0,
                  "ranges": _ranges(*pose), **scan}  # fmt: skip
        frame = values.pop("frame", "laser")
        message = message_type("sensor_msgs/msg/LaserScan")(**values)
        message.header.frame_id = frame
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(self.stamp_ns, 10**9)
        self.scans.publish(message)

    def heard(self, text: str) -> Callable[[], str]:
        """What was said on the console, once that holds a text."""

        def said() -> str:
            out, error = self.console.readouterr()
            self.said += out + error
            return self.said if text in self.said else ""

        return said


@pytest.fixture
def robot(bench: Any, capfd: pytest.CaptureFixture[str]) -> Iterator[Robot]:
    made = Robot(bench, capfd)
    yield made
    made.listener.close()


def _grid(message: Any) -> np.ndarray:
    return np.array(message.data).reshape(message.info.height, message.info.width)


FAST = ("_map_update_interval:=0.1", "_base_frame:=base_footprint")
TOOLBOX = (*FAST, "_minimum_travel_distance:=0.2", "_minimum_time_interval:=0.0")


@pytest.mark.parametrize(
    ("node", "words"),
    [
        ("gmapping/slam_gmapping", ("_linearUpdate:=0.2", "_angularUpdate:=0.2")),
        ("slam_karto/slam_karto", ()),
        ("hector_mapping/hector_mapping", ("_map_frame:=map", "_map_pub_period:=0.1")),
        ("cartographer_ros/cartographer_node", ("_tracking_frame:=base_footprint",)),
        ("slam_toolbox/async_slam_toolbox_node", TOOLBOX),
    ],
)
def test_a_room_is_mapped_under_every_name(
    bench: Any, robot: Robot, node: str, words: tuple[str, ...]
) -> None:
    maps = bench.listen("/map", "nav_msgs/msg/OccupancyGrid")
    bench.start(node, *FAST, *words)
    robot.begin(maps)
    for pose in POSES:
        robot.step(pose)
    bench.eventually(lambda: robot.buffer.can_transform("map", "odom"))
    # A node that is behind drops scans of a drive that takes no time, as real ones do.
    further = itertools.cycle((*reversed(POSES), *POSES))

    def is_whole() -> bool:
        """The room is as wide as it is, and its walls are nearly closed, 20 m of them."""
        robot.step(next(further))
        if not maps:
            return False
        info = maps[-1].info
        walls_m = (_grid(maps[-1]) == 100).sum() * info.resolution
        return bool(abs(info.width * info.resolution - 6) < 0.4 and 14 < walls_m < 40)

    bench.eventually(is_whole)
    assert set(np.unique(_grid(maps[-1]))) <= {-1, 0, 100}
    assert maps[-1].header.frame_id == "map"
    # Map and odometry agree at the start; the room's left wall is at −3 m of it.
    assert maps[-1].info.origin.position.x == pytest.approx(-3 - 0.05, abs=0.15)


def test_the_frame_of_the_map_is_there_before_the_engine_is_compiled(
    bench: Any, robot: Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    waited = threading.Event()
    monkeypatch.setattr("gazelle.nodes.slam.node.warm_up", waited.wait)
    bench.start("gmapping/slam_gmapping", *FAST)
    try:
        bench.eventually(lambda: robot.buffer.can_transform("map", "odom"))
    finally:
        waited.set()


def test_its_use_sim_time_counts_before_there_is_a_simulator(
    bench: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    waited = threading.Event()
    monkeypatch.setattr("gazelle.nodes.slam.node.warm_up", waited.wait)
    sent = bench.listen("/tf", "tf2_msgs/msg/TFMessage")
    clock = bench.node.create_publisher("/clock", "rosgraph_msgs/msg/Clock")
    seconds = itertools.count(1)

    def is_told() -> bool:
        message = message_type("rosgraph_msgs/msg/Clock")()
        message.clock.sec = next(seconds)
        clock.publish(message)
        return bool(sent)

    bench.start("slam_toolbox/async_slam_toolbox_node", *TOOLBOX, "_use_sim_time:=true")
    try:
        bench.eventually(lambda: bench.graph.clock.use_sim_time)
        bench.eventually(is_told)
    finally:
        waited.set()
    last = next(seconds)
    assert all(one.header.stamp.sec <= last for message in sent for one in message.transforms)


def test_dynamic_map_and_metadata_tell_the_same_map(bench: Any, robot: Robot) -> None:
    about = bench.listen("/map_metadata", "nav_msgs/msg/MapMetaData")
    bench.start("gmapping/slam_gmapping", *FAST)
    robot.ready()
    robot.step(START)
    info = bench.eventually(lambda: about)[-1]
    answer = bench.call("/dynamic_map", "nav_msgs/srv/GetMap")
    assert (answer.map.info.width, answer.map.info.height) == (info.width, info.height)
    assert answer.map.header.frame_id == "map"


@pytest.mark.parametrize(
    ("scan", "words"),
    [
        ({"frame": "nowhere"}, "a scan in frame 'nowhere' is dropped"),
        ({"ranges": [math.nan] * 180}, "no beam of the scan met anything"),
        ({"angle_increment": 0.0}, "beams have no directions"),
    ],
)
def test_bad_scans_are_told_and_the_node_stays(
    bench: Any, robot: Robot, scan: dict[str, Any], words: str
) -> None:
    maps = bench.listen("/map", "nav_msgs/msg/OccupancyGrid")
    bench.start("gmapping/slam_gmapping", *FAST)
    robot.ready()
    for _ in range(35 if "frame" in scan else 1):
        robot.step(START, **scan)
    bench.eventually(robot.heard(words))
    for _ in range(3):
        robot.step(START)
    bench.eventually(lambda: maps)
    assert bench.stop() == [0]


def test_a_jump_of_odometry_is_told_and_does_not_move_the_robot(bench: Any, robot: Robot) -> None:
    bench.start("gmapping/slam_gmapping", *FAST, "_transform_publish_period:=0.01")
    robot.ready()
    robot.step(START)
    robot.step(START)
    room, robot_ranges = START, _ranges(*START)
    jumped = (room[0] + 30.0, room[1], room[2])
    robot.step(jumped, ranges=robot_ranges)
    told = bench.eventually(robot.heard("odometry jumped by 30.00 m"))
    assert "looked for there by its scans" in told

    def is_moved() -> bool:
        if not robot.buffer.can_transform("map", "odom"):
            return False
        x = robot.buffer.lookup_transform("map", "odom").pose.position_m[0]
        return abs(x + 30.0) < 0.2

    bench.eventually(is_moved)


def test_parameters_without_effect_are_refused_with_a_reason(bench: Any, robot: Robot) -> None:
    bench.start("gmapping/slam_gmapping", "_particles:=100", "_linearUpdat:=0.5", "_delta:=-1")
    assert "graph of poses, not a filter" in bench.eventually(robot.heard("'particles' (100)"))
    assert "did you mean 'linearUpdate'" in bench.eventually(robot.heard("'linearUpdat'"))
    bench.eventually(robot.heard("parameter 'delta' is -1"))


def test_slam_toolbox_saves_serialises_and_localises(
    bench: Any, robot: Robot, tmp_path: Path
) -> None:
    maps = bench.listen("/map", "nav_msgs/msg/OccupancyGrid")
    bench.start("slam_toolbox/async_slam_toolbox_node", *TOOLBOX)
    robot.begin(maps)
    for pose in POSES:
        robot.step(pose)
    stem = tmp_path / "room"
    name = message_type("std_msgs/msg/String")(data=str(stem))
    assert bench.call("/slam_toolbox/save_map", "slam_toolbox/srv/SaveMap", name=name).result == 0
    assert read_map(Path(f"{stem}.yaml"), Diagnostics()) is not None
    kind = "slam_toolbox/srv/SerializePoseGraph"
    assert bench.call("/slam_toolbox/serialize_map", kind, filename=str(stem)).result == 0
    assert Path(f"{stem}.posegraph").is_file()
    kind = "slam_toolbox/srv/DeserializePoseGraph"
    assert bench.call("/slam_toolbox/deserialize_map", kind, filename="/no/such").result == 255
    bench.eventually(robot.heard("/no/such.posegraph cannot be read"))
    middle = message_type("geometry_msgs/msg/Pose2D")(x=0.0, y=0.0, theta=0.5)
    answer = bench.call(
        "/slam_toolbox/deserialize_map", kind, filename=str(stem), match_type=3,
        initial_pose=middle,
    )  # fmt: skip
    assert answer.result == 0
    robot.step(POSES[10])

    def located() -> bool:
        if not robot.buffer.can_transform("map", "odom"):
            return False
        T_map_odom = robot.buffer.lookup_transform("map", "odom").pose
        x, y, _ = (T_map_odom @ Pose((*POSES[10][:2], 0.0))).position_m
        return math.dist((x, y), POSES[10][:2]) < 0.1

    bench.eventually(located)
    assert bench.call("/slam_toolbox/pause_new_measurements", "slam_toolbox/srv/Pause").status


def test_a_wrong_mode_is_refused(bench: Any) -> None:
    job = {"node": "slam_toolbox/async_slam_toolbox_node", "argv": ["_mode:=localisation"]}
    with pytest.raises(LaunchError, match="'localisation'; did you mean 'localization'"):
        run_node(job, bench.graph, threading.Event())


def test_services_of_slam_toolbox_have_its_types() -> None:
    assert service_type("slam_toolbox/srv/SaveMap").Response().result == 0
