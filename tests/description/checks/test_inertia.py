from __future__ import annotations

import math
from pathlib import Path

import pytest
from tests.shared_files import needs_shared

from gazelle.description.checks.inertia import repaired
from gazelle.diagnostics import Severity
from gazelle.geometry import box_mesh

from .conftest import inertial, judged, link, robot

BLOCK = (
    'paste into <link name="a">\n'
    "<inertial>\n"
    '  <origin xyz="0 0 0" rpy="0 0 0"/>\n'
    '  <mass value="12"/>\n'
    '  <inertia ixx="0.13" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.05"/>\n'
    "</inertial>"
)


def test_right_link_has_no_finding(judge) -> None:
    assert judge(robot(link(inertial()))).codes == []


def test_moving_link_without_inertial_gets_a_block(judge) -> None:
    found = judge(robot(link("")))
    assert found.only.code == "inertia.missing"
    assert found.only.message == (
        "link 'a' moves and has no <inertial>: Gazebo drops it, and with it the whole robot: "
        "nothing appears"
    )
    assert found.place == ("robot.urdf", 2, 3)
    assert '<mass value="6"/>' in found.only.fix
    assert "has no <inertial> block defined" in found.only.phrase
    assert found.only.severity is Severity.WARNING


def test_what_hangs_on_a_link_without_inertial_is_named_and_counted(judge) -> None:
    names = ("a", "b", "c", "d", "e", "f")
    links = [link(inertial() if name == "a" else "", name=name) for name in names]
    joints = [
        f'<joint name="to_{below}" type="{kind}"><parent link="{above}"/><child link="{below}"/>'
        '<axis xyz="0 0 1"/></joint>'
        for above, below, kind in zip(
            names, names[1:], ("continuous", "fixed", *(["continuous"] * 3)), strict=False
        )
    ]
    said = [item.diagnostic.message for item in judge(robot(*links, *joints)).findings]
    assert [text.partition("Gazebo drops it")[2] for text in said] == [
        " with all that hangs on it: 'c' and 'd' and 'e' and 1 more vanish",
        " with all that hangs on it: 'e' and 'f' vanish",
        " with all that hangs on it: 'f' vanishes",
        ", and its joint",
    ]


def test_link_without_shapes_cannot_be_mended(judge) -> None:
    found = judge(robot(link("", shape="")))
    assert found.only.message.endswith("it has no shapes to compute one from")
    assert found.only.fix.startswith("write an <inertial> for 'a' by hand")


def test_frame_fixed_to_a_body_needs_no_mass(judge) -> None:
    joint = '<joint name="j" type="fixed"><parent link="f"/><child link="a"/></joint>'
    assert judge(robot(link("", shape="", name="f"), link(inertial()), joint)).codes == []


def test_one_link_of_a_massless_body_is_named(judge) -> None:
    joint = '<joint name="j" type="fixed"><parent link="f"/><child link="a"/></joint>'
    found = judge(robot(link("", shape="", name="f"), link(""), joint))
    assert found.only.message.startswith("link 'a' moves and has no <inertial>")


@pytest.mark.parametrize("mass", ["-2", "0"])
def test_mass_that_is_not_positive(judge, mass: str) -> None:
    found = judge(robot(link(inertial(mass))))
    assert found.only.code == "inertia.mass"
    assert found.only.message == f"link 'a' has a mass of {mass} kg"
    assert found.place == ("robot.urdf", 5, 7)
    assert '<mass value="6"/>' in found.only.fix
    assert found.only.severity is Severity.ERROR


def test_tensor_that_is_not_positive_definite(judge) -> None:
    found = judge(robot(link(inertial(products='ixy="0.2" ixz="0" iyz="0"'))))
    codes = [item.diagnostic.code for item in found.findings]
    assert codes[0] == "inertia.not-positive"
    first = found.findings[0].diagnostic
    assert first.message.startswith(
        "no body has the inertia of link 'a': it is not positive definite (principal moments -0.08"
    )
    assert first.span is not None
    assert (first.span.line, first.span.column) == (6, 7)
    assert first.fix == BLOCK
    assert first.phrase == "A link named ... has invalid inertia."


def test_tensor_that_breaks_the_triangle_inequality(judge) -> None:
    found = judge(robot(link(inertial(moments=(0.13, 0.02, 0.05)))))
    assert found.only.code == "inertia.triangle"
    assert "0.02 + 0.05 < 0.13" in found.only.message
    assert found.place == ("robot.urdf", 6, 7)
    assert found.only.fix == BLOCK


def test_point_mass_on_another_body_is_fine(judge) -> None:
    joint = '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
    point = link(inertial(1, (0, 0, 0)), shape="", name="b")
    assert judge(robot(link(inertial()), point, joint)).codes == []


