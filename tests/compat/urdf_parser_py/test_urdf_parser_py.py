"""urdf_parser_py: robots of URDF as objects, read, walked, changed and written."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.compat.urdf_parser_py.robot import URDF, Joint, JointLimit, JointMimic, Link
from gazelle.compat.urdf_parser_py.shapes import (
    Box,
    Collision,
    Color,
    Inertia,
    Inertial,
    Material,
    Mesh,
    Pose,
    Visual,
)
from gazelle.compat.urdf_parser_py.value_types import ParseError

_ARM = """<?xml version="1.0" encoding="utf-8"?>
<robot name="arm">
  <!-- a comment -->
  <material name="red"><color rgba="1 0 0 1"/></material>
  <link name="base"/>
  <link name="upper">
    <inertial><origin xyz="0 0 0.5"/><mass value="2"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="2" iyz="0.5" izz="3"/></inertial>
    <visual name="look"><geometry><mesh filename="package://arm/a.stl" scale="1 2 3"/></geometry>
      <material name="red"/></visual>
    <visual><geometry><sphere radius="0.2"/></geometry></visual>
    <collision><origin rpy="0 0 1.5"/><geometry><box size="1 2 3"/></geometry></collision>
  </link>
  <link name="tool"/>
  <joint name="lift" type="revolute">
    <parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit effort="10" velocity="2" upper="1.5"/><mimic joint="other" multiplier="-1"/>
    <dynamics damping="0.7"/><safety_controller k_velocity="5"/>
  </joint>
  <joint name="mount" type="fixed"><parent link="upper"/><child link="tool"/></joint>
  <gazebo reference="tool"><gravity>false</gravity></gazebo>
  <transmission name="t"><type>simple</type>
    <joint name="lift"><hardwareInterface>EffortJointInterface</hardwareInterface></joint>
    <actuator name="motor"><mechanicalReduction>50</mechanicalReduction></actuator></transmission>
  <transmission name="old" type="SimpleTransmission"><actuator name="m"/><joint name="lift"/>
    <mechanicalReduction>3</mechanicalReduction></transmission>
