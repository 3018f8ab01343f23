"""An `Ekf` that fuses what messages measure of its state; both EKF nodes are made of it."""

from __future__ import annotations

import math
import threading
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry import Pose, unit_quat_xyzw
from gazelle.graph.tf import StampedPose, TransformBroadcaster
from gazelle.interfaces.poses import quat_xyzw_of, unit_pose_of
from gazelle.navigation.localization.ekf import Ekf, rotation_of
from gazelle.nodes.navigation.robot_pose import Frames

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["Fusion", "Measurement", "differential", "measure_imu", "measure_pose", "measure_twist"]


GRAVITY_M_S2 = 9.80665


@dataclass(frozen=True, slots=True, eq=False)
class Measurement:
    """Values of all states, and which of them are measured.

    Attributes:
        stamp_ns: when.
        values: (15,).
        covariance: (15, 15).
        measured: (15,), those that the message has.
    """

    stamp_ns: int
    values: NDArray[np.float64]
    covariance: NDArray[np.float64]
    measured: NDArray[np.bool_]


class Fusion:
    """Takes measurements in the order of their times.

    Attributes:
        frames: tf.
        stamp_ns: time of the state, 0 before the first measurement.
    """

    def __init__(self, node: Node, ekf: Ekf) -> None:
        """Take a filter."""
        self.frames = Frames(node)
        self.stamp_ns = 0
        self._node, self._ekf = node, ekf
        self._tf = TransformBroadcaster(node)
        self._lock = threading.Lock()
        self._last: dict[str, Measurement] = {}
        self._first: dict[str, NDArray[np.float64]] = {}

    def take(
        self,
        name: str,
        found: Measurement,
        config: NDArray[np.bool_],
        *,
        by_difference: bool = False,
        relative: bool = False,
        threshold: float = math.inf,
    ) -> None:
        """Take a measurement in.

        Args:
            name: of the input.
            found: what it measures.
            config: which states count, (15,).
            by_difference: poses count as velocities since the one before.
            relative: poses count from the first one.
            threshold: see `Ekf.update`.
        """
        if not (np.isfinite(found.values).all() and np.isfinite(found.covariance).all()):
            self.frames.say("warn", f"{name}: a message that is no number is left out")
            return
        if by_difference:
            before = self._last.get(name)
            self._last[name] = found
            step = None if before is None else differential(before, found)
            if step is None:
                return
            found = step
            config = np.concatenate([np.zeros(6, bool), config[:6], np.zeros(3, bool)])
        elif relative:
            found = self._from_first(name, found)
        rows = np.nonzero(config & found.measured)[0]
        if not len(rows):
            return
        with self._lock:
            late_s = (self.stamp_ns - found.stamp_ns) * 1e-9
            if self.stamp_ns and late_s > 1.0:
                text = f"{name}: a message {late_s:.2f} s older than the state is left out"
                self.frames.say("warn", text, key=f"{name} late")
                return
            if self.stamp_ns:
                self._ekf.predict((found.stamp_ns - self.stamp_ns) * 1e-9)
            self.stamp_ns = max(self.stamp_ns, found.stamp_ns)
            covariance = found.covariance[np.ix_(rows, rows)]
            if not self._ekf.update(rows.tolist(), found.values[rows], covariance, threshold):
                self.frames.say("warn", f"{name}: a message beyond the rejection threshold is "
                                "left out", key=f"{name} rejected")  # fmt: skip

    def place(self, found: Measurement) -> None:
        """Begin anew at a pose."""
        with self._lock:
            self._ekf.state[:] = 0.0
            self._ekf.state[:6] = found.values[:6]
            self._ekf.covariance[:6, :6] = found.covariance[:6, :6] + np.eye(6) * 1e-9
            self.stamp_ns = found.stamp_ns
            self._last.clear()

    def snapshot(self) -> tuple[int, NDArray[np.float64], NDArray[np.float64]]:
        """Return time, state, (15,), and its covariance, (15, 15), in the order of `Ekf`."""
        with self._lock:
            return self.stamp_ns, self._ekf.state.copy(), self._ekf.covariance.copy()

    def send(self, parent: str, child: str, pose: Pose, stamp_ns: int) -> None:
        """Send a transform."""
        self._tf.send(StampedPose(parent, child, stamp_ns, pose))

    def _from_first(self, name: str, found: Measurement) -> Measurement:
        first = self._first.setdefault(name, found.values[:6].copy())
        values = found.values.copy()
        origin = Pose.from_xyz_rpy(_three(first[:3]), _three(first[3:6]))
        here = Pose.from_xyz_rpy(_three(values[:3]), _three(values[3:6]))
        seen = origin.inverse() @ here
        values[:3], values[3:6] = seen.position_m, seen.rpy_rad
        return Measurement(found.stamp_ns, values, found.covariance, found.measured)


