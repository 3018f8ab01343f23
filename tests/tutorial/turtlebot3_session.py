"""TurtleBot3 in its published world, as a person at Gazebo, RViz and a keyboard has it."""

from __future__ import annotations

import contextlib
import math
import os
import pty
import threading
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from tests.patience import stretched

from gazelle.graph.actions import ActionClient, ClientGoal
from gazelle.graph.tf import TransformBuffer, TransformError, TransformListener
from gazelle.interfaces import fill, message_type, service_type

__all__ = ["KeyDriver", "PlanePose", "Session", "apart", "plane_of"]

PlanePose = tuple[float, float, float]

# Higher contacts are no wheels or casters on the ground.
_GROUND_M = 0.03
# The controller's rate in move_base_params.yaml, and how late it may be on a busy machine.
_CONTROLLER_HZ, _MIN_SHARE = 10.0, 0.8
_WATCH_S, _MIN_SPEED, _MAX_DURATION_S = 2.0, 0.3, 600.0
_MIN_SLOWING, _QUICKENING = 0.6, 1.4
_POSE = "geometry_msgs/msg/PoseWithCovarianceStamped"


def apart(one: Sequence[float], other: Sequence[float]) -> tuple[float, float]:
    """Return how far two poses are from each other, m and rad."""
    turn = abs(math.remainder(one[2] - other[2], math.tau))
    return math.hypot(one[0] - other[0], one[1] - other[1]), turn


def plane_of(pose: Any) -> PlanePose:
    """Return a ``geometry_msgs/Pose`` in the plane."""
    q = pose.orientation
    yaw = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
    return pose.position.x, pose.position.y, yaw


def _as_fields(pose: Sequence[float], z: float = 0.0) -> dict[str, Any]:
    turn = {"z": math.sin(pose[2] / 2), "w": math.cos(pose[2] / 2)}
    return {"position": {"x": pose[0], "y": pose[1], "z": z}, "orientation": turn}


class Session:
    """The world with its robot, and what a person does with it.

    Attributes:
        world: the command ``roslaunch turtlebot3_gazebo turtlebot3_world.launch``.
        bumps: contacts above the ground, as (time in s, place).
        looks: how often contacts were looked at.
        estimates: what came on ``/amcl_pose``.
        commands: how many velocities were sent.
    """

    def __init__(self, run: Callable[..., Any], cwd: Path, model: str, **environ: str) -> None:
        """Launch the world and wait for the robot."""
        self._run = run
        self._options: dict[str, Any] = {"cwd": cwd, "TURTLEBOT3_MODEL": model, **environ}
        self._model = f"turtlebot3_{model}"
        self.bumps: list[tuple[float, list[float]]] = []
        self.looks = self.commands = 0
        self.estimates: list[Any] = []
        self._odometry: Any = None
        self._factor = self._wanted_factor = 1.0
        self.scan: Any = None
        self.world = self.launch("turtlebot3_gazebo", "turtlebot3_world.launch")
        self.world.wait_for_line("spawn_urdf.*finished cleanly")
        node = self.world.node
        listen = node.create_subscription
        listen("/_gazelle/contacts", "gazelle_msgs/msg/Frames", self._on_contacts)
        listen("/amcl_pose", _POSE, self.estimates.append)
        listen("/odom", "nav_msgs/msg/Odometry", self._on_odometry)
        listen("/scan", "sensor_msgs/msg/LaserScan", self._on_scan)
        listen("/cmd_vel", "geometry_msgs/msg/Twist", self._on_command)
        self._initial = node.create_publisher("/initialpose", _POSE)
        self._velocity = node.create_publisher("/cmd_vel", "geometry_msgs/msg/Twist")
        self._client: ActionClient | None = None
        self._tf = TransformBuffer()
        self._listener = TransformListener(self._tf, node)

    def launch(self, package: str, file: str, *words: str, stdin: Any = None) -> Any:
        """Type ``roslaunch``."""
        return self._run("roslaunch", package, file, *words, stdin=stdin, **self._options)

    def rosrun(self, *words: str) -> Any:
        """Type ``rosrun``."""
        return self._run("rosrun", *words, **self._options)

    def hurry(self, factor: float) -> None:
        """Let simulated time run so many times faster than real time, where the machine can."""
        self._wanted_factor = factor
        self._set_factor(factor)

    @contextlib.contextmanager
    def no_faster_than(self, factor: float) -> Iterator[None]:
        """Let simulated time run slower for a while."""
        self._set_factor(min(factor, self._wanted_factor))
        try:
            yield
        finally:
            self._set_factor(self._wanted_factor)

    def _set_factor(self, factor: float) -> None:
        kind = "gazebo_msgs/{}PhysicsProperties"
        now = self.world.call("/gazebo/get_physics_properties", kind.format("Get"))
        service = service_type(kind.format("Set"))
        client = self.world.node.create_client("/gazebo/set_physics_properties", service)
        assert client.wait_for_service(stretched())
        request = service.Request(
            time_step=now.time_step,
            max_update_rate=factor / now.time_step,
            gravity=now.gravity,
            ode_config=now.ode_config,
        )
        assert client.call(request, timeout_s=stretched()).success
        self._factor = factor

    @property
    def now_s(self) -> float:
        """Simulated time, of the last odometry."""
        stamp = self._odometry.header.stamp
        return float(stamp.sec + stamp.nanosec * 1e-9)

    def truth(self) -> PlanePose:
        """Return where the robot really is."""
        kind = "gazebo_msgs/GetModelState"
        return plane_of(
            self.world.call("/gazebo/get_model_state", kind, model_name=self._model).pose
        )

    def seen_pose(self) -> PlanePose:
        """Return the last odometry, which in this world is the truth."""
        self.world.eventually(lambda: self._odometry is not None)
        return plane_of(self._odometry.pose.pose)

    def belief(self) -> PlanePose:
        """Return where the robot is in the map, as it thinks."""

        def found() -> Any:
            with contextlib.suppress(TransformError):
                return self._tf.lookup_transform("map", "base_footprint").pose
            return None

        pose = self.world.eventually(found)
        return pose.position_m[0], pose.position_m[1], pose.rpy_rad[2]

    def place(self, pose: PlanePose) -> None:
        """Carry the robot somewhere else."""
        state = {"model_name": self._model, "pose": _as_fields(pose, 0.01)}
        state["reference_frame"] = "world"
        kind = "gazebo_msgs/SetModelState"
        assert self.world.call("/gazebo/set_model_state", kind, model_state=state).success

    def estimate(self, pose: PlanePose) -> None:
        """Use RViz's 2D Pose Estimate, with the covariance that RViz sends."""
        message = self._initial.message_class()
        fill(message, {"header": {"frame_id": "map"}, "pose": {"pose": _as_fields(pose)}})
        covariance = [0.0] * 36
        covariance[0] = covariance[7] = 0.25
        covariance[35] = (math.pi / 12) ** 2
        message.pose.covariance = covariance
        self.world.eventually(lambda: self._initial.matched)
        self._initial.publish(message)

    def drive_to(self, pose: PlanePose) -> ClientGoal:
        """Send a goal and wait for its end; time goes slower when the controller is late."""
        goal = self.send(pose)
        began_s = self.now_s
        while not goal.is_done:
            assert self.now_s - began_s < _MAX_DURATION_S, self.world.text
            self._watch(goal)
        return goal

    def _watch(self, goal: ClientGoal) -> None:
        """Wait for some simulated seconds, or the goal's end, and look at the controller's rate."""
        commands, began_s = self.commands, self.now_s
        self.world.eventually(lambda: goal.is_done or self.now_s - began_s > _WATCH_S)
        share = (self.commands - commands) / max(self.now_s - began_s, 0.1) / _CONTROLLER_HZ
        if goal.is_done or not share:
            return
        # A controller that fails sends nothing for a while, which a late one does too.
        change = max(share, _MIN_SLOWING) if share < _MIN_SHARE else _QUICKENING
        factor = min(max(self._factor * change, _MIN_SPEED), self._wanted_factor)
        if factor != self._factor:
            self._set_factor(factor)

    def send(self, pose: PlanePose) -> ClientGoal:
        """Send a goal."""
        if self._client is None:
            node = self.world.node
            self._client = ActionClient(node, "/move_base", "move_base_msgs/MoveBase")
            self._client.require_server(stretched())
        target = message_type("geometry_msgs/msg/PoseStamped")()
        fill(target, {"header": {"frame_id": "map"}, "pose": _as_fields(pose)})
        return self._client.send_goal(self._client.types.Goal(target_pose=target))

    def go(self, linear_m_s: float, angular_rad_s: float) -> None:
        """Publish a velocity."""
        twist = self._velocity.message_class()
        twist.linear.x, twist.angular.z = linear_m_s, angular_rad_s
        self._velocity.publish(twist)

    def _on_contacts(self, message: Any) -> None:
        rows = np.asarray(message.values).reshape(-1, int(message.width))
        self.looks += 1
        self.bumps += [(message.stamp, row[:3].tolist()) for row in rows if row[2] > _GROUND_M]

    def _on_odometry(self, message: Any) -> None:
        self._odometry = message

    def _on_scan(self, message: Any) -> None:
        self.scan = message

    def _on_command(self, _message: Any) -> None:
        self.commands += 1


