from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.geometry import (
    MassProperties,
    Pose,
    box_mass_properties,
    combined_mass_properties,
    inertia_matrix,
    inertia_problems,
    is_legal_inertia,
    legalised_inertia,
    sphere_mass_properties,
)
from gazelle.geometry.mass_properties import least_principal_moment

SIZE = st.floats(0.1, 5)
ANGLE = st.floats(-3, 3)
LENGTH = st.floats(-5, 5)
BOXES = st.builds(box_mass_properties, SIZE, st.tuples(SIZE, SIZE, SIZE))
POSES = st.builds(
    Pose.from_xyz_rpy, st.tuples(LENGTH, LENGTH, LENGTH), st.tuples(ANGLE, ANGLE, ANGLE)
)


def close(a: MassProperties, b: MassProperties) -> bool:
    return (
        math.isclose(a.mass_kg, b.mass_kg, rel_tol=1e-9)
        and np.allclose(a.center_m, b.center_m, atol=1e-8)
        and np.allclose(a.inertia_kg_m2, b.inertia_kg_m2, rtol=1e-8, atol=1e-8)
    )


@given(BOXES, POSES)
def test_there_and_back_changes_nothing(body, pose):
    assert close(body.transformed(pose).transformed(pose.inverse()), body)


@given(BOXES, POSES)
def test_turning_keeps_the_principal_moments(body, pose):
    moved = body.transformed(pose).principal_moments_kg_m2
    assert moved == pytest.approx(body.principal_moments_kg_m2, rel=1e-6, abs=1e-9)


@given(BOXES, st.tuples(LENGTH, LENGTH, LENGTH))
def test_the_parallel_axis_theorem_adds_mass_times_distance_squared(body, point):
    about = inertia_matrix(body.inertia_about(point))
    extra = np.trace(about) - np.trace(inertia_matrix(body.inertia_kg_m2))
    assert extra == pytest.approx(2 * body.mass_kg * sum(x * x for x in point), rel=1e-9, abs=1e-9)


def test_two_half_boxes_make_a_whole_one():
    half = box_mass_properties(1.0, (1.0, 2.0, 3.0))
    left = half.transformed(Pose((-0.5, 0, 0)))
    right = half.transformed(Pose((0.5, 0, 0)))
    assert close(combined_mass_properties([left, right]), box_mass_properties(2.0, (2, 2, 3)))


def test_a_negative_mass_cuts_a_hole():
    whole = sphere_mass_properties(8.0, 2.0)
    hole = sphere_mass_properties(1.0, 1.0)
    cut = MassProperties(-1.0, (0, 0, 0), tuple(-value for value in hole.inertia_kg_m2))
    assert combined_mass_properties([whole, cut]).inertia_kg_m2[0] == pytest.approx(12.8 - 0.4)


def test_bodies_without_mass_cannot_be_combined_or_scaled():
    with pytest.raises(ValueError, match="the masses add up to 0 kg"):
        combined_mass_properties([])
    with pytest.raises(ValueError, match="a body without mass"):
        MassProperties(0.0).with_mass(1.0)


def test_another_mass_scales_the_tensor():
    heavy = box_mass_properties(1.0, (1, 2, 3)).with_mass(5.0)
    assert close(heavy, box_mass_properties(5.0, (1, 2, 3)))


def test_products_of_inertia_follow_a_turn():
    """A rod along x turned by +45° about z lies where x y > 0: the tensor's ixy is negative."""
    rod = MassProperties(1.0, (0, 0, 0), (0.0, 0, 0, 1.0, 0, 1.0))
    turned = rod.transformed(Pose.from_xyz_rpy((0, 0, 0), (0, 0, math.pi / 4)))
    np.testing.assert_allclose(turned.inertia_kg_m2, (0.5, -0.5, 0, 0.5, 0, 1.0), atol=1e-12)


@given(BOXES, POSES)
def test_every_real_body_is_legal_and_left_alone(body, pose):
    inertia = body.transformed(pose).inertia_kg_m2
    assert is_legal_inertia(inertia)
    assert legalised_inertia(inertia) == inertia


@pytest.mark.parametrize(
    ("inertia", "words"),
    [
        ((1, 0, 0, 1, 0, 3), "breaks the triangle inequality (principal moments 1, 1, 3 kg m2"),
        ((0, 0, 0, 0, 0, 0), "not positive definite (principal moments 0, 0, 0 kg m2)"),
        ((-1, 0, 0, 1, 0, 1), "not positive definite"),
        ((1, 5, 0, 1, 0, 1), "not positive definite"),
        ((math.nan, 0, 0, 1, 0, 1), "not a finite number"),
    ],
)
def test_illegal_tensors_are_explained_and_made_legal(inertia, words):
    assert words in " ".join(inertia_problems(inertia))
    assert is_legal_inertia(legalised_inertia(inertia))


@given(st.tuples(*[st.floats(-10, 10)] * 6))
def test_legalising_always_ends_legal_and_only_adds(inertia):
    before, after = inertia_matrix(inertia), inertia_matrix(legalised_inertia(inertia))
    assert is_legal_inertia(legalised_inertia(inertia))
    assert np.linalg.eigvalsh(after - before).min() >= -1e-6


def test_the_largest_moment_stays_when_the_others_are_raised():
    assert legalised_inertia((1, 0, 0, 1, 0, 3)) == pytest.approx((1.5, 0, 0, 1.5, 0, 3))


def test_least_principal_moment_tells_0_from_less():
    assert least_principal_moment((0.0, 0.0, 0.0, 0.1, 0.0, 0.1)) == 0.0
    assert least_principal_moment((0.01, 0.015, 0.0, 0.01, 0.0, 0.02)) == pytest.approx(-0.005)
    assert math.isnan(least_principal_moment((math.inf, 0.0, 0.0, 1.0, 0.0, 1.0)))
