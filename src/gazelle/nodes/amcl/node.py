"""``amcl``: finds the robot in a map (ROS 1 noetic; Nav2's ``nav2_amcl``)."""

from __future__ import annotations

import math
import re
import threading
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.errors import GraphError
from gazelle.geometry import Pose
from gazelle.graph import Graph, Node
from gazelle.graph.gazebo_names import world_names
from gazelle.graph.tf import StampedPose, TransformBroadcaster, TransformError
from gazelle.interfaces import message_type, service_type
from gazelle.interfaces.poses import set_plane_pose, unit_pose_of
from gazelle.interfaces.stamps import ns_of, set_header
from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.se2 import between, compose, inverse
from gazelle.navigation.localization import MOTION_MODELS, Amcl, AmclOptions, Estimate
from gazelle.nodes.amcl.node_parameters import AMCL, NAV2_AMCL
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.lifecycle import Lifecycle
from gazelle.nodes.map_server.occupancy_grid import grid_of_message
from gazelle.nodes.navigation.robot_pose import Frames, PlanePose
from gazelle.nodes.parameters import (
    log_findings,
    node_reader,
    offer_dynamic_reconfigure,
    parameter_tree,
    start_node,
)
from gazelle.parameters.reader import ParameterReader

__all__ = ["AmclNode", "AmclPublisher", "InitialPoseHint", "run", "run_ros2", "scan_of_message"]


_FAR_M, _FAR_RAD = 0.3, math.radians(20)
_NANO = 1_000_000_000
_TF_PATIENCE_S = 0.2
_POLL_S = 0.2
_MAP_RETRY_S = 0.5
_JUMP_M = 1.0
_JUMP_M_S = 5.0
_SENSOR_MODELS = ("beam", "likelihood_field", "likelihood_field_prob")


class AmclPublisher:
    """``amcl_pose``, ``particlecloud`` or ``particle_cloud``, and the transform."""

    def __init__(self, node: Node, frame_id: str, odom_frame: str, ros_version: int) -> None:
        """Offer the topics."""
        self._frame_id, self._odom_frame, self._ros_version = frame_id, odom_frame, ros_version
        pose = message_type("geometry_msgs/msg/PoseWithCovarianceStamped")
        self._poses = node.create_publisher("amcl_pose", pose, latch=True, queue_size=2)
        kind = "nav2_msgs/msg/ParticleCloud" if ros_version == 2 else "geometry_msgs/msg/PoseArray"
        topic = "particle_cloud" if ros_version == 2 else "particlecloud"
        self._cloud = node.create_publisher(topic, message_type(kind), latch=True, queue_size=2)
        self._tf = TransformBroadcaster(node)

    def pose(self, estimate: Estimate, stamp_ns: int) -> None:
        """Publish where the robot is."""
        message: Any = message_type("geometry_msgs/msg/PoseWithCovarianceStamped")()
        set_header(message, stamp_ns, self._frame_id)
        set_plane_pose(message.pose.pose, estimate.pose)
        covariance = np.zeros((6, 6))
        covariance[:2, :2] = estimate.covariance[:2, :2]
        covariance[5, 5] = estimate.covariance[2, 2]
        message.pose.covariance = covariance.ravel().tolist()
        self._poses.publish(message)

    def cloud(
        self, particles: NDArray[np.float64], weights: NDArray[np.float64], now_ns: int
    ) -> None:
        """Publish the particles while somebody listens.

        Args:
            particles: x (m), y (m) and yaw (rad) of each in the map's frame, (n, 3).
            weights: of each, (n,).
            now_ns: stamp of the message.
        """
        if not self._cloud.matched:
            return
        poses = []
        kind = message_type("geometry_msgs/msg/Pose")
        for particle_pose in particles.tolist():
            pose: Any = kind()
            set_plane_pose(pose, particle_pose)
            poses.append(pose)
        message: Any
        if self._ros_version == 2:
            particle = message_type("nav2_msgs/msg/Particle")
            message = message_type("nav2_msgs/msg/ParticleCloud")()
            message.particles = [
                particle(pose=pose, weight=float(weight))
                for pose, weight in zip(poses, weights, strict=True)
            ]
        else:
            message = message_type("geometry_msgs/msg/PoseArray")()
            message.poses = poses
        set_header(message, now_ns, self._frame_id)
        self._cloud.publish(message)

    def transform(self, T_map_odom: PlanePose, stamp_ns: int) -> None:
        """Publish the transform from map to odometry."""
        x, y, yaw = T_map_odom
        pose = Pose.from_xyz_rpy((x, y, 0.0), (0.0, 0.0, yaw))
        self._tf.send(StampedPose(self._frame_id, self._odom_frame, stamp_ns, pose))