def test_moving_point_mass_is_not(judge) -> None:
    found = judge(robot(link(inertial(1, (0, 0, 0)), shape="")))
    assert found.only.code == "inertia.not-positive"
    assert found.only.severity is Severity.WARNING


def test_negative_moment_is_an_error(judge) -> None:
    found = judge(robot(link(inertial(1, (-0.1, 0.1, 0.1)), shape="")))
    assert found.only.severity is Severity.ERROR


def test_link_lighter_than_foam(judge) -> None:
    found = judge(robot(link(inertial(0.06, (6.5e-4, 5e-4, 2.5e-4)))))
    assert found.only.code == "inertia.density"
    assert found.only.message == (
        "link 'a' has 0.06 kg in shapes of 0.006 m³: 10 kg/m³, lighter than foam"
    )
    assert found.place == ("robot.urdf", 5, 7)
    assert found.only.fix == "correct the mass or the shapes; at 1000 kg/m³ they have 6 kg"


def test_balloon_that_feels_no_gravity_may_be_light(judge) -> None:
    extension = '<gazebo reference="a"><turnGravityOff>true</turnGravityOff></gazebo>'
    light = link(inertial(0.06, (6.5e-4, 5e-4, 2.5e-4)))
    assert judge(robot(light, extension)).codes == []


def test_link_denser_than_gold(judge) -> None:
    mass = 6e-3 * 3e7
    moments = (mass * 0.13 / 12, mass * 0.1 / 12, mass * 0.05 / 12)
    found = judge(robot(link(inertial(mass, moments))))
    assert found.only.code == "inertia.density"
    assert "3e+07 kg/m³, denser than gold" in found.only.message


def test_density_given_makes_density_findings_mendable(judge) -> None:
    found = judge(robot(link(inertial(0.06, (6.5e-4, 5e-4, 2.5e-4)))), density_kg_m3=500)
    assert '<mass value="3"/>' in found.only.fix


def test_mass_may_fit_either_collisions_or_visuals(judge) -> None:
    small = SMALL.replace("visual", "collision")
    large = SMALL.replace("0.01 0.01 0.01", "0.1 0.2 0.3")
    assert judge(robot(link(inertial(), shape=small + large))).codes == []


SMALL = '<visual><geometry><box size="0.01 0.01 0.01"/></geometry></visual>'


def test_inertia_of_a_larger_body(judge) -> None:
    found = judge(robot(link(inertial(moments=(0.9, 0.8, 0.7)))))
    assert found.only.code == "inertia.box"
    assert found.only.message.startswith("link 'a' has the inertia of a box of ")
    assert "too large for its shapes of " in found.only.message
    assert "mixed up" not in found.only.message
    assert found.place == ("robot.urdf", 6, 7)
    assert found.only.fix == BLOCK


def test_moments_in_the_wrong_order(judge) -> None:
    flat = '<collision><geometry><cylinder radius="0.4" length="0.02"/></geometry></collision>'
    found = judge(robot(link(inertial(moments=(0.96, 0.4804, 0.4804)), shape=flat)))
    assert found.only.code == "inertia.box"
    assert found.only.message.endswith("turned it would fit: ixx, iyy and izz seem to be mixed up")


def test_inertia_of_a_much_smaller_body(judge) -> None:
    found = judge(robot(link(inertial(moments=(1e-4, 1e-4, 1e-4)))))
    assert found.only.code == "inertia.box"
    assert "too small for its shapes" in found.only.message


def test_centre_of_mass_outside_the_shapes(judge) -> None:
    found = judge(robot(link(inertial(xyz="0 0 0.4"))))
    assert found.only.code == "inertia.center"
    assert found.only.message == (
        "the centre of mass of link 'a', (0, 0, 0.4) m, lies outside its shapes, which reach "
        "from (-0.05, -0.1, -0.15) to (0.05, 0.1, 0.15) m"
    )
    assert found.place == ("robot.urdf", 3, 5)
    assert found.only.fix == BLOCK


def test_joint_between_very_different_masses(judge) -> None:
    tiny = '<collision><geometry><box size="0.01 0.01 0.01"/></geometry></collision>'
    moment = 0.01 / 6 * 1e-4
    light = link(inertial(0.01, (moment,) * 3), shape=tiny, name="b")
    joint = '  <joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint>\n'
    found = judge(robot(link(inertial()), light, joint))
    assert found.only.code == "inertia.mass-ratio"
    assert found.only.message == ("joint 'j' joins 'a' of 12 kg and 'b' of 0.01 kg: 1 to 1,200")
    assert found.place == ("robot.urdf", 18, 3)
    assert found.only.fix.startswith("give 'b' at least 0.012 kg")
    assert found.only.phrase == "ODE Message 3: LCP internal error, s <= 0"
    fixed = robot(link(inertial()), light, joint.replace("continuous", "fixed"))
    assert judge(fixed).codes == []


