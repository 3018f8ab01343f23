"""Force-torque sensors: sign, axes and lever arm by statics."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.description.model import ForceTorqueSpec, Noise
from gazelle.geometry import Pose
from gazelle.sensors import JointLoad, VectorNoise, force_torque_reading

WEIGHT_N = 98.0
# The parent holds a weight whose centre is 0.3 m along x from the joint.
LOAD = JointLoad(
    np.array([0.0, 0.0, WEIGHT_N]),
    np.array([0.0, -0.3 * WEIGHT_N, 0.0]),
    Pose((1.0, 2.0, 3.0)),
    Pose.from_xyz_rpy((0.0, 0.0, 0.0), (0.0, 0.0, math.pi / 2)),
    Pose.from_xyz_rpy((1.0, 2.0, 3.0), (math.pi, 0.0, 0.0)),
)


def read(frame: str, direction: str = "child_to_parent", offset: Pose | None = None):  # type: ignore[no-untyped-def]
    spec = ForceTorqueSpec(frame, direction)
    return force_torque_reading(LOAD, spec, offset or Pose())


def test_a_hanging_mass_pulls_the_parent_down() -> None:
    force, torque = read("sensor")
    assert force == pytest.approx([0, 0, -WEIGHT_N])
    assert torque == pytest.approx([0, 0.3 * WEIGHT_N, 0])


def test_parent_to_child_is_the_opposite() -> None:
    there, back = read("sensor"), read("sensor", "parent_to_child")
    assert back.force_n == pytest.approx(-there.force_n)
    assert back.torque_nm == pytest.approx(-there.torque_nm)


def test_frames_turn_the_axes() -> None:
    # The child hangs upside down, the parent is turned by 90 degrees about z.
    assert read("child").force_n == pytest.approx([0, 0, WEIGHT_N])
    assert read("child").torque_nm == pytest.approx([0, -0.3 * WEIGHT_N, 0])
    assert read("parent").force_n == pytest.approx([0, 0, -WEIGHT_N])
    assert read("parent").torque_nm == pytest.approx([0.3 * WEIGHT_N, 0, 0])


def test_a_sensor_under_the_weight_feels_no_torque() -> None:
    force, torque = read("sensor", offset=Pose((0.3, 0.0, 0.0)))
    assert force == pytest.approx([0, 0, -WEIGHT_N])
    assert torque == pytest.approx([0, 0, 0], abs=1e-12)


def test_noise_has_the_sigmas_of_its_axes() -> None:
    sigmas = (1.0, 2.0, 3.0, 0.1, 0.2, 0.3)
    noise = VectorNoise([Noise("gaussian", 0.0, sigma) for sigma in sigmas], 7, "ft")
    spec = ForceTorqueSpec("sensor")
    readings = [force_torque_reading(LOAD, spec, Pose(), noise=noise) for _ in range(4000)]
    values = np.array([np.concatenate(reading) for reading in readings])
    assert values.std(axis=0) == pytest.approx(sigmas, rel=0.06)
    assert values.mean(axis=0) == pytest.approx(np.concatenate(read("sensor")), abs=0.2)