class InitialPoseHint:
    """Tells once where a simulated robot stands when that is not where amcl begins."""

    def __init__(self, node: Node, begins: PlanePose, *, is_ros2: bool) -> None:
        """Listen to the simulator, if there is one."""
        self._node, self._begins = node, begins
        shown, hidden = world_names("/gazebo/model_states")
        self._subscriptions: list[Any] = []
        # Who listens to a name shows it, too.
        self._subscriptions = [
            node.create_subscription(
                topic, "gazebo_msgs/msg/ModelStates", self._on_states, queue_size=1
            )
            for topic in ((hidden,) if is_ros2 else (shown, hidden))
        ]

    def close(self) -> None:
        """Listen no more."""
        subscriptions, self._subscriptions = self._subscriptions, []
        for subscription in subscriptions:
            subscription.unregister()

    def _on_states(self, message: Any) -> None:
        index = self._robot(list(message.name))
        if not self._subscriptions or index is None:
            return
        self.close()
        x, y, yaw = unit_pose_of(message.pose[index]).xy_yaw
        bx, by, byaw = self._begins
        turn = abs(math.remainder(yaw - byaw, math.tau))
        if math.hypot(x - bx, y - by) < _FAR_M and turn < _FAR_RAD:
            return
        self._node.log(
            "warn",
            f"nobody gave an initial pose, so amcl begins at ({bx:.2f}, {by:.2f}, {byaw:.2f}); the "
            f"simulator has '{message.name[index]}' at ({x:.2f}, {y:.2f}, {yaw:.2f}). If the map's "
            "frame is the world's: set the parameters initial_pose_x, initial_pose_y and "
            "initial_pose_a to that, or give it with RViz's 2D Pose Estimate",
        )

    def _robot(self, names: list[str]) -> int | None:
        """Return which model is the robot: the one the description names, if there is one."""
        text = str(self._node.parameters.get("/robot_description", "") or "")
        found = re.search(r"<robot\b[^>]*\bname\s*=\s*[\"']([^\"']+)", text)
        if found and found[1] in names:
            return names.index(found[1])
        return None


