"""SRDFs as texts."""

from __future__ import annotations

from dataclasses import replace

from gazelle.description.srdf import Srdf, load_srdf
from gazelle.description.srdf.writer import srdf_text
from gazelle.diagnostics import Diagnostics

_TEXT = """<robot name="r">
  <group name="arm"><chain base_link="a" tip_link="b"/></group>
  <group name="hand"><link name="c"/><joint name="j"/></group>
  <group name="all"><group name="arm"/><group name="hand"/></group>
  <group_state name="home" group="arm"><joint name="x" value="0.5"/></group_state>
  <group_state name="there" group="arm"><joint name="p" value="1 2 0.25"/></group_state>
  <end_effector name="e" parent_link="b" group="hand" parent_group="arm"/>
  <virtual_joint name="v" type="planar" parent_frame="odom" child_link="a"/>
  <passive_joint name="q"/>
  <joint_property joint_name="x" property_name="kind" value="a &lt; b"/>
  <link_sphere_approximation link="c">
    <sphere center="0 0 1" radius="0.5"/>
  </link_sphere_approximation>
  <disable_default_collisions link="c"/>
  <enable_collisions link1="a" link2="c"/>
  <disable_collisions link1="a" link2="b" reason="Adjacent"/>
</robot>"""


def _read(text: str) -> Srdf:
    found = load_srdf(text, robot=None, workspace=None, diagnostics=Diagnostics())
    assert found is not None
    return found


def _plain(srdf: Srdf) -> Srdf:
    """Without the places where things are written."""
    return replace(
        srdf,
        groups=tuple(replace(item, span=None) for item in srdf.groups),
        states=tuple(replace(item, span=None) for item in srdf.states),
        end_effectors=tuple(replace(item, span=None) for item in srdf.end_effectors),
        virtual_joints=tuple(replace(item, span=None) for item in srdf.virtual_joints),
    )


def test_what_is_read_of_a_written_srdf_is_the_same() -> None:
    first = _read(_TEXT)
    text = srdf_text(first)
    assert _plain(_read(text)) == _plain(first)
    assert srdf_text(_read(text)) == text


def test_an_empty_srdf_is_a_robot_and_its_name() -> None:
    assert srdf_text(Srdf("r")).splitlines()[1:] == ['<robot name="r">', "</robot>"]
