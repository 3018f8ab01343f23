from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from tests.motion.plane import PlanarArm

from gazelle.motion.constraints import (
    JointConstraint,
    OrientationConstraint,
    Parameterization,
    PositionConstraint,
    Region,
)
from gazelle.motion.constraints.kinematic_constraints import euler_xyz, matrix_of, rotation_vector

_ARM = PlanarArm((), links=3)


def _at(x: float, y: float, angle: float = 0.0) -> np.ndarray:
    pose = np.eye(4)
    pose[:3, :3] = Rotation.from_euler("z", angle).as_matrix()
    pose[:2, 3] = x, y
    return pose


def test_angles_agree_with_scipy() -> None:
    for rotation in Rotation.random(200, random_state=1):
        matrix = rotation.as_matrix()
        assert euler_xyz(matrix) == pytest.approx(rotation.as_euler("XYZ"), abs=1e-9)
        assert rotation_vector(matrix) == pytest.approx(rotation.as_rotvec(), abs=1e-7)
        for kind in Parameterization:
            angles = euler_xyz(matrix) if kind == 0 else rotation_vector(matrix)
            assert matrix_of(angles, kind) == pytest.approx(matrix, abs=1e-7)


@pytest.mark.parametrize("axis", [(1, 0, 0), (0, 1, 0), (0, 0, 1), (0.6, 0.0, 0.8)])
def test_half_a_turn_has_an_axis(axis: tuple[float, float, float]) -> None:
    matrix = Rotation.from_rotvec(math.pi * np.array(axis)).as_matrix()
    assert np.abs(rotation_vector(matrix)) == pytest.approx(math.pi * np.array(axis), abs=1e-6)
    assert rotation_vector(np.eye(3)).tolist() == [0.0, 0.0, 0.0]
    assert matrix_of(np.zeros(3), Parameterization.ROTATION_VECTOR) == pytest.approx(np.eye(3))


def test_a_joint_may_be_more_above_than_below() -> None:
    constraint = JointConstraint("elbow", 1, 0.5, tolerance_above=0.2, tolerance_below=0.1)
    assert constraint.excess(np.array([9.0, 0.69])) == pytest.approx([0.0])
    assert constraint.excess(np.array([9.0, 0.75])) == pytest.approx([0.05])
    assert constraint.excess(np.array([9.0, 0.35])) == pytest.approx([-0.05])
    assert constraint.why(np.array([9.0, 0.35])) == (
        "joint 'elbow' is at 0.35, its constraint allows [0.4, 0.7]"
    )


@pytest.mark.parametrize(
    ("region", "point", "beyond"),
    [
        (Region("box", (0.2, 0.4, 1.0), _at(1.0, 0.0)), (1.15, 0.0, 0.0), (0.05, 0.0, 0.0)),
        (Region("box", (0.2, 0.4, 1.0), _at(1.0, 0.0)), (1.05, 0.15, 0.4), (0.0, 0.0, 0.0)),
        (
            Region("box", (0.2, 0.4, 1.0), _at(0.0, 0.0, math.pi / 2)),
            (0.3, 0.0, 0.0),
            (0.0, -0.1, 0.0),
        ),
        (Region("sphere", (0.5,), _at(0.0, 0.0)), (0.6, 0.8, 0.0), (0.3, 0.4, 0.0)),
        (Region("cylinder", (1.0, 0.5), _at(0.0, 0.0)), (0.6, 0.8, 0.7), (0.3, 0.4, 0.2)),
        (Region("cylinder", (1.0, 0.5), _at(0.0, 0.0)), (0.3, 0.3, -0.4), (0.0, 0.0, 0.0)),
    ],
)
def test_regions_say_how_far_outside_a_point_is(
    region: Region, point: tuple[float, ...], beyond: tuple[float, ...]
) -> None:
    assert region.beyond(np.array(point), 1.0) == pytest.approx(beyond, abs=1e-12)


@pytest.mark.parametrize(
    ("kind", "dimensions", "volume"),
    [("box", (0.2, 0.4, 1.0), 0.08), ("sphere", (0.5,), 0.5236), ("cylinder", (1.0, 0.5), 0.7854)],
)
def test_samples_of_regions_fill_them_evenly(
    kind: str, dimensions: tuple[float, ...], volume: float
) -> None:
    region, rng = Region(kind, dimensions, _at(0.3, 0.2, 0.7)), np.random.default_rng(2)
    points = np.array([region.sample(rng) for _ in range(4000)])
    assert not any(region.beyond(point, 1.0).any() for point in points[:500])
    # A smaller copy of the region holds its share of the samples.
    inner = np.mean([not region.beyond(point, 0.7).any() for point in points])
    assert inner == pytest.approx(0.343, abs=0.03)
    extent = np.ptp((points - region.pose[:3, 3]) @ region.pose[:3, :3], axis=0)
    assert np.prod(extent) >= volume * 0.95


def test_regions_that_are_none_are_refused() -> None:
    with pytest.raises(ValueError, match="a region of kind 'cone' is not one of box, sphere"):
        Region("cone", (1.0, 1.0), np.eye(4))
    with pytest.raises(ValueError, match="a cylinder needs 2 dimensions, finite and not negative"):
        Region("cylinder", (1.0,), np.eye(4))
    with pytest.raises(ValueError, match="a sphere needs 1 dimensions"):
        Region("sphere", (math.nan,), np.eye(4))


def test_a_position_constraint_takes_the_nearest_region() -> None:
    regions = tuple(Region("sphere", (0.1,), _at(x, 0.0)) for x in (0.0, 1.0))
    constraint = PositionConstraint("tip", regions, _ARM.fk)
    assert constraint.excess(np.zeros(3)) == pytest.approx([0.1, 0.0, 0.0])
    assert constraint.why(np.zeros(3)) == (
        "the position of link 'tip' is (1.200, 0.000, 0.000) m, 0.1000 m outside the region of "
        "its constraint"
    )
    offset = PositionConstraint("tip", regions, _ARM.fk, offset_m=(-0.2, 0.05, 0.0))
    assert not offset.excess(np.zeros(3)).any()


@pytest.mark.parametrize("kind", list(Parameterization))
def test_an_orientation_constraint_measures_angles(kind: Parameterization) -> None:
    constraint = OrientationConstraint(
        "tip", _at(0.0, 0.0, 0.3)[:3, :3], (0.1, 0.1, 0.2), _ARM.fk, kind
    )
    assert constraint.excess(np.array([0.4, 0.0, 0.0])) == pytest.approx([0.0, 0.0, 0.0])
    assert constraint.excess(np.array([0.6, 0.1, -0.1])) == pytest.approx([0.0, 0.0, 0.1])
    assert constraint.why(np.array([0.6, 0.0, 0.0])) == (
        "the orientation of link 'tip' is (0.000, 0.000, 0.300) rad about x, y, z from the one of "
        "its constraint, which tolerates (0.100, 0.100, 0.200) rad"
    )
