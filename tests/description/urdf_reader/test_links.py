from __future__ import annotations

from gazelle.description.model import Box, Sphere

SPHERE = "<geometry><sphere radius='1'/></geometry>"


def test_all_visuals_and_collisions_are_kept_with_names_like_gazebo_s(read_link) -> None:
    link = read_link(
        f"<visual>{SPHERE}</visual><visual>{SPHERE}</visual><visual name='v'>{SPHERE}</visual>"
        f"<collision><origin xyz='0 0 1'/>{SPHERE}</collision><collision name='c'>"
        "<geometry><box size='1 2 3'/></geometry></collision>"
    ).robot.link("a")
    assert [item.name for item in link.visuals] == ["a_visual", "a_visual_1", "v"]
    assert [item.name for item in link.collisions] == ["a_collision", "c"]
    assert [item.shape for item in link.collisions] == [Sphere(1.0), Box((1.0, 2.0, 3.0))]
    assert link.collisions[0].T_link_collision.position_m == (0.0, 0.0, 1.0)


def test_same_name_twice_is_made_unique(read_link) -> None:
    link = read_link(f"<visual name='v'>{SPHERE}</visual><visual name='v'>{SPHERE}</visual>")
    assert [item.name for item in link.robot.link("a").visuals] == ["v", "v_1"]


def test_inertial_keeps_frame_and_tensor(read) -> None:
    found = read(
        '<robot name="r"><link name="a"><inertial><origin xyz="1 2 3" rpy="0 0 0"/>'
        '<mass value="2"/><inertia ixx="3" ixy="0.1" ixz="0.2" iyy="4" iyz="0.3" izz="5"/>'
        "</inertial></link></robot>"
    )
    inertial = found.robot.link("a").inertial
    assert inertial.mass_kg == 2.0
    assert inertial.inertia_kg_m2 == (3.0, 0.1, 0.2, 4.0, 0.3, 5.0)
    assert inertial.T_link_com.position_m == (1.0, 2.0, 3.0)
    assert not inertial.estimated
    assert not found.codes


def test_incomplete_inertial_says_what_is_missing(read) -> None:
    found = read(
        '<robot name="r"><link name="a"><inertial><mass value="2"/>'
        '<inertia ixx="3" iyy="4"/></inertial></link></robot>'
    )
    message = found.message("urdf.inertial-incomplete")
    assert "<inertial> of link 'a' cannot be used: <inertia> lacks ixy, ixz, iyz, izz" in message
    assert "Could not parse inertial element for Link" in message


def test_second_inertial_is_reported(read_link) -> None:
    found = read_link("<inertial><mass value='3'/></inertial>")
    assert "<inertial> stands more than once in <link>" in found.message("xml.repeated-tag")
    assert found.robot.link("a").inertial.mass_kg == 1.0


def test_origin_with_quaternion_and_rpy_reports_it(read_link) -> None:
    found = read_link(
        f"<visual><origin rpy='0 0 1' quat_xyzw='0 0 0 2'/>{SPHERE}</visual>"
        f"<visual><origin quat_xyzw='0 0 1 0'/>{SPHERE}</visual>"
    )
    assert "quat_xyzw is used" in found.message("urdf.origin-twice")
    visuals = found.robot.link("a").visuals
    assert [item.T_link_visual.quat_xyzw for item in visuals] == [(0, 0, 0, 1), (0, 0, 1, 0)]
