"""Whole SRDFs: what is read, and what is told about what cannot be."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.description.model import Model
from gazelle.description.read_context import ReadContext
from gazelle.description.srdf import (
    Chain,
    CollisionPair,
    EndEffector,
    link_names,
    load_srdf,
)
from gazelle.description.urdf_reader import read_urdf
from gazelle.diagnostics import Diagnostics

Reader = Callable[[str], Any]

_WHOLE = """
<group name="arm"><chain base_link="base" tip_link="tool"/></group>
<group name="hand"><link name="hand"/><joint name="left"/><joint name="right"/></group>
<group name="all"><group name="arm"/><group name="hand"/></group>
<group_state name="home" group="arm"><joint name="shoulder" value="0.5"/></group_state>
<group_state name="there" group="all"><joint name="base_joint" value="1 2 0.5"/></group_state>
<end_effector name="gripper" parent_link="tool" group="hand" parent_group="arm"/>
<virtual_joint name="base_joint" type="PLANAR" parent_frame="odom" child_link="base"/>
<passive_joint name="right"/>
<disable_default_collisions link="hand"/>
<enable_collisions link1="hand" link2="base"/>
<disable_collisions link1="base" link2="upper" reason="Adjacent"/>
<joint_property joint_name="wrist" property_name="angular_distance_weight" value="0.5"/>
"""


def test_every_element_is_read(read: Reader) -> None:
    found = read(_WHOLE)
    srdf = found.content
    assert list(found.diagnostics) == []
    assert [group.name for group in srdf.groups] == ["arm", "hand", "all"]
    assert srdf.groups[0].chains == (Chain("base", "tool"),)
    assert (srdf.groups[1].links, srdf.groups[1].joints) == (("hand",), ("left", "right"))
    assert srdf.groups[2].subgroups == ("arm", "hand")
    assert srdf.states_of("arm")[0].values == {"shoulder": (0.5,)}
    assert srdf.states_of("all")[0].values == {"base_joint": (1.0, 2.0, 0.5)}
    gripper = srdf.end_effectors[0]
    assert gripper == EndEffector("gripper", "hand", "tool", "arm", gripper.span)
    joint = srdf.virtual_joints[0]
    assert (joint.type, joint.parent_frame, joint.child_link) == ("planar", "odom", "base")
    assert srdf.passive_joints == ("right",)
    assert srdf.no_default_collisions == ("hand",)
    assert srdf.enabled_pairs == (CollisionPair("hand", "base"),)
    assert srdf.disabled_pairs == (CollisionPair("base", "upper", "Adjacent"),)
    assert srdf.joint_properties == {"wrist": {"angular_distance_weight": "0.5"}}


def test_root_link_world_is_a_link_as_in_moveit(tmp_path: Path) -> None:
    text = (
        '<robot name="r"><link name="world"/><link name="a"/><joint name="fixed" type="fixed">'
        '<parent link="world"/><child link="a"/></joint></robot>'
    )
    diagnostics = Diagnostics()
    robot = read_urdf(text, context=ReadContext(None, diagnostics, "r.urdf"))
    assert robot is not None and link_names(robot) == ["world", "a"]
    file = tmp_path / "r.srdf"
    file.write_text(
        '<robot name="r"><group name="g"><chain base_link="world" tip_link="a"/></group>'
        '<virtual_joint name="v" type="fixed" parent_frame="map" child_link="world"/></robot>',
        encoding="utf-8",
    )
    srdf = load_srdf(file, robot=robot, workspace=None, diagnostics=diagnostics)
    assert srdf is not None
    assert srdf.groups[0].chains == (Chain("world", "a"),)
    assert srdf.virtual_joints[0].child_link == "world"
    assert not diagnostics.by_code("parameters.srdf-name")


def test_all_unknown_names_are_told_at_once_with_places(read: Reader) -> None:
    found = read(
        '<group name="arm"><chain base_link="bas" tip_link="tool"/>\n'
        '  <joint name="elbo"/></group>\n'
        '<group_state name="home" group="amr"/>\n'
        '<disable_collisions link1="upper" link2="lowr"/>\n'
        '<passive_joint name="rigth"/>'
    )
    text = found.text("parameters.srdf-name")
    assert "arm.srdf:2:37: warning: <chain base_link=\"bas\">: the robot has no link 'bas'" in text
    assert "(Link 'bas' is not known to URDF); it is left out, as MoveIt does" in text
    assert "did you mean 'base'?" in text
    assert "arm.srdf:3:16" in text and "did you mean 'elbow'?" in text
    assert "the SRDF has no group 'amr'" in text and "did you mean 'arm'?" in text
    assert "did you mean 'lower'" in text and "did you mean 'right' or 'wrist'?" in text
    assert len(found.diagnostics.by_code("parameters.srdf-name")) == 5
    assert found.content.groups[0].chains == () and found.content.disabled_pairs == ()


@pytest.mark.parametrize(
    ("inside", "code", "words"),
    [
        ("<group/>", "srdf.missing-attribute", "<group> has no 'name' and is left out"),
        ('<group name="a"/>', "srdf.empty-group", "group 'a' has no link, joint, chain or group"),
        (
            '<group name="a"><joint name="left"/></group><group name="a"/>',
            "srdf.double-name",
            "a second <group> is named 'a'; the first one counts",
        ),
        (
            '<group name="a"><group name="b"/></group><group name="b"><group name="a"/></group>',
            "srdf.group-ring",
            "group 'a' holds itself by way of b",
        ),
        (
            '<group name="a"><chain base_link="base" tip_link="alone"/></group>',
            "srdf.no-chain",
            "Links 'base' and 'alone' do not form a chain",
        ),
        (
            '<group name="a"><joint name="elbow"/></group>'
            '<group_state name="up" group="a"><joint name="elbow" value="2.5"/></group_state>',
            "srdf.state-outside-limits",
            "joint 'elbow' is at 2.5, its limits are -1 and 2",
        ),
        (
            '<group name="a"><joint name="elbow"/></group>'
            '<group_state name="up" group="a"><joint name="elbow" value="1,5"/></group_state>',
            "xml.bad-number",
            "the decimal sign is a dot",
        ),
        (
            '<group name="a"><joint name="mount"/></group>'
            '<group_state name="up" group="a"><joint name="mount" value="0"/></group_state>',
            "srdf.fixed-state",
            "joint 'mount' is fixed and has no position; its value has no effect",
        ),
        (
            '<virtual_joint name="v" type="fixd" parent_frame="world" child_link="base"/>',
            "srdf.virtual-joint",
            "did you mean 'fixed'?",
        ),
        (
            '<link_sphere_approximation link="upper"><sphere center="0 0 0" radius="1"/>'
            "</link_sphere_approximation>",
            "srdf.spheres",
            "the spheres of 'upper' have no effect",
        ),
        ("<groop/>", "xml.unknown-tag", "did you mean 'group'?"),
        (
            '<disable_collisions link_1="a" link2="upper"/>',
            "xml.unknown-attribute",
            "'link1' or 'link2'?",
        ),
    ],
)
def test_mistakes_are_told(read: Reader, inside: str, code: str, words: str) -> None:
    assert words in read(inside).text(code)


def test_spheres_are_kept_with_their_numbers(read: Reader) -> None:
    inside = '<sphere center="0 0.5 1" radius="0.25"/>'
    text = f'<link_sphere_approximation link="upper">{inside}</link_sphere_approximation>'
    assert read(text).content.spheres[0].spheres_m == ((0.0, 0.5, 1.0, 0.25),)


def test_groups_that_hold_a_broken_group_are_left_out_with_it(
    read: Reader,
) -> None:
    found = read(
        '<group name="a"><group name="b"/></group><group name="b"><group name="a"/></group>'
        '<group name="c"><group name="b"/></group><group name="d"><joint name="left"/></group>'
    )
    assert [group.name for group in found.content.groups] == ["d"]


def test_another_robots_srdf_is_told(arm: Model) -> None:
    diagnostics = Diagnostics()
    text = '<robot name="leg"/>'
    assert load_srdf(text, robot=arm, workspace=None, diagnostics=diagnostics) is not None
    (found,) = diagnostics.by_code("srdf.robot-name")
    assert found.message == "the SRDF is for robot 'leg', the URDF is 'arm'"
    assert found.phrase.startswith("Semantic description is not specified for the same robot")


def test_a_urdf_root_of_another_name_is_no_srdf() -> None:
    diagnostics = Diagnostics()
    assert load_srdf("<model/>", robot=None, workspace=None, diagnostics=diagnostics) is None
    assert diagnostics.by_code("srdf.no-robot")[0].message.endswith("not <model>")


def test_xacro_makes_an_srdf(arm: Model, tmp_path: Path) -> None:
    file = tmp_path / "arm.srdf.xacro"
    file.write_text(
        '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">'
        '<xacro:arg name="tip" default="tool"/>'
        '<group name="arm"><chain base_link="base" tip_link="$(arg tip)"/></group></robot>',
        encoding="utf-8",
    )
    diagnostics = Diagnostics()
    found = load_srdf(
        file, robot=arm, workspace=None, diagnostics=diagnostics, mappings={"tip": "lower"}
    )
    assert found is not None and found.groups[0].chains == (Chain("base", "lower"),)
    assert found.file == file and list(diagnostics) == []
