"""amcl on a graph."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose
from gazelle.graph.tf import StampedPose, StaticTransformBroadcaster, TransformBroadcaster
from gazelle.interfaces import message_type
from gazelle.mapping.grids import OccupancyGrid
from gazelle.navigation.localization import AmclOptions
from gazelle.nodes.amcl.node import scan_of_message
from gazelle.nodes.amcl.node_parameters import AMCL, NAV2_AMCL
from gazelle.nodes.map_server.occupancy_grid import message_of_grid
from gazelle.nodes.parameters import node_reader

_TRUE = (1.2, 2.0, 0.4)
_ELSEWHERE = (2.6, 0.9, -1.2)
_LASER = (0.1, 0.0, 0.0)


def _room() -> OccupancyGrid:
    """4 m × 3 m with a box in a corner, so that no direction looks like another."""
    cells = np.zeros((60, 80), np.int8)
    cells[[0, -1]] = 100
    cells[:, [0, -1]] = 100
    cells[40:50, 55:70] = 100
    return OccupancyGrid(cells, 0.05)


def _scan(pose: tuple[float, float, float], stamp_ns: int) -> Any:
    """What a lidar 10 cm before the robot's centre sees."""
    from gazelle.navigation.localization.amcl_kernels import cast_ray

    message = message_type("sensor_msgs/msg/LaserScan")()
    message.header.frame_id = "base_scan"
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp_ns, 1_000_000_000)
    message.angle_increment = math.tau / 180
    message.angle_max = math.tau
    message.range_min, message.range_max = 0.1, 3.5
    x, y = pose[0] + 0.1 * math.cos(pose[2]), pose[1] + 0.1 * math.sin(pose[2])
    ranges = [
        0.05 * cast_ray(_room().cells, x / 0.05, y / 0.05, pose[2] + k * math.tau / 180, 1e3)
        for k in range(180)
    ]
    message.ranges = [value if value < 3.5 else math.inf for value in ranges]
    message.ranges[7] = math.nan
    return message