class AmclNode:
    """The filter with its topics, services and transforms."""

    def __init__(self, node: Node, tree: dict[str, Any], ros_version: int) -> None:
        """Read the parameters; nothing is listened to before `start`."""
        found = Diagnostics()
        self._node, self._ros_version = node, ros_version
        table = NAV2_AMCL if ros_version == 2 else AMCL
        self._settings = node_reader(table, tree, node.resolve_name("~"), found)
        self._settings.report_unknown()
        self._options = _checked(self._settings, self._settings.fill(AmclOptions), ros_version)
        s = self._settings
        self._map_frame = s.text("global_frame_id").removeprefix("/")
        self._odom_frame = s.text("odom_frame_id").removeprefix("/")
        self._base_frame = s.text("base_frame_id").removeprefix("/")
        self._tolerance_ns = int(s.number("transform_tolerance") * _NANO)
        self._sends_tf = s.flag("tf_broadcast")
        self._first_map_only = s.flag("first_map_only")
        self._uses_topic = ros_version == 2 or s.flag("use_map_topic")
        rate = s.number("save_pose_rate")
        self._save_ns = int(_NANO / rate) if rate > 0 else None
        self._forces = ros_version == 1 and s.flag("force_update_after_initialpose")
        self._forces_map = ros_version == 1 and s.flag("force_update_after_set_map")
        self._filter = Amcl(self._options, zlib.crc32(node.name.encode()))
        self._lock = threading.RLock()
        self._frames = Frames(node)
        self._out = AmclPublisher(node, self._map_frame, self._odom_frame, ros_version)
        self._running = False
        self._placed = ros_version == 1 or s.flag("set_initial_pose")
        self._T_map_odom: PlanePose | None = None
        self._odometry: tuple[PlanePose, int] | None = None
        self._saved_ns = 0
        self._hint: InitialPoseHint | None = None
        offer_dynamic_reconfigure(node, node.resolve_name("~"), self._settings, self._reconfigure)
        log_findings(node, found)

    def start(self) -> None:
        """Listen and answer."""
        node, first = self._node, not self._running
        self._running = True
        if not first or self._hint is not None:
            return
        begins = (
            self._options.initial_pose_x,
            self._options.initial_pose_y,
            self._options.initial_pose_a,
        )
        if not self._was_given():
            self._hint = InitialPoseHint(node, begins, is_ros2=self._ros_version == 2)
        empty = service_type("std_srvs/srv/Empty")
        ros2 = self._ros_version == 2
        everywhere = "reinitialize_global_localization" if ros2 else "global_localization"
        node.create_service(everywhere, empty, self._on_everywhere)
        node.create_service("request_nomotion_update", empty, self._on_nomotion)
        if ros2:
            kind = service_type("nav2_msgs/srv/SetInitialPose")
            node.create_service("set_initial_pose", kind, self._on_set_pose)
        else:
            node.create_service("set_map", service_type("nav_msgs/srv/SetMap"), self._on_set_map)
        self._listen(ros2)

    def stop(self) -> None:
        """Take nothing in for now."""
        self._running = False

    def close(self) -> None:
        """Listen no more."""
        with self._lock:
            self._running = False
        if self._hint is not None:
            self._hint.close()

    def ask_for_map(self) -> None:
        """Ask ``static_map`` unless there is a map, or maps come by topic."""
        if self._uses_topic or self._filter.has_map:
            return
        kind = service_type("nav_msgs/srv/GetMap")
        client = self._node.create_client("static_map", kind)
        try:
            if client.wait_for_service(_MAP_RETRY_S):
                self._take_map(client.call(kind.Request(), timeout_s=10.0).map)
            else:
                text = f"Request for map failed; trying again... ({client.name} is not there: is a "
                self._frames.say("warn", f"{text}map_server running?)", key="static_map")
        except GraphError as error:
            self._frames.say("warn", f"Request for map failed; trying again... ({error})")
        finally:
            self._node.drop(client)

    def _listen(self, ros2: bool) -> None:
        node, s = self._node, self._settings
        scans = s.text("scan_topic") if ros2 else "scan"
        node.create_subscription(scans, "sensor_msgs/msg/LaserScan", self._on_scan, queue_size=2)
        kind = "geometry_msgs/msg/PoseWithCovarianceStamped"
        node.create_subscription("initialpose", kind, self._on_initial_pose, queue_size=2)
        if self._uses_topic:
            topic = s.text("map_topic") if ros2 else "map"
            node.create_subscription(
                topic, "nav_msgs/msg/OccupancyGrid", self._on_map, queue_size=1
            )

    def _was_given(self) -> bool:
        if self._ros_version == 2:
            return self._settings.has("set_initial_pose")
        names = ("initial_pose_x", "initial_pose_y", "initial_pose_a")
        return any(self._settings.has(name) for name in names)

    def _reconfigure(self, values: dict[str, Any]) -> None:
        found = Diagnostics()
        tree = {**self._settings.tree, **values}
        table = self._settings.table
        self._settings = node_reader(table, tree, self._node.resolve_name("~"), found)
        with self._lock:
            options = self._settings.fill(AmclOptions)
            self._options = _checked(self._settings, options, self._ros_version)
            self._filter.set_options(self._options)
        log_findings(self._node, found)

    def _on_map(self, message: Any) -> None:
        if self._running and not (self._first_map_only and self._filter.has_map):
            self._take_map(message)

    def _take_map(self, message: Any) -> None:
        try:
            grid = grid_of_message(message)
        except ValueError as error:
            self._frames.say("error", f"a map is not taken: {error}")
            return
        frame = str(message.header.frame_id).removeprefix("/")
        if frame != self._map_frame:
            self._node.log(
                "warn",
                f"Frame_id of map received:'{frame}' doesn't match global_frame_id:"
                f"'{self._map_frame}'. This could cause issues with reading published topics",
            )
        with self._lock:
            self._filter.set_map(grid)
        o = self._options
        if self._was_given():
            self._tell_problem((o.initial_pose_x, o.initial_pose_y, o.initial_pose_a))
        size = f"{grid.width} X {grid.height}"
        self._node.log("info", f"Received a {size} map @ {grid.resolution_m:.3f} m/pix")

    def _on_set_map(self, request: Any) -> Any:
        self._take_map(request.map)
        self._on_initial_pose(request.initial_pose)
        if self._forces_map:
            self._filter.request_update()
        return service_type("nav_msgs/srv/SetMap").Response(success=True)

    def _on_set_pose(self, request: Any) -> Any:
        self._on_initial_pose(request.pose)
        return service_type("nav2_msgs/srv/SetInitialPose").Response()

    def _on_everywhere(self, _request: Any) -> Any:
        try:
            with self._lock:
                self._filter.spread_everywhere()
            self._placed = True
            self._node.log("info", "Initializing with uniform distribution")
            self._node.log("info", "Global initialisation done!")
        except ValueError as error:
            self._node.log("error", f"global_localization: {error}")
        return service_type("std_srvs/srv/Empty").Response()

    def _on_nomotion(self, _request: Any) -> Any:
        with self._lock:
            self._filter.request_update()
        return service_type("std_srvs/srv/Empty").Response()

    def _on_initial_pose(self, message: Any) -> None:
        frame = str(message.header.frame_id).removeprefix("/")
        if not frame:
            text = "Received initial pose with empty frame_id. You should always supply a frame_id."
            self._node.log("warn", text)
        elif frame != self._map_frame:
            self._node.log(
                "warn",
                f'Ignoring initial pose in frame "{frame}"; initial poses must be in the global '
                f'frame, "{self._map_frame}"',
            )
            return
        pose = unit_pose_of(message.pose.pose).xy_yaw
        covariance = np.asarray(message.pose.covariance, float).reshape(6, 6)
        covariance = covariance[np.ix_([0, 1, 5], [0, 1, 5])]
        if not (np.isfinite(pose).all() and np.isfinite(covariance).all()):
            self._node.log("error", "Received initial pose that is no number; it is not taken")
            return
        pose = self._moved_since(pose, ns_of(message.header.stamp))
        text = f"Setting pose: ({pose[0]:.3f} {pose[1]:.3f} {pose[2]:.3f})"
        self._node.log("info", text)
        with self._lock:
            self._filter.initialise(pose, covariance)
            if self._forces:
                self._filter.request_update()
        self._tell_problem(pose)
        self._placed = True
        if self._hint is not None:
            self._hint.close()

    def _tell_problem(self, pose: PlanePose) -> None:
        """Say when no robot can be at an initial pose."""
        problem = self._filter.problem_at(pose[0], pose[1])
        if problem:
            self._node.log(
                "warn",
                f"the initial pose ({pose[0]:.2f}, {pose[1]:.2f}) is {problem}: is it "
                "another map's, or does the map's frame begin elsewhere?",
            )

    def _moved_since(self, pose: PlanePose, stamp_ns: int) -> PlanePose:
        """Return a pose, moved along with odometry since its time."""
        then = self._frames.between(self._odom_frame, self._base_frame, stamp_ns)
        now = self._frames.between(self._odom_frame, self._base_frame)
        if stamp_ns == 0 or isinstance(then, str) or isinstance(now, str):
            return pose
        return _triple(compose(pose, between(then.xy_yaw, now.xy_yaw)))

    def _on_scan(self, message: Any) -> None:
        if not self._running:
            return
        if not self._placed:
            text = "AMCL cannot publish a pose or update the transform. Please set the initial pose"
            self._frames.say("warn", f"{text}...", key="initial pose")
            return
        frame, stamp_ns = (
            str(message.header.frame_id).removeprefix("/"),
            ns_of(message.header.stamp),
        )
        try:
            laser = self._frames.buffer.lookup_transform(self._base_frame, frame)
            found = self._frames.buffer.lookup_transform(
                self._odom_frame, self._base_frame, stamp_ns, timeout_s=_TF_PATIENCE_S
            )
        except TransformError as error:
            text = f"a scan in frame '{frame}' is left out, its place is not known: {error}"
            self._frames.say("warn", text, key=f"scan {frame}")
            return
        odometry = found.pose.xy_yaw
        self._tell_jumps(odometry, stamp_ns)
        scan = scan_of_message(message, laser.pose)
        if scan.range_max_m <= 0 or scan.range_min_m < 0:
            text = "range_max or range_min from laser is negative! ignore this message."
            self._frames.say("error", text)
            return
        if not self._filter.has_map:
            self._frames.say("warn", "scans wait for a map", key="no map")
            return
        with self._lock:
            estimate = self._filter.update(odometry, scan, frame)
            particles, weights = self._filter.particles, self._filter.weights
            # Not after `close`, which takes the topics off the graph.
            if self._running:
                self._publish(estimate, odometry, stamp_ns, particles, weights)

    def _publish(
        self,
        estimate: Estimate | None,
        odometry: PlanePose,
        stamp_ns: int,
        particles: NDArray[np.float64],
        weights: NDArray[np.float64],
    ) -> None:
        if estimate is not None:
            if estimate.resampled or self._T_map_odom is None:
                self._out.pose(estimate, stamp_ns)
                self._T_map_odom = _triple(compose(estimate.pose, inverse(odometry)))
            self._out.cloud(particles, weights, self._node.clock.now_ns())
        if self._sends_tf and self._T_map_odom is not None:
            self._out.transform(self._T_map_odom, stamp_ns + self._tolerance_ns)
        self._save(odometry)

    def _tell_jumps(self, odometry: PlanePose, stamp_ns: int) -> None:
        """Say when odometry is somewhere else all of a sudden."""
        last, self._odometry = self._odometry, (odometry, stamp_ns)
        if last is None:
            return
        way = math.hypot(odometry[0] - last[0][0], odometry[1] - last[0][1])
        time_s = max(stamp_ns - last[1], 0) / _NANO
        if way > _JUMP_M + _JUMP_M_S * time_s:
            self._frames.say(
                "warn",
                f"odometry jumped by {way:.2f} m within {time_s:.2f} s; the particles go along. If "
                "the robot is lost now, give initialpose or call global_localization",
                key="odometry jump",
            )

    def _save(self, odometry: PlanePose) -> None:
        """Keep the pose as parameters, for the next start."""
        now_ns = self._node.clock.now_ns()
        if self._save_ns is None or self._T_map_odom is None:
            return
        if 0 <= now_ns - self._saved_ns < self._save_ns:
            return
        self._saved_ns = now_ns
        pose = compose(self._T_map_odom, odometry)
        for name, value in zip("xya", pose, strict=True):
            full = self._node.resolve_name(f"~initial_pose_{name}")
            self._node.parameters.set(full, float(value))


