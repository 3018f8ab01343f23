"""What the engine reports: contacts, snapshots, wrenches."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Acceleration", "Snapshot", "Velocity", "Wrench"]

Array = NDArray[np.float64]


class Velocity(NamedTuple):
    """Linear velocity m/s of a point and angular velocity rad/s, shape (3,), world frame."""

    linear_m_s: Array
    angular_rad_s: Array


class Acceleration(NamedTuple):
    """Linear acceleration m/s² (gravity not subtracted) and angular rad/s², (3,), world frame."""

    linear_m_s2: Array
    angular_rad_s2: Array


class Wrench(NamedTuple):
    """Force N and torque N·m, shape (3,)."""

    force_n: Array
    torque_nm: Array


@dataclass(frozen=True, slots=True, eq=False)
class Snapshot:
    """Where every link is, for sensors and views.

    Attributes:
        time_ns: simulated time.
        revision: of the compiled world; link names change only with it.
        link_names: ``model::link``, (N).
        T: poses in the world, (N, 7): x y z in metres, then qx qy qz qw; read-only.
    """

    time_ns: int
    revision: int
    link_names: tuple[str, ...]
    T: Array