</robot>"""


def test_every_element_is_an_object(tmp_path: Path) -> None:
    file = tmp_path / "arm.urdf"
    file.write_text(_ARM, encoding="utf-8")
    for arm in (URDF.from_xml_string(_ARM), URDF.from_xml_file(str(file)), URDF().parse(_ARM)):
        assert (arm.name, arm.version) == ("arm", "1.0")
        upper, lift = arm.link_map["upper"], arm.joint_map["lift"]
        assert arm.links[1] is upper and arm.joints[0] is lift
        assert upper.inertial.mass == 2.0 and upper.inertial.origin.xyz == [0.0, 0.0, 0.5]
        assert upper.inertial.inertia.to_matrix()[1] == [0.0, 2.0, 0.5]
        assert isinstance(upper.visual.geometry, Mesh) and upper.visual.name == "look"
        assert upper.visual.geometry.scale == [1.0, 2.0, 3.0] and upper.visual.origin is None
        assert upper.visuals[1].geometry.radius == 0.2 and upper.visual.material.name == "red"
        assert upper.collision.origin.rotation == [0.0, 0.0, 1.5]
        assert upper.collision.origin.position == [0, 0, 0]
        assert (lift.type, lift.joint_type, lift.parent, lift.child) == (
            *("revolute", "revolute", "base", "upper"),
        )
        assert (lift.axis, lift.limit.lower, lift.limit.upper) == ([0.0, 0.0, 1.0], 0, 1.5)
        assert lift.limit.effort == 10.0 and lift.limit.velocity == 2.0
        assert (lift.mimic.joint, lift.mimic.multiplier, lift.mimic.offset) == ("other", -1, None)
        assert lift.dynamics.damping == 0.7 and lift.safety_controller.soft_lower_limit == 0
        assert lift.calibration is None and arm.joint_map["mount"].limit is None
        assert arm.materials[0].color.rgba == [1.0, 0.0, 0.0, 1.0]
        assert arm.gazebos[0].get("reference") == "tool"
        new, old = arm.transmissions
        assert new.joints[0].hardwareInterfaces == ["EffortJointInterface"]
        assert new.actuators[0].mechanicalReduction == 50.0 and new.type == "simple"
        assert (old.joint, old.type, old.mechanicalReduction) == ("lift", "SimpleTransmission", 3)


def test_chains_lead_from_a_root_to_a_tip() -> None:
    arm = URDF.from_xml_string(_ARM)
    assert arm.get_root() == "base"
    assert arm.get_chain("base", "tool") == ["base", "lift", "upper", "mount", "tool"]
    assert arm.get_chain("base", "tool", links=False) == ["lift", "mount"]
    assert arm.get_chain("base", "tool", links=False, fixed=False) == ["lift"]
    assert arm.get_chain("upper", "tool", joints=False) == ["upper", "tool"]
    assert arm.parent_map["tool"] == ("mount", "upper")
    assert arm.child_map["base"] == [("lift", "upper")]
    arm.add_link(Link(name="loose"))
    with pytest.raises(AssertionError, match="Multiple roots detected"):
        arm.get_root()


def test_what_is_written_is_read_the_same() -> None:
    text = URDF.from_xml_string(_ARM).to_xml_string()
    assert text.startswith('<?xml version="1.0" ?>\n<robot name="arm" version="1.0">\n  <material')
    once_more = URDF.from_xml_string(text).to_xml_string()
    assert URDF.from_xml_string(once_more).to_xml_string() == once_more
    assert '<limit effort="10.0" lower="0" upper="1.5" velocity="2.0"/>' in text
    assert "<gravity>false</gravity>" in text
    again = URDF.from_xml_string(text)
    assert again.get_chain("base", "tool", links=False) == ["lift", "mount"]
    assert again.transmissions[0].joints[0].hardwareInterfaces == ["EffortJointInterface"]


def test_attributes_keep_their_order_beside_xacro(monkeypatch: pytest.MonkeyPatch) -> None:
    from xml.dom import minidom

    from xacro.xmlutils import fixed_writexml

    monkeypatch.setattr(minidom.Element, "writexml", fixed_writexml)
    assert Pose([0, 0, 1]).to_xml_string(addHeader=False) == '<origin xyz="0 0 1" rpy="0 0 0"/>'


def test_robots_are_made_by_hand() -> None:
    robot = URDF("made")
    link = Link("box", Visual(Box([1, 1, 1]), Material("m", Color(0.1, 0.2, 0.3))))
    link.collision = Collision(Box([2, 2, 2]), Pose([0, 0, 1]))
    link.inertial = Inertial(3.0, Inertia(ixx=1.0))
    robot.add_link(link)
    joint = Joint("j", "world", "box", "prismatic", [1, 0, 0], limit=JointLimit(1, 2, 0, 1))
    joint.mimic = JointMimic("k", 2.0)
    robot.add_joint(joint)
    assert len(link.visuals) == 1
    text = robot.to_xml_string(addHeader=False)
    assert text.startswith('<robot name="made" version="1.0">')
    assert '<color rgba="0.1 0.2 0.3 1.0"/>' in text
    assert '<origin xyz="0 0 1" rpy="0 0 0"/>' in text
    assert '<mimic joint="k" multiplier="2.0"/>' in text
    robot.remove_aggregate(link)
    assert "<link" not in robot.to_xml_string()
    assert "name: made" in str(robot)
    with pytest.raises(Exception, match="Required attribute not set in object: size"):
        Box().to_xml()


@pytest.mark.parametrize(
    ("text", "place", "why"),
    [
        ('<robot name="r"><link/></robot>', "/robot[@name='r']/link[1]", "Required attribute"),
        (
            '<robot name="r"><link name="l"/><joint name="j" type="hinge"><parent link="l"/>'
            '<child link="m"/></joint></robot>',
            "/robot[@name='r']/joint[@name='j']",
            "Invalid joint type: hinge",
        ),
        (
            '<robot name="r"><link name="l"><visual><origin xyz="1 2"/><geometry/></visual></link>'
            "</robot>",
            "/robot[@name='r']/link[@name='l']/visual[1]/origin[@xyz]",
            "Invalid vector length",
        ),
        (
            '<robot name="r"><transmission name="t"><type>a</type><joint name="j"/></transmission>'
            "</robot>",
            "/robot[@name='r']/transmission[1][@name='t']/joint[@name='j']",
            "no hardwareInterface defined",
        ),
    ],
)
def test_what_cannot_be_read_is_told_with_its_place(text: str, place: str, why: str) -> None:
    with pytest.raises(ParseError, match="ParseError in ") as told:
        URDF.from_xml_string(text)
    assert why in str(told.value)
    if "transmission" not in place:
        assert str(told.value.path) == place


def test_versions_other_than_1_0_are_refused() -> None:
    with pytest.raises(ValueError, match=r"Invalid version; only 1\.0 is supported"):
        URDF.from_xml_string('<robot name="r" version="1.1"/>')
    with pytest.raises(ValueError, match=r"should be in the form 'x\.y'"):
        URDF.from_xml_string('<robot name="r" version="foo"/>')


def test_what_is_unknown_is_told_and_left_out(capsys: pytest.CaptureFixture[str]) -> None:
    text = '<link name="b" colour="red"><wheel/><inertial><mass value="1"/></inertial></link>'
    assert Link.from_xml_string(text).inertial.mass == 1.0
    told = capsys.readouterr().err
    assert """Unknown attribute "colour" in /link[@name='b']""" in told
    assert """Unknown tag "wheel" in /link[@name='b']""" in told
    Link.from_xml_string('<link name="b"><origin/><origin/></link>')
    assert "Scalar element defined multiple times: origin" in capsys.readouterr().err


def test_lists_are_written_together_when_lumped() -> None:
    robot = URDF.from_xml_string(
        '<robot name="r"><joint name="j" type="fixed"><parent link="l"/><child link="m"/></joint>'
        '<link name="l"/><link name="m"/></robot>'
    )
    robot.lump_aggregates()
    assert [child.tag for child in robot.to_xml()] == ["link", "link", "joint"]


def test_programs_use_it_by_the_original_names(passes: Callable[..., Any]) -> None:
    passes("""
import io, sys
import rospy
from urdf_parser_py.urdf import URDF, Link, Robot
import urdf_parser_py.xml_reflection as xmlr
from urdf_parser_py.xml_reflection.basics import *
told = []
xmlr.core.on_error = told.append
assert URDF is Robot
rospy.set_param("/robot_description", '<robot name="r"><link name="base"/><odd/></robot>')
robot = URDF.from_parameter_server()
assert robot.get_root() == "base" and robot.link_map["base"].name == "base"
assert told == ["Unknown tag \\"odd\\" in /robot[@name='r']"], told

class Speaker(xmlr.Object):
    def __init__(self, watts=None):
        self.watts = watts
xmlr.reflect(Speaker, tag="speaker", params=[
    xmlr.Attribute("watts", float), xmlr.Element("place", "vector3", False)])
assert Speaker.from_xml_string('<speaker watts="4"><place>1 2 3</place></speaker>').watts == 4.0
try:
    import urdf_parser_py.sdf
except ImportError as error:
    assert "gazelle: it ends with a NameError in urdf_parser_py too" in str(error), error
""")
