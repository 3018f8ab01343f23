from __future__ import annotations

import numpy as np
import pytest

from gazelle.description.checks.inertia_units import box_fit, equivalent_box_m, is_inside
from gazelle.geometry import (
    Pose,
    box_mass_properties,
    box_mesh,
    cylindrical_shell_mass_properties,
    spherical_shell_mass_properties,
)

from .conftest import BOX_TENSOR, inertial, link, robot

STEEL = tuple(value * 1e-3 / 12 * 47 for value in BOX_TENSOR)


def test_equivalent_box_of_a_box_is_the_box() -> None:
    body = box_mass_properties(7.0, (0.1, 0.2, 0.3))
    turned = body.transformed(Pose.from_xyz_rpy((1.0, 2.0, 3.0), (0.3, 0.2, 0.1)))
    edges, axes = equivalent_box_m(turned)
    assert sorted(edges) == pytest.approx([0.1, 0.2, 0.3])
    assert axes.T @ axes == pytest.approx(np.eye(3))


@pytest.mark.parametrize(
    ("body", "size"),
    [
        (box_mass_properties(1.0, (0.1, 0.2, 0.3)), (0.1, 0.2, 0.3)),
        (spherical_shell_mass_properties(1.0, 0.1), (0.2, 0.2, 0.2)),
        (cylindrical_shell_mass_properties(1.0, 0.1, 0.5), (0.2, 0.2, 0.5)),
    ],
)
def test_solids_and_shells_fit_their_bounding_box(body, size) -> None:
    fit = box_fit(body, box_mesh(size).vertices_m)
    assert not fit.is_too_large
    assert not fit.is_too_small


def test_inside_has_a_little_slack() -> None:
    points = box_mesh((1.0, 1.0, 1.0)).vertices_m
    assert is_inside((0.51, 0.0, 0.0), points)
    assert not is_inside((0.6, 0.0, 0.0), points)


def mesh_link(scale: str = "", mass: float = 12) -> str:
    shape = f'<visual><geometry><mesh filename="part.stl"{scale}/></geometry></visual>'
    return robot(link(inertial(mass), shape=shape))


@pytest.mark.parametrize(
    ("per_metre", "unit", "scale"),
    [(1000, "millimetres", "0.001"), (1 / 0.0254, "inches", "0.0254")],
)
def test_mesh_in_another_unit_is_named_with_its_factor(judge, stl, per_metre, unit, scale) -> None:
    part = box_mesh((0.1 * per_metre, 0.2 * per_metre, 0.3 * per_metre))
    stl("part.stl", part.vertices_m[part.faces])
    found = judge(mesh_link())
    assert found.only.code == "inertia.units"
    assert found.only.message == (
        f"link 'a' is in the wrong unit: its mesh is {0.3 * per_metre:.4g} m long: "
        f"it is in {unit}, a factor of {scale}"
    )
    assert found.only.span is not None
    assert found.only.span.line == 8
    assert found.only.fix == f'write scale="{scale} {scale} {scale}" into every <mesh> of the link'
    assert judge(mesh_link(f' scale="{scale} {scale} {scale}"')).codes == []


def test_mass_and_tensor_in_grams_and_millimetres(judge) -> None:
    wrong = inertial(12_000, tuple(value * 1e9 for value in BOX_TENSOR))
    found = judge(robot(link(wrong)).replace("0.1 0.2 0.3", "0.1 0.2 0.3"))
    assert found.only.code == "inertia.units"
    assert "12000 are grams, not kg: a factor of 0.001" in found.only.message
    assert "its inertia is in g·mm², not kg·m²: a factor of 1e-09" in found.only.message
    assert found.place == ("robot.urdf", 3, 5)
    assert '<mass value="12"/>' in found.only.fix
    assert 'ixx="0.13"' in found.only.fix
    assert judge(robot(link(inertial()))).codes == []


@pytest.mark.parametrize(
    ("unit", "factor"),
    [("g·m²", 1e3), ("kg·cm²", 1e4), ("kg·mm²", 1e6), ("g·cm²", 1e7), ("g·mm²", 1e9)],
)
def test_every_unit_of_inertia_is_told_from_the_others(judge, unit: str, factor: float) -> None:
    found = judge(robot(link(inertial(moments=tuple(value * factor for value in BOX_TENSOR)))))
    assert f"its inertia is in {unit}, not kg·m²: a factor of {1 / factor:g}" in found.only.message
    assert found.only.code == "inertia.units"


def test_centre_in_millimetres(judge) -> None:
    found = judge(robot(link(inertial(xyz="0 0 40"))))
    assert found.only.code == "inertia.units"
    assert "its centre of mass is in millimetres" in found.only.message
    assert '<origin xyz="0 0 0.04"' in found.only.fix


def test_placeholder_is_no_unit(judge) -> None:
    tiny = '<collision><geometry><sphere radius="0.02"/></geometry></collision>'
    found = judge(robot(link(inertial(0.03, (0.001, 0.001, 0.001)), shape=tiny)))
    assert found.codes == ["inertia.box"]


@pytest.mark.parametrize(("kind", "codes"), [("fixed", []), ("continuous", ["inertia.units"])])
def test_gram_on_another_body_is_no_unit(judge, kind: str, codes: list[str]) -> None:
    """Sensors' links carry one to be kept by Gazebo, beside shapes of a millimetre."""
    small = '<collision><geometry><box size="0.001 0.001 0.001"/></geometry></collision>'
    imu = link(inertial(0.001, (1e-9, 1e-9, 1e-9)), small, "imu")
    joint = f'<joint name="j" type="{kind}"><parent link="a"/><child link="imu"/></joint>'
    found = judge(robot(link(inertial(0.1)), imu, joint)).codes
    assert [code for code in found if code == "inertia.units"] == codes