def measure_pose(message: Any, stamp_ns: int) -> Measurement:
    """Read a ``PoseWithCovariance``."""
    pose = unit_pose_of(message.pose)
    values, covariance = np.zeros(15), np.zeros((15, 15))
    values[:3], values[3:6] = pose.position_m, pose.rpy_rad
    covariance[:6, :6] = np.asarray(message.covariance, float).reshape(6, 6)
    return Measurement(stamp_ns, values, covariance, np.arange(15) < 6)


def measure_twist(message: Any, stamp_ns: int) -> Measurement:
    """Read a ``TwistWithCovariance``."""
    linear, angular = message.twist.linear, message.twist.angular
    values, covariance = np.zeros(15), np.zeros((15, 15))
    values[6:12] = linear.x, linear.y, linear.z, angular.x, angular.y, angular.z
    covariance[6:12, 6:12] = np.asarray(message.covariance, float).reshape(6, 6)
    k = np.arange(15)
    return Measurement(stamp_ns, values, covariance, (k >= 6) & (k < 12))


def measure_imu(
    message: Any, stamp_ns: int, T_base_imu: Pose, *, without_gravity: bool = False
) -> Measurement:
    """Read a ``sensor_msgs/Imu`` whose sensor may be turned on the robot.

    A covariance that begins with −1 says that the sensor does not measure that.
    """
    turn = rotation_of(*T_base_imu.rpy_rad)
    world_imu = Pose(quat_xyzw=unit_quat_xyzw(quat_xyzw_of(message.orientation)))
    base = world_imu @ Pose((0.0, 0.0, 0.0), T_base_imu.quat_xyzw).inverse()
    values, covariance = np.zeros(15), np.zeros((15, 15))
    values[3:6] = base.rpy_rad
    w, a = message.angular_velocity, message.linear_acceleration
    values[9:12] = turn @ np.array([w.x, w.y, w.z])
    values[12:15] = turn @ np.array([a.x, a.y, a.z])
    if without_gravity:
        values[12:15] -= rotation_of(*base.rpy_rad).T @ np.array([0.0, 0.0, GRAVITY_M_S2])
    measured = np.zeros(15, bool)
    for first, block in (
        (3, message.orientation_covariance),
        (9, message.angular_velocity_covariance),
        (12, message.linear_acceleration_covariance),
    ):
        held = np.asarray(block, float).reshape(3, 3)
        measured[first : first + 3] = held[0, 0] >= 0
        covariance[first : first + 3, first : first + 3] = turn @ held @ turn.T
    return Measurement(stamp_ns, values, covariance, measured)


def differential(before: Measurement, after: Measurement) -> Measurement | None:
    """Return the velocities that lead from one pose to the next; None without time between."""
    dt_s = (after.stamp_ns - before.stamp_ns) * 1e-9
    if dt_s <= 1e-6:
        return None
    values, covariance = np.zeros(15), np.zeros((15, 15))
    turn = rotation_of(*before.values[3:6])
    values[6:9] = turn.T @ (after.values[:3] - before.values[:3]) / dt_s
    turned = after.values[3:6] - before.values[3:6]
    values[9:12] = [math.remainder(float(angle), math.tau) / dt_s for angle in turned]
    spread = (before.covariance[:6, :6] + after.covariance[:6, :6]) / dt_s**2
    covariance[6:12, 6:12] = spread
    measured = np.zeros(15, bool)
    measured[6:12] = before.measured[:6] & after.measured[:6]
    return Measurement(after.stamp_ns, values, covariance, measured)


def _three(values: NDArray[np.float64]) -> tuple[float, float, float]:
    a, b, c = map(float, values)
    return a, b, c
