from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.geometry import (
    MassError,
    Mesh,
    box_mass_properties,
    box_mesh,
    capsule_mass_properties,
    capsule_mesh,
    combined_mass_properties,
    cone_mass_properties,
    cone_mesh,
    cylinder_mass_properties,
    cylinder_mesh,
    cylindrical_shell_mass_properties,
    ellipsoid_mass_properties,
    ellipsoid_mesh,
    half_cylindrical_shell_mass_properties,
    hemisphere_mass_properties,
    hemispherical_shell_mass_properties,
    is_closed,
    mesh_mass_properties,
    plane_mesh,
    rod_mass_properties,
    semicylinder_mass_properties,
    sphere_mass_properties,
    sphere_mesh,
    spherical_shell_mass_properties,
)

M, R, L = 3.0, 0.4, 1.5


def moments(body):
    xx, xy, xz, yy, yz, zz = body.inertia_kg_m2
    assert (xy, xz, yz) == (0, 0, 0)
    return xx, yy, zz


def test_textbook_values():
    """The table of moments of inertia in Meriam and Kraige, Dynamics, appendix D."""
    tube = M * R**2 / 2 + M * L**2 / 12
    solid = M * R**2 / 4 + M * L**2 / 12
    assert moments(box_mass_properties(M, (1, 2, 3))) == pytest.approx((3.25, 2.5, 1.25))
    assert moments(cylinder_mass_properties(M, R, L)) == pytest.approx((solid, solid, M * R**2 / 2))
    assert moments(cylindrical_shell_mass_properties(M, R, L)) == pytest.approx(
        (tube, tube, M * R**2)
    )
    assert moments(sphere_mass_properties(M, R)) == pytest.approx((0.4 * M * R**2,) * 3)
    assert moments(spherical_shell_mass_properties(M, R)) == pytest.approx((2 / 3 * M * R**2,) * 3)
    assert moments(rod_mass_properties(M, L)) == pytest.approx((M * L**2 / 12, M * L**2 / 12, 0))


@pytest.mark.parametrize(
    ("body", "center", "about_cut"),
    [
        (
            semicylinder_mass_properties(M, R, L),
            (4 * R / (3 * math.pi), 0, 0),
            (M * R**2 / 4 + M * L**2 / 12,) * 2 + (M * R**2 / 2,),
        ),
        (
            half_cylindrical_shell_mass_properties(M, R, L),
            (2 * R / math.pi, 0, 0),
            (M * R**2 / 2 + M * L**2 / 12,) * 2 + (M * R**2,),
        ),
        (hemisphere_mass_properties(M, R), (0, 0, 3 / 8 * R), (0.4 * M * R**2,) * 3),
        (hemispherical_shell_mass_properties(M, R), (0, 0, R / 2), (2 / 3 * M * R**2,) * 3),
    ],
)
def test_halves_have_the_wholes_moments_about_the_cut(body, center, about_cut):
    assert body.center_m == pytest.approx(center)
    xx, _, _, yy, _, zz = body.inertia_about((0, 0, 0))
    assert (xx, yy, zz) == pytest.approx(about_cut)


def test_hemispheres_principal_moment_is_83_of_320():
    assert moments(hemisphere_mass_properties(M, R))[0] == pytest.approx(83 / 320 * M * R**2)


@pytest.mark.parametrize(
    ("half", "whole", "mirror"),
    [
        (semicylinder_mass_properties(M, R, L), cylinder_mass_properties(2 * M, R, L), 0),
        (
            half_cylindrical_shell_mass_properties(M, R, L),
            cylindrical_shell_mass_properties(2 * M, R, L),
            0,
        ),
        (hemisphere_mass_properties(M, R), sphere_mass_properties(2 * M, R), 2),
        (hemispherical_shell_mass_properties(M, R), spherical_shell_mass_properties(2 * M, R), 2),
    ],
)
def test_two_halves_make_a_whole(half, whole, mirror):
    from dataclasses import replace

    center = tuple(-x if axis == mirror else x for axis, x in enumerate(half.center_m))
    both = combined_mass_properties([half, replace(half, center_m=center)])
    np.testing.assert_allclose(both.center_m, (0, 0, 0), atol=1e-12)
    np.testing.assert_allclose(both.inertia_kg_m2, whole.inertia_kg_m2, atol=1e-12)