class KeyDriver:
    """Presses the keys of ``turtlebot3_teleop_key`` until the robot is where a person wants it."""

    _FORWARD_M_S = 0.2
    _TURN_RAD_S = 0.5

    def __init__(self, session: Session) -> None:
        """Start the program in a terminal of its own."""
        self._session = session
        self._keys, seen = pty.openpty()
        self._speeds = [0, 0]
        self._program = session.launch(
            "turtlebot3_teleop", "turtlebot3_teleop_key.launch", stdin=seen
        )
        os.close(seen)
        self._program.wait_for_line("CTRL-C to quit")

    def drive_through(self, places: Sequence[tuple[float, float]]) -> None:
        """Drive from place to place."""
        pause = threading.Event()
        for place in places:
            while self._steer(place):
                pause.wait(0.02)
        self._press(0, 0)

    def close(self) -> None:
        """Press Ctrl-C."""
        os.write(self._keys, b"\x03")
        assert self._program.wait() == 0
        os.close(self._keys)

    def _steer(self, place: tuple[float, float]) -> bool:
        """Press what leads towards a place; False when the robot is there."""
        x, y, yaw = self._session.seen_pose()
        away = math.hypot(place[0] - x, place[1] - y)
        if away < 0.12:
            return False
        turn = math.remainder(math.atan2(place[1] - y, place[0] - x) - yaw, math.tau)
        # In steps of the program: 0.01 m/s and 0.1 rad/s.
        speed = 0 if abs(turn) > 0.5 else round(20 * min(1.0, away / 0.3 + 0.3))
        self._press(speed, round(max(-8.0, min(8.0, 10 * turn))))
        return True

    def _press(self, linear: int, angular: int) -> None:
        keys = b"s" if linear == angular == 0 else b""
        for index, (wanted, more, less) in enumerate(((linear, b"w", b"x"), (angular, b"a", b"d"))):
            step = wanted - self._speeds[index]
            keys += (more if step > 0 else less) * abs(step) * (keys != b"s")
            self._speeds[index] = wanted
        os.write(self._keys, keys)