class _Robot:
    """Publishes a map, transforms and scans as a robot would."""

    def __init__(self, bench: Any) -> None:
        node = bench.node
        self.now_ns = 1_000_000_000
        self.true_pose = _TRUE
        grid = message_type("nav_msgs/msg/OccupancyGrid")
        self.maps = node.create_publisher("/map", grid, latch=True)
        self.maps.publish(message_of_grid(_room(), "map", 0))
        self.scans = node.create_publisher("/scan", message_type("sensor_msgs/msg/LaserScan"))
        self.tf = TransformBroadcaster(node)
        self.fixed = StaticTransformBroadcaster(node)
        laser = Pose.from_xyz_rpy(_LASER, (0.0, 0.0, 0.0))
        self.fixed.send(StampedPose("base_footprint", "base_scan", 0, laser))

    def look(self, bench: Any, frame: str = "base_scan") -> None:
        """Stand at odometry's (0, 0, 0) and send a scan."""
        self.now_ns += 100_000_000
        self.tf.send(StampedPose("odom", "base_footprint", self.now_ns, Pose()))
        message = _scan(self.true_pose, self.now_ns)
        message.header.frame_id = frame
        self.scans.publish(message)

    def jump(self, bench: Any, metres: float) -> None:
        """Be somewhere else all of a sudden, and back."""
        for x in (0.0, metres, 0.0):
            self.now_ns += 100_000_000
            at = Pose((x, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
            self.tf.send(StampedPose("odom", "base_footprint", self.now_ns, at))
            self.scans.publish(_scan(self.true_pose, self.now_ns))

    def look_at_nothing(self, bench: Any) -> None:
        """Send a scan without a single number."""
        self.now_ns += 100_000_000
        self.tf.send(StampedPose("odom", "base_footprint", self.now_ns, Pose()))
        message = _scan(self.true_pose, self.now_ns)
        message.ranges = [math.nan] * len(message.ranges)
        self.scans.publish(message)

    def place_odometry(self, parent: str) -> None:
        """Say what odometry's frame is below."""
        self.now_ns += 100_000_000
        self.tf.send(StampedPose(parent, "odom", self.now_ns, Pose()))


def _initial(offset: float = 0.2) -> Any:
    message = message_type("geometry_msgs/msg/PoseWithCovarianceStamped")()
    message.header.frame_id = "map"
    message.pose.pose.position.x, message.pose.pose.position.y = _TRUE[0] + offset, _TRUE[1]
    message.pose.pose.orientation.z = math.sin(_TRUE[2] / 2)
    message.pose.pose.orientation.w = math.cos(_TRUE[2] / 2)
    covariance = [0.0] * 36
    covariance[0] = covariance[7] = 0.1
    covariance[35] = 0.05
    message.pose.covariance = covariance
    return message


def _near(pose: Any, true_pose: tuple[float, float, float] = _TRUE) -> bool:
    p = pose.pose.pose.position
    return math.hypot(p.x - true_pose[0], p.y - true_pose[1]) < 0.12


def test_amcl_finds_the_robot_and_sends_the_transform(bench: Any) -> None:
    robot = _Robot(bench)
    words = ["_base_frame_id:=base_footprint", "_use_map_topic:=true", "_laser_max_range:=3.5"]
    bench.start("amcl/amcl", *words, "_resample_interval:=1", "_max_particles:=800")
    poses = bench.listen("/amcl_pose", "geometry_msgs/msg/PoseWithCovarianceStamped")
    clouds = bench.listen("/particlecloud", "geometry_msgs/msg/PoseArray")
    moves: list[Any] = []
    bench.node.create_subscription(
        "/tf",
        "tf2_msgs/msg/TFMessage",
        lambda message: moves.extend(t for t in message.transforms if t.child_frame_id == "odom"),
    )
    kind = message_type("geometry_msgs/msg/PoseWithCovarianceStamped")
    given = bench.node.create_publisher("/initialpose", kind)
    bench.eventually(lambda: given.matched and robot.scans.matched)
    given.publish(_initial())

    def found() -> bool:
        bench.call("/request_nomotion_update", "std_srvs/srv/Empty")
        robot.look(bench)
        return bool(poses) and _near(poses[-1])

    bench.eventually(found)
    assert poses[-1].header.frame_id == "map"
    bench.eventually(lambda: moves and clouds)
    x, y = moves[-1].transform.translation.x, moves[-1].transform.translation.y
    assert math.hypot(x - _TRUE[0], y - _TRUE[1]) < 0.2
    assert moves[-1].header.frame_id == "map"
    stamp = moves[-1].header.stamp
    assert stamp.sec * 1_000_000_000 + stamp.nanosec > 1_100_000_000
    # Carried to a place where no particle is.
    robot.true_pose = _ELSEWHERE
    begin = len(poses)

    def found_again() -> bool:
        # Each time: a scan from the old place may still have been on its way.
        bench.call("/global_localization", "std_srvs/srv/Empty")
        robot.look(bench)
        return len(poses) > begin and _near(poses[-1], _ELSEWHERE)

    bench.eventually(found_again)
    assert bench.stop() == [0]


def test_scans_in_unknown_frames_are_told_and_the_node_stays(bench: Any, capfd: Any) -> None:
    robot = _Robot(bench)
    bench.start("amcl/amcl", "_base_frame_id:=base_footprint", "_use_map_topic:=true")
    bench.eventually(lambda: robot.scans.matched)
    said: list[str] = []

    def told() -> bool:
        robot.look(bench, frame="lidar_link")
        said.extend(capfd.readouterr())
        return "a scan in frame 'lidar_link' is left out" in "".join(said)

    bench.eventually(told)
    assert bench.stop() == [0]


def test_bad_input_is_told_and_the_robot_is_found_afterwards(bench: Any, capfd: Any) -> None:
    robot = _Robot(bench)
    bench.start(
        "amcl/amcl", "_base_frame_id:=base_footprint", "_use_map_topic:=true",
        "_resample_interval:=1", "_max_particles:=800", "_initial_pose_x:=-7.0",
    )  # fmt: skip
    poses = bench.listen("/amcl_pose", "geometry_msgs/msg/PoseWithCovarianceStamped")
    kind = message_type("geometry_msgs/msg/PoseWithCovarianceStamped")
    given = bench.node.create_publisher("/initialpose", kind)
    bench.eventually(lambda: given.matched and robot.scans.matched)
    said: list[str] = []

    def told(words: str, again: Any = lambda: None) -> None:
        def found() -> bool:
            again()
            said.extend(capfd.readouterr())
            return words in "".join(said)

        bench.eventually(found)

    told("the initial pose (-7.00, 0.00) is off the map, which is from (0.00, 0.00) to (4.00")
    broken = message_of_grid(_room(), "map", 0)
    broken.info.resolution = 0.0
    told("a map is not taken: resolution_m is 0.0, it must be above 0",
         lambda: robot.maps.publish(broken))  # fmt: skip
    wall = _initial()
    wall.pose.pose.position.x, wall.pose.pose.position.y = 3.0, 2.2
    given.publish(wall)
    told("the initial pose (3.00, 2.20) is in a wall of the map")
    nan = _initial()
    nan.pose.pose.position.x = math.nan
    given.publish(nan)
    told("Received initial pose that is no number; it is not taken")
    robot.look(bench)
    robot.jump(bench, 40.0)
    told("odometry jumped by 40.00 m", lambda: robot.jump(bench, 40.0))

    def look_in_a_loop() -> None:
        # Each time: amcl may just be sending where odometry is, because of an earlier scan.
        robot.place_odometry("base_footprint")
        robot.look(bench)

    told("its place is not known: The tf tree is invalid because it contains a loop",
         look_in_a_loop)  # fmt: skip
    robot.place_odometry("map")
    given.publish(_initial())

    def found() -> bool:
        bench.call("/request_nomotion_update", "std_srvs/srv/Empty")
        robot.look_at_nothing(bench)
        robot.look(bench)
        return bool(poses) and _near(poses[-1])

    bench.eventually(found)
    assert bench.stop() == [0]


def test_lidars_that_hang_upside_down_are_seen() -> None:
    message = _scan(_TRUE, 0)
    upright = scan_of_message(message, Pose.from_xyz_rpy((0.1, 0, 0.2), (0, 0, 0.3)))
    hanging = scan_of_message(message, Pose.from_xyz_rpy((0.1, 0, 0.2), (math.pi, 0, 0)))
    assert (upright.upside_down, hanging.upside_down) == (False, True)
    assert upright.T_base_laser == pytest.approx((0.1, 0.0, 0.3))


def test_wrong_parameters_are_told_all_at_once() -> None:
    from gazelle.nodes.amcl.node import _checked

    found = Diagnostics()
    tree = {"laser_model_type": "likelyhood_field", "odom_model_type": "diferential",
            "min_particles": 900, "max_particles": 100, "update_mind": 0.1,
            "gui_publish_rate": 10}  # fmt: skip
    settings = node_reader(AMCL, tree, "/amcl", found)
    settings.report_unknown()
    options = _checked(settings, settings.fill(AmclOptions), 1)
    assert (options.laser_model_type, options.odom_model_type) == ("likelihood_field", "diff")
    assert options.max_particles == 900
    text = "\n".join(map(str, found))
    assert "Unknown laser model type 'likelyhood_field'" in text
    assert "did you mean 'likelihood_field'" in text
    assert "min_particles to be greater than max particles" in text
    assert "'update_mind' is not one of amcl" in text
    assert "'gui_publish_rate' (10) has no effect here" in text


def test_slips_in_the_initial_pose_are_told_and_its_height_counts_for_nothing() -> None:
    found = Diagnostics()
    tree = {"initial_pose": {"x": 1.0, "yow": 2.0, "z": 0.5}}
    node_reader(NAV2_AMCL, tree, "/amcl", found).report_unknown()
    assert [item.message for item in found] == [
        "/amcl: parameter 'initial_pose.yow' is not one of nav2_amcl; it has no effect",
        "/amcl: parameter 'initial_pose.z' (0.5) has no effect here: the ground is flat",
    ]


def test_nav2s_names_and_defaults_are_known() -> None:
    found = Diagnostics()
    settings = node_reader(NAV2_AMCL, {"alpha1": 0.5, "max_beams": 20}, "/amcl", found)
    options = settings.fill(AmclOptions)
    assert (options.odom_alpha1, options.laser_max_beams) == (0.5, 20)
    assert (options.max_particles, options.laser_z_hit) == (2000, 0.5)
    assert options.odom_model_type == "nav2_amcl::DifferentialMotionModel"
