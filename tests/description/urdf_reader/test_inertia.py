from __future__ import annotations

import math
import re

import pytest

from gazelle.geometry import is_legal_inertia

TENSOR = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'
BOX = "<collision><geometry><box size='0.1 0.2 0.3'/></geometry></collision>"


def _robot(a: str, b: str, kind: str) -> str:
    joint = f'<joint name="j" type="{kind}"><parent link="a"/><child link="b"/></joint>'
    return f'<robot name="r"><link name="a">{a}</link><link name="b">{b}</link>{joint}</robot>'


def _inertial(mass: float, tensor: str = TENSOR) -> str:
    return f'<inertial><mass value="{mass}"/>{tensor}</inertial>'


def test_massless_root_fixed_to_a_body_stays_massless(read) -> None:
    found = read(_robot("", _inertial(1), "fixed"))
    assert found.robot.link("a").inertial is None
    assert not found.codes


def test_massless_frame_on_a_body_stays_massless(read) -> None:
    found = read(_robot(_inertial(1), BOX, "fixed"))
    assert found.robot.link("b").inertial is None
    assert not found.codes


def test_moving_link_without_inertia_gets_that_of_its_shapes(read) -> None:
    found = read(_robot(_inertial(1), BOX, "continuous"))
    inertial = found.robot.link("b").inertial
    assert inertial.estimated
    assert inertial.mass_kg == pytest.approx(6.0)
    assert inertial.inertia_kg_m2[0] == pytest.approx(6.0 / 12 * (0.2**2 + 0.3**2))
    message = found.message("urdf.no-inertia")
    assert "link 'b' moves and has no <inertial>: Gazebo would drop it" in message
    assert '<mass value="6"/>' in message


def test_block_to_paste_is_what_was_used(read) -> None:
    found = read(_robot(_inertial(1), BOX, "continuous"))
    (finding,) = found.diagnostics
    block = finding.fix[finding.fix.index("<inertial>") :]
    pasted = read(_robot(_inertial(1), BOX + block, "continuous"))
    assert not pasted.codes
    used, written = found.robot.link("b").inertial, pasted.robot.link("b").inertial
    assert written.mass_kg == pytest.approx(used.mass_kg, rel=1e-5)
    assert written.inertia_kg_m2 == pytest.approx(used.inertia_kg_m2, rel=1e-5)


def test_estimate_uses_visuals_when_there_is_no_collision(read) -> None:
    ball = "<visual><origin xyz='1 0 0'/><geometry><sphere radius='0.1'/></geometry></visual>"
    inertial = read(_robot(_inertial(1), ball, "continuous")).robot.link("b").inertial
    assert inertial.mass_kg == pytest.approx(1000 * 4 / 3 * math.pi * 0.1**3)
    assert inertial.T_link_com.position_m == pytest.approx((1.0, 0.0, 0.0))


def test_estimate_fills_cylinders_and_capsules(read) -> None:
    shapes = "<cylinder radius='0.1' length='1'/>", "<capsule radius='0.1' length='1'/>"
    masses = []
    for shape in shapes:
        inside = f"<collision><geometry>{shape}</geometry></collision>"
        masses.append(read(_robot(_inertial(1), inside, "continuous")).robot.links[1])
    cylinder, capsule = (link.inertial.mass_kg for link in masses)
    assert cylinder == pytest.approx(1000 * math.pi * 0.01)
    assert capsule == pytest.approx(1000 * math.pi * 0.01 * (1 + 4 / 3 * 0.1))


def test_moving_link_without_any_shape_gets_a_gram(read) -> None:
    found = read(_robot(_inertial(1), "", "continuous"))
    assert found.robot.link("b").inertial.mass_kg == 1e-3
    assert "0.001 kg are used (it has no shapes)" in found.message("urdf.no-inertia")


def test_zero_mass_on_a_moving_link_is_estimated(read) -> None:
    found = read(_robot(_inertial(1), _inertial(0) + BOX, "continuous"))
    assert found.robot.link("b").inertial.mass_kg == pytest.approx(6.0)
    assert "moves and has the mass 0" in found.message("urdf.no-inertia")


def test_zero_inertia_on_a_moving_link_is_estimated_at_its_mass(read) -> None:
    zero = re.sub('"1"', '"0"', TENSOR)
    found = read(_robot(_inertial(1), _inertial(3, zero) + BOX, "continuous"))
    inertial = found.robot.link("b").inertial
    assert (inertial.mass_kg, inertial.estimated) == (3.0, True)
    assert inertial.inertia_kg_m2[0] == pytest.approx(3.0 / 12 * (0.2**2 + 0.3**2))
    assert "an inertia of 0: it could not be turned" in found.message("urdf.zero-inertia")


def test_point_mass_fixed_to_a_body_is_fine(read) -> None:
    zero = re.sub('"1"', '"0"', TENSOR)
    found = read(_robot(_inertial(1), _inertial(3, zero), "fixed"))
    assert not found.codes
    assert found.robot.link("b").inertial.mass_kg == 3.0


def test_impossible_tensor_is_legalised_and_ros_is_named(read) -> None:
    wrong = TENSOR.replace('izz="1"', 'izz="9"')
    found = read(_robot(_inertial(1), _inertial(1, wrong), "continuous"))
    message = found.message("urdf.bad-inertia")
    assert "no body has the inertia of link 'b'" in message
    assert "ROS passes it on and Gazebo may diverge" in message
    assert is_legal_inertia(found.robot.link("b").inertial.inertia_kg_m2)


def test_negative_mass_is_an_error_once(read) -> None:
    found = read(_robot(_inertial(1), _inertial(-1), "continuous"))
    assert found.codes == ["urdf.negative-mass"]
    assert found.robot.link("b").inertial.mass_kg > 0.0


def test_static_robot_needs_no_mass(read) -> None:
    found = read('<robot name="r"><link name="a"/><gazebo><static>true</static></gazebo></robot>')
    assert found.robot.static
    assert not found.codes


def test_link_fixed_to_the_world_needs_no_mass(read) -> None:
    found = read(
        '<robot name="r"><link name="world"/><link name="a"/><joint name="j" type="fixed">'
        '<parent link="world"/><child link="a"/></joint></robot>'
    )
    assert not found.codes


CUBE = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
FACES = ("1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4")


@pytest.mark.parametrize("faces", [FACES, FACES[:-1]], ids=["closed", "open"])
def test_mesh_is_filled_and_an_open_one_by_its_hull(read, faces, tmp_path) -> None:
    lines = [f"v {x} {y} {z}" for x, y, z in CUBE] + [f"f {face}" for face in faces]
    (tmp_path / "cube.obj").write_text("\n".join(lines), encoding="utf-8")
    mesh = "<geometry><mesh filename='cube.obj' scale='0.1 0.2 0.3'/></geometry>"
    text = _robot(_inertial(1), f"<collision>{mesh}</collision>", "continuous")
    inertial = read(text, tmp_path).robot.link("b").inertial
    assert inertial.mass_kg == pytest.approx(6.0)
    assert inertial.T_link_com.position_m == pytest.approx((0.05, 0.1, 0.15))
