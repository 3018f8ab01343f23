"""A filter with its inputs and outputs; both EKF nodes are made of it."""

from __future__ import annotations

import math
import threading
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry import Pose
from gazelle.graph.tf import StampedPose, TransformBroadcaster
from gazelle.navigation.filters.ekf import Ekf
from gazelle.nodes.navigation.robot_pose import Frames
from gazelle.nodes.robot_localization.measurements import Measurement, differential

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["Fusion"]


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
        """Return time, state and covariance."""
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


def _three(values: NDArray[np.float64]) -> tuple[float, float, float]:
    a, b, c = map(float, values)
    return a, b, c
