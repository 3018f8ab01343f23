"""What amcl publishes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry import Pose
from gazelle.graph.tf import StampedPose, TransformBroadcaster
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import set_plane_pose
from gazelle.interfaces.stamps import set_header
from gazelle.navigation.localization import Estimate
from gazelle.nodes.navigation.robot_pose import PlanePose

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["Outputs"]


class Outputs:
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
        """Publish the particles while somebody listens."""
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
