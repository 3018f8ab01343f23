"""A robot whose poses and configurations are the same thing: three slides, three turns."""

from __future__ import annotations

import math

import numpy as np

from gazelle.motion.constraints.kinematic_constraints import Parameterization, euler_xyz, matrix_of
from gazelle.motion.joint_space import FloatArray, JointSpace
from gazelle.motion.kinematics import Patience


def gantry_space(*, velocity: float = 2.0, acceleration: float = 8.0) -> JointSpace:
    return JointSpace(
        names=("x", "y", "z", "roll", "pitch", "yaw"),
        lower=np.array([-2.0, -2.0, -2.0, -math.pi, -1.5, -math.pi]),
        upper=np.array([2.0, 2.0, 2.0, math.pi, 1.5, math.pi]),
        continuous=np.zeros(6, dtype=np.bool_),
        velocity=np.full(6, velocity),
        acceleration=np.full(6, acceleration),
        jerk=np.full(6, np.inf),
    )


class Gantry:
    """Exact kinematics of the gantry; `sloppy_m` makes its solutions as coarse as a solver's."""

    def __init__(self, sloppy_m: float = 0.0) -> None:
        self._sloppy_m = sloppy_m

    def fk(self, q: FloatArray, link: str = "") -> FloatArray:
        pose = np.eye(4)
        pose[:3, :3] = matrix_of(q[3:], Parameterization.XYZ_EULER_ANGLES)
        pose[:3, 3] = q[:3]
        return pose

    def jacobian(self, q: FloatArray, link: str = "") -> FloatArray:
        (ca, cb), (sa, sb) = np.cos(q[3:5]), np.sin(q[3:5])
        columns = np.zeros((6, 6))
        columns[:3, :3] = np.eye(3)
        columns[3:, 3] = 1.0, 0.0, 0.0
        columns[3:, 4] = 0.0, ca, sa
        columns[3:, 5] = sb, -sa * cb, ca * cb
        return columns

    def ik(
        self,
        T_base_tip: FloatArray,
        *,
        seed_q: FloatArray | None = None,
        patience: Patience,
        link: str = "",
    ) -> FloatArray | None:
        q = np.concatenate([T_base_tip[:3, 3], euler_xyz(T_base_tip[:3, :3])])
        if np.abs(q[:3]).max() > 2.0:
            return None
        if self._sloppy_m:
            q[:3] = np.round(q[:3] / self._sloppy_m) * self._sloppy_m
        return q
