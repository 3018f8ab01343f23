"""Where the robot is in the plane, from tf, and how fast it drives, from odometry."""

from __future__ import annotations

import math
import threading
from typing import TYPE_CHECKING, Any, NamedTuple

from gazelle.geometry import Pose
from gazelle.graph.tf import TransformBuffer, TransformError, TransformListener
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import set_plane_pose, set_pose, unit_pose_of
from gazelle.interfaces.stamps import set_header

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["Frames", "Odometry", "PlanePose", "RobotPose", "path_message"]


_STALE_NS = 1_000_000_000

PlanePose = tuple[float, float, float]
"""x (m), y (m), yaw (rad)."""
_NANO = 1_000_000_000


class Odometry:
    """The last message of an odometry topic.

    Attributes:
        velocity: along x and y of the robot (m/s) and around z (rad/s).
    """

    def __init__(self, node: Node, topic: str = "odom") -> None:
        """Start to listen; the robot stands until the first message."""
        self.velocity = (0.0, 0.0, 0.0)
        self._node = node
        self._heard_ns: int | None = None
        self._subscription = node.create_subscription(
            topic, "nav_msgs/msg/Odometry", self._on_odometry, queue_size=1
        )

    @property
    def topic(self) -> str:
        """The topic's global name."""
        return self._subscription.topic

    @property
    def is_silent(self) -> bool:
        """True before the first message, and a second after the last one."""
        now_ns = self._node.clock.now_ns()
        return self._heard_ns is None or now_ns - self._heard_ns > _STALE_NS

    @property
    def speed_m_s(self) -> float:
        """Speed over ground."""
        return math.hypot(self.velocity[0], self.velocity[1])

    def close(self) -> None:
        """Listen no more."""
        self._subscription.unregister()

    def _on_odometry(self, message: Any) -> None:
        twist = message.twist.twist
        velocity = (float(twist.linear.x), float(twist.linear.y), float(twist.angular.z))
        if all(map(math.isfinite, velocity)):
            self.velocity = velocity
            self._heard_ns = self._node.clock.now_ns()


class RobotPose(NamedTuple):
    """Where the robot is.

    Attributes:
        pose: x, y (m) and yaw (rad).
        stamp_ns: time of the transform.
    """

    pose: PlanePose
    stamp_ns: int


class Frames:
    """tf as one node sees it.

    Attributes:
        buffer: the transforms.
    """

    def __init__(self, node: Node) -> None:
        """Start to listen."""
        self.buffer = TransformBuffer(on_warning=lambda text: node.log("warn", text))
        self._listener = TransformListener(self.buffer, node)
        self._node = node
        self._said: dict[str, int] = {}
        self._lock = threading.Lock()

    def robot(
        self, global_frame: str, base_frame: str, tolerance_s: float, *, refuses_late: bool = True
    ) -> RobotPose | str:
        """Return the robot's newest pose, or why it is not known.

        Args:
            global_frame: which the pose is in.
            base_frame: of the robot.
            tolerance_s: a pose may be so old, 0 for any age.
            refuses_late: an older one is not known, as in ROS 1; else it is used and told, as Nav2
                uses it.
        """
        try:
            found = self.buffer.lookup_transform(global_frame, base_frame)
        except TransformError as error:
            return f"no transform from {base_frame} to {global_frame}: {error}"
        now_ns = self._node.clock.now_ns()
        late_s = (now_ns - found.stamp_ns) / _NANO
        if tolerance_s > 0 and found.stamp_ns and late_s > tolerance_s:
            text = f"the transform from {base_frame} to {global_frame} is {late_s:.3f} s old, "
            text += f"transform_tolerance is {tolerance_s:g} s"
            if refuses_late:
                return text
            self.say("warn", f"{text}; it is used all the same", key=f"late {global_frame}",
                     every_s=1.0)  # fmt: skip
        return RobotPose(found.pose.xy_yaw, found.stamp_ns)

    def between(self, target: str, source: str, stamp_ns: int = 0) -> Pose | str:
        """Return ``T_target_source`` at a time, or why it is not known."""
        try:
            return self.buffer.lookup_transform(target, source, stamp_ns).pose
        except TransformError as error:
            return str(error)

    def message_in(self, pose: Any, frame: str) -> Any:
        """Return a ``PoseStamped`` in another frame by the newest transform, or why it cannot be.

        An empty frame in the message means `frame`.
        """
        source = str(pose.header.frame_id).removeprefix("/")
        made = type(pose)()
        made.header.stamp, made.header.frame_id = pose.header.stamp, frame
        if source in ("", frame):
            made.pose = pose.pose
            return made
        transform = self.between(frame, source)
        if isinstance(transform, str):
            return transform
        at = transform @ unit_pose_of(pose.pose)
        set_pose(made.pose, at)
        return made

    def say(self, level: str, text: str, key: str = "", *, every_s: float = 5.0) -> None:
        """Log something, the same thing at most so often; nothing once the node is closed."""
        if self._node.closed:
            # A callback that still waits for tf then would tell of what it could not find.
            return
        now_ns = self._node.clock.now_ns()
        with self._lock:
            last_ns = self._said.get(key or text)
            if last_ns is not None and 0 <= now_ns - last_ns < every_s * _NANO:
                return
            self._said[key or text] = now_ns
        self._node.log(level, text)


def path_message(poses: Any, frame_id: str, now_ns: int) -> Any:
    """Return rows of x, y, yaw as a ``nav_msgs/Path``."""
    stamped: Any = message_type("geometry_msgs/msg/PoseStamped")
    path: Any = message_type("nav_msgs/msg/Path")()
    set_header(path, now_ns, frame_id)
    for pose in poses:
        one = stamped()
        set_header(one, now_ns, frame_id)
        set_plane_pose(one.pose, pose)
        path.poses.append(one)
    return path
