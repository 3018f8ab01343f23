"""srdfdom's objects."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.compat.moveit_configs.srdfdom import SRDF
from gazelle.errors import UserFileError

_TEXT = """<robot name="arm">
<group name="a"><chain base_link="b" tip_link="t"/><link name="l"/><joint name="j"/></group>
<group name="all"><group name="a"/></group>
<group_state name="home" group="a"><joint name="j" value="0.5 1"/></group_state>
<end_effector name="e" parent_link="t" group="a"/>
<virtual_joint name="v" type="fixed" parent_frame="world" child_link="b"/>
<passive_joint name="p"/>
<disable_collisions link1="b" link2="t" reason="Never"/>
<link_sphere_approximation link="l">
  <sphere center="0 0 1" radius="0.5"/>
</link_sphere_approximation>
</robot>"""


def test_every_element_is_an_object(tmp_path: Path) -> None:
    file = tmp_path / "arm.srdf"
    file.write_text(_TEXT, encoding="utf-8")
    found = SRDF.from_xml_string(_TEXT)
    assert found == SRDF.from_xml_file(file) == SRDF.from_xml_string(_TEXT.encode())
    assert found.name == "arm" and found.group_map["a"].chains[0].tip_link == "t"
    assert found.group_map["a"].links[0].name == "l" and found.groups[0].joints[0].name == "j"
    assert found.group_map["all"].subgroups[0].name == "a"
    assert found.group_state_map["home"].joints[0].value == [0.5, 1.0]
    assert found.end_effectors[0].parent_group is None
    assert found.virtual_joints[0].joint_type == "fixed"
    assert found.virtual_joints[0].parent_frame == "world"
    assert found.passive_joints[0].name == "p"
    assert found.disable_collisionss[0].reason == "Never"
    assert found.link_sphere_approximations[0].spheres[0].radius == 0.5


def test_text_that_is_no_xml_is_an_error() -> None:
    with pytest.raises(UserFileError, match="robot_description_semantic"):
        SRDF.from_xml_string("<robot")