FINE = 256


@pytest.mark.parametrize(
    ("part", "body"),
    [
        (sphere_mesh(R, segments=FINE), sphere_mass_properties(M, R)),
        (ellipsoid_mesh((R, 1, 2), segments=FINE), ellipsoid_mass_properties(M, (R, 1, 2))),
        (cylinder_mesh(R, L, segments=FINE), cylinder_mass_properties(M, R, L)),
        (cone_mesh(R, L, segments=FINE), cone_mass_properties(M, R, L)),
        (capsule_mesh(R, L, segments=FINE), capsule_mass_properties(M, R, L)),
    ],
    ids=["sphere", "ellipsoid", "cylinder", "cone", "capsule"],
)
def test_meshes_of_round_solids_come_near_the_formulas(part, body):
    found = mesh_mass_properties(part, mass_kg=M)
    np.testing.assert_allclose(found.center_m, body.center_m, atol=1e-9)
    scale = max(body.inertia_kg_m2)
    np.testing.assert_allclose(found.inertia_kg_m2, body.inertia_kg_m2, atol=1e-3 * scale)


def test_a_shell_meshs_sphere_is_the_spherical_shell():
    found = mesh_mass_properties(sphere_mesh(R, segments=FINE), mass_kg=M, shell=True)
    expected = spherical_shell_mass_properties(M, R).inertia_kg_m2
    np.testing.assert_allclose(found.inertia_kg_m2, expected, rtol=1e-3, atol=1e-9)


def test_a_box_mesh_is_exactly_the_box_wherever_it_is():
    shift = np.eye(4)
    shift[:3, 3] = (1000, -2000, 3000)
    part = box_mesh((1, 2, 3)).transformed(shift)
    found = mesh_mass_properties(part, density_kg_m3=0.5)
    assert found.mass_kg == pytest.approx(3.0)
    np.testing.assert_allclose(found.center_m, (1000, -2000, 3000), rtol=1e-12)
    np.testing.assert_allclose(
        found.inertia_kg_m2, box_mass_properties(3.0, (1, 2, 3)).inertia_kg_m2, atol=1e-9
    )


def test_a_mesh_turned_inside_out_weighs_the_same():
    part = box_mesh((1, 2, 3))
    inverted = Mesh((type(part)("b", part.vertices_m, part.faces[:, ::-1].copy(), -part.normals),))
    found = mesh_mass_properties(inverted, mass_kg=3.0)
    expected = box_mass_properties(3.0, (1, 2, 3)).inertia_kg_m2
    np.testing.assert_allclose(found.inertia_kg_m2, expected, atol=1e-12)


def test_an_open_mesh_is_no_solid_but_a_shell():
    sheet = plane_mesh((2, 3))
    assert not is_closed(sheet)
    with pytest.raises(MassError, match="not closed, so it has no inside"):
        mesh_mass_properties(sheet, mass_kg=1.0)
    found = mesh_mass_properties(sheet, mass_kg=12.0, shell=True)
    np.testing.assert_allclose(found.inertia_kg_m2, (9, 0, 0, 4, 0, 13), atol=1e-12)


def test_a_flattened_mesh_has_no_volume():
    flat = box_mesh((1, 1, 1)).transformed(np.diag([1.0, 1.0, 0.0, 1.0]))
    with pytest.raises(MassError, match="the mesh has no volume"):
        mesh_mass_properties(flat, mass_kg=1.0)


def test_mass_or_density_must_be_given():
    with pytest.raises(ValueError, match="either mass_kg or density_kg_m3"):
        mesh_mass_properties(box_mesh((1, 1, 1)))