def scan_of_message(message: Any, T_base_laser: Pose) -> Scan:
    """Return a scan whose lidar stands, or hangs, at a place on the robot."""
    _x, _y, z_axis = T_base_laser.transform(np.array([[0.0, 0.0, 1.0]]))[0] - np.array(
        T_base_laser.position_m
    )
    return Scan(
        ns_of(message.header.stamp),
        float(message.angle_min),
        float(message.angle_increment),
        np.asarray(message.ranges, np.float32),
        float(message.range_min),
        float(message.range_max),
        T_base_laser.xy_yaw,
        upside_down=bool(z_axis < 0),
    )


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """ROS 1: localise until told to stop."""
    node = start_node(arguments, graph)
    amcl = AmclNode(node, parameter_tree(node, arguments), ros_version=1)
    amcl.start()
    arguments.ready()
    while not stop.wait(_MAP_RETRY_S):
        amcl.ask_for_map()
    amcl.close()
    node.shutdown()
    return 0


def run_ros2(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """ROS 2: be a managed node that localises while it is active."""
    node = start_node(arguments, graph)
    amcl = AmclNode(node, parameter_tree(node, arguments), ros_version=2)

    def activate() -> bool:
        amcl.start()
        return True

    def deactivate() -> bool:
        amcl.stop()
        return True

    lifecycle = Lifecycle(node, {"activate": activate, "deactivate": deactivate})
    arguments.ready()
    while not stop.wait(_POLL_S) and not lifecycle.finalized:
        pass
    amcl.close()
    node.shutdown()
    return 0


def _triple(pose: Any) -> PlanePose:
    x, y, yaw = map(float, pose)
    return x, y, yaw


def _checked(settings: ParameterReader, options: AmclOptions, ros_version: int) -> AmclOptions:
    """Return options whose models exist and whose limits go together."""
    from dataclasses import replace

    model, drive = options.laser_model_type, options.odom_model_type
    if model not in _SENSOR_MODELS:
        hint = did_you_mean(model, _SENSOR_MODELS)
        text = f"Unknown laser model type '{model}'; likelihood_field is used"
        settings.report("parameter.bad-value", text, hint)
        options = replace(options, laser_model_type="likelihood_field")
    if drive not in MOTION_MODELS:
        text = f"Unknown odom model type '{drive}'; the differential one is used"
        settings.report("parameter.bad-value", text, did_you_mean(drive, MOTION_MODELS))
        options = replace(options, odom_model_type="diff")
    if options.min_particles > options.max_particles:
        text = "You've set min_particles to be greater than max particles, this isn't allowed so "
        text += "they'll be set to be equal."
        settings.report("parameter.bad-value", text)
        options = replace(options, max_particles=options.min_particles)
    if ros_version == 2:
        options = replace(
            options,
            initial_pose_x=settings.number("initial_pose.x"),
            initial_pose_y=settings.number("initial_pose.y"),
            initial_pose_a=settings.number("initial_pose.yaw"),
        )
    return options
