"""Nothing that can be typed into a URDF ends in a traceback."""

from __future__ import annotations

import random
import re

import pytest

from gazelle.description.read_context import ReadContext
from gazelle.description.urdf_reader import read_urdf
from gazelle.diagnostics import Diagnostics

ROBOT = """<robot name="r"><material name="red"><color rgba="1 0 0 1"/></material>
<link name="a"><inertial><origin xyz="0 0 1"/><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
<visual name="v"><origin rpy="0 0 1"/><geometry><box size="1 1 1"/></geometry>
<material name="red"/></visual><collision><geometry><cylinder radius="1" length="1"/></geometry>
</collision></link><link name="b"><collision><geometry><sphere radius="1"/></geometry></collision>
</link><link name="c"/><joint name="j" type="revolute"><parent link="a"/><child link="b"/>
<axis xyz="0 0 1"/><limit lower="0" upper="1" effort="1" velocity="1"/>
<dynamics damping="1"/><safety_controller k_velocity="1"/><calibration rising="0"/></joint>
<joint name="k" type="prismatic"><parent link="b"/><child link="c"/><mimic joint="j"/>
<limit lower="0" upper="1" effort="1" velocity="1"/></joint>
<transmission name="t"><type>s</type><joint name="j"><hardwareInterface>E</hardwareInterface>
</joint><actuator name="m"><mechanicalReduction>1</mechanicalReduction></actuator></transmission>
<gazebo reference="a"><mu1>1</mu1><fdir1>1 0 0</fdir1><kp>1</kp><maxContacts>3</maxContacts>
<material>Gazebo/Red</material><selfCollide>true</selfCollide><dampingFactor>1</dampingFactor>
<visual><transparency>0.5</transparency></visual><collision><surface><friction><ode><mu>1</mu>
</ode></friction></surface></collision><sensor name="s" type="ray"><pose>0 0 0 0 0 0</pose>
<update_rate>5</update_rate><ray><range><min>0.1</min></range></ray>
<plugin name="p" filename="l.so"/></sensor></gazebo>
<gazebo reference="j"><springStiffness>1</springStiffness><physics><ode><limit><cfm>1</cfm>
</limit></ode></physics></gazebo><gazebo><static>0</static><plugin name="q" filename="d.so"/>
</gazebo></robot>"""
WORDS = ("", "nan", "1e999", "-1", "0", "0 0 0", "1 2", "a", "world", "true", "é ☃", "1" * 400)


def _read(text: str) -> Diagnostics:
    diagnostics = Diagnostics()
    model = read_urdf(text, context=ReadContext(None, diagnostics, "robot.urdf"))
    assert model is not None or diagnostics.errors
    return diagnostics


def test_the_unchanged_robot_is_good() -> None:
    assert not _read(ROBOT).errors


@pytest.mark.parametrize("seed", range(8))
def test_changed_values_names_and_tags_never_raise(seed: int) -> None:
    generator = random.Random(seed)
    values = [found.span(1) for found in re.finditer(r'="([^"]*)"|>([^<>\n]+)<', ROBOT)]
    tags = [found.span() for found in re.finditer(r"<[^<>]*/>", ROBOT)]
    for _ in range(60):
        text = ROBOT
        start, end = generator.choice([span for span in values if span[0] >= 0])
        text = text[:start] + generator.choice(WORDS) + text[end:]
        if generator.random() < 0.5:
            start, end = generator.choice(tags)
            text = ROBOT[:start] + ROBOT[end:]
        _read(text)


@pytest.mark.parametrize("seed", range(4))
def test_damaged_texts_never_raise(seed: int) -> None:
    generator = random.Random(seed)
    for _ in range(60):
        place = generator.randrange(len(ROBOT))
        length = generator.randrange(1, 40)
        _read(ROBOT[:place] + generator.choice(("", "<", '"', "&", "\0")) + ROBOT[place + length :])
