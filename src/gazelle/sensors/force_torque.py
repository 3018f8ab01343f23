"""Force-torque sensors in joints."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import ForceTorqueSpec
from gazelle.geometry import Pose
from gazelle.sensors.noise_streams import VectorNoise

__all__ = ["JointLoad", "WrenchRecord", "force_torque_reading"]

Array = NDArray[np.float64]


class WrenchRecord(NamedTuple):
    """Force N and torque N·m, (3,) each, in the axes of the frame that the sensor names."""

    force_n: Array
    torque_nm: Array


class JointLoad(NamedTuple):
    """What a joint's parent exerts on its child.

    Attributes:
        force_n: (3,), world frame.
        torque_nm: (3,), world frame, about the joint's origin.
        T_world_joint: the joint's frame, which moves with the child.
        T_world_parent: the parent link; the world for none.
        T_world_child: the child link.
    """

    force_n: Array
    torque_nm: Array
    T_world_joint: Pose
    T_world_parent: Pose
    T_world_child: Pose


def force_torque_reading(
    load: JointLoad,
    spec: ForceTorqueSpec,
    T_joint_sensor: Pose,
    *,
    noise: VectorNoise | None = None,
    dt_s: float = 0.0,
) -> WrenchRecord:
    """Read a force-torque sensor.

    ``parent_to_child`` is what the parent exerts on the child: a hanging mass reads its weight
    upwards. ``child_to_parent``, SDF's default, is the opposite: the mass pulls down. The torque
    is about the sensor's origin, the axes are those of `spec.frame`; noise comes last
    (gz-sensors' ForceTorqueSensor; Gazebo Classic does the same for a sensor at the joint's
    origin).

    Args:
        load: what the joint carries.
        spec: the sensor.
        T_joint_sensor: its pose in the joint's frame.
        noise: of three forces and three torques, None for none.
        dt_s: simulated time since the last reading.
    """
    T_world_sensor = load.T_world_joint @ T_joint_sensor
    arm = np.subtract(T_world_sensor.position_m, load.T_world_joint.position_m)
    torque = load.torque_nm - np.cross(arm, load.force_n)
    frames = {"parent": load.T_world_parent, "sensor": T_world_sensor}
    axes = frames.get(spec.frame, load.T_world_child).matrix()[:3, :3]
    sign = 1.0 if spec.measure_direction == "parent_to_child" else -1.0
    values = sign * np.concatenate([load.force_n @ axes, torque @ axes])
    if noise is not None:
        values = noise.apply(values, dt_s=dt_s)
    return WrenchRecord(values[:3], values[3:])