def test_right_sdf_has_no_finding(judge) -> None:
    assert judge(sdf("<mass>12</mass>" + SDF_TENSOR), "model.sdf").codes == []


def test_sdf_is_judged_and_gets_sdf_blocks(judge) -> None:
    wrong = SDF_TENSOR.replace("0.1<", "0.02<")
    found = judge(sdf("<pose>0 0 0.1 0 0 0</pose><mass>12</mass>" + wrong), "model.sdf")
    assert found.only.code == "inertia.triangle"
    assert found.place[:2] == ("model.sdf", 4)
    assert "<iyy>0.1</iyy>" in found.only.fix
    assert "<pose>0 0 0 0 0 0</pose>" in found.only.fix


def test_sdf_without_inertial_is_told_of_the_default(judge) -> None:
    text = sdf("").replace("<inertial></inertial>", "")
    found = judge(text, "model.sdf")
    assert found.only.message == (
        "link 'a' moves and has no <inertial>: Gazebo gives it 1 kg and moments of 1 kg·m²"
    )


def test_static_models_and_computed_inertia_are_left_alone(judge) -> None:
    assert judge(sdf("").replace("<link", "<static>1</static><link"), "m.sdf").codes == []
    auto = sdf("").replace("<inertial>", '<inertial auto="true">').replace("1.6", "1.11")
    assert judge(auto, "m.sdf").codes == []


def test_unreadable_inertial_is_left_to_the_reader(judge) -> None:
    found = judge(robot(link(inertial("heavy"))))
    assert found.codes == []
    assert found.records[0].has_unreadable
    assert "xml.bad-number" in [item.code for item in found.read]


def test_repair_keeps_the_mass(judge) -> None:
    (record,) = judge(robot(link(inertial(moments=(1, 2, 9))))).records
    body = repaired(record)
    assert body is not None
    assert body.inertia_kg_m2 == pytest.approx((0.13, 0, 0, 0.1, 0, 0.05))
    heavier = repaired(record, 4000.0)
    assert heavier is not None
    assert heavier.mass_kg == pytest.approx(24.0)


def test_repair_without_shapes_legalises_the_tensor(judge) -> None:
    found = judge(robot(link(inertial(moments=(0.13, 0.02, 0.05)), shape="")))
    body = found.findings[0].body
    assert body is not None
    assert math.isclose(body.inertia_kg_m2[3] + body.inertia_kg_m2[5], 0.13)


def test_turned_moments_are_mixed_up(judge) -> None:
    wheel = '<collision><geometry><cylinder radius="0.1" length="0.04"/></geometry></collision>'
    # 2 kg: 0.01 about the axle, which is z, and 0.0053 about the others.
    right, wrong = (0.0053, 0.0053, 0.01), (0.0053, 0.01, 0.0053)
    assert judge(robot(link(inertial(2, right), shape=wheel))).codes == []
    found = judge(robot(link(inertial(2, wrong), shape=wheel)))
    assert found.codes == ["inertia.box"]
    assert "mixed up" in found.findings[0].diagnostic.message


@needs_shared
def test_mira_has_no_finding(workspaces_dir: Path) -> None:
    """Its table's formulas are those of the bodies."""
    found = judged(workspaces_dir / "catkin_ws/src/urdf_exam/urdf/mira_gazebo.urdf")
    assert len(found.records) == 7
    assert found.codes == []


@needs_shared
def test_wheels_of_mobile_robot_have_mixed_up_axes(workspaces_dir: Path) -> None:
    found = judged(workspaces_dir / "catkin_ws/src/urdf_tutorial/urdf/mobile_robot.urdf")
    assert found.codes == ["inertia.box", "inertia.box"]
    assert all("mixed up" in item.diagnostic.message for item in found.findings)


def test_stl_in_metres_has_no_finding_and_open_meshes_use_their_hull(judge, stl) -> None:
    part = box_mesh((0.1, 0.2, 0.3))
    stl("whole.stl", part.vertices_m[part.faces])
    stl("open.stl", part.vertices_m[part.faces][:-1])
    for name in ("whole.stl", "open.stl"):
        shape = f'<collision><geometry><mesh filename="{name}"/></geometry></collision>'
        assert judge(robot(link(inertial(), shape=shape))).codes == []


SDF_TENSOR = "<inertia><ixx>0.13</ixx><iyy>0.1</iyy><izz>0.05</izz></inertia>"


def sdf(inside: str) -> str:
    shape = "<geometry><box><size>0.1 0.2 0.3</size></box></geometry>"
    return (
        f'<sdf version="1.6">\n<model name="m">\n<link name="a">\n<inertial>{inside}</inertial>\n'
        f'<collision name="c">{shape}</collision>\n</link>\n</model>\n</sdf>\n'
    )
