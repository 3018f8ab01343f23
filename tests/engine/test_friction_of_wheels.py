"""Wide wheels and the friction that robot files give them."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from gazelle.description.model import World
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader import read_sdf
from gazelle.description.urdf_reader.reader import read_urdf
from gazelle.diagnostics import Diagnostics
from gazelle.engine import Engine
from gazelle.engine.friction import MAX_WHEEL_MU, with_wheel_friction
from gazelle.geometry import Pose

INERTIA = '<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/>'


def wheel(name: str, y: float, mu: float) -> str:
    return f"""<link name="{name}"><inertial><mass value="2"/>{INERTIA}</inertial>
      <collision><origin rpy="{math.pi / 2} 0 0"/>
        <geometry><cylinder radius="0.1" length="0.06"/></geometry></collision></link>
    <joint name="{name}_joint" type="continuous"><parent link="base"/><child link="{name}"/>
      <origin xyz="0 {y} 0"/><axis xyz="0 1 0"/><limit effort="20" velocity="50"/></joint>
    <gazebo reference="{name}"><mu1>{mu}</mu1><mu2>{mu}</mu2></gazebo>"""


def robot(mu: float):
    ball = """<link name="ball"><collision><origin xyz="-0.3 0 -0.05"/>
      <geometry><sphere radius="0.05"/></geometry></collision></link>
    <joint name="weld" type="fixed"><parent link="base"/><child link="ball"/></joint>
    <gazebo reference="ball"><mu1>0</mu1><mu2>0</mu2></gazebo>"""
    text = f"""<robot name="cart"><link name="base"><inertial><origin xyz="-0.05 0 0"/>
      <mass value="40"/>{INERTIA}</inertial></link>{ball}{wheel("left", 0.25, mu)}
      {wheel("right", -0.25, mu)}</robot>"""
    return read_urdf(text, context=ReadContext(None, Diagnostics(), "cart.urdf"))


@pytest.mark.parametrize("mu", [1.0, 200.0])
def test_a_cart_turns_by_its_wheels_whatever_their_friction(build, mu):
    engine = Engine(World(models=(build.ground(mu1=200.0, mu2=200.0), robot(mu))))
    engine.set_model_pose("cart", Pose((0, 0, 0.1)))
    for side, speed in (("left", -2.0), ("right", 2.0)):
        engine.joint(f"cart::{side}_joint").set_velocity_target(speed, 20.0)
    engine.step(1000)
    before = engine.model_pose("cart").quat_xyzw
    engine.step(1000)
    after = engine.model_pose("cart").quat_xyzw
    turned = 2 * (math.atan2(after[2], after[3]) - math.atan2(before[2], before[3]))
    assert turned == pytest.approx(2.0 * 0.1 / 0.25, rel=0.05)


@pytest.mark.parametrize(("mu2", "counts"), [(1.0, (1.0, 1.0)), (0.1, (2.0, 0.1))])
def test_wheels_with_two_coefficients_of_one_size_have_the_smaller_one(mu2, counts):
    model = robot(3.0)
    link = next(item for item in model.links if item.name == "left")
    surface = replace(link.collisions[0].surface, mu2=mu2)
    found = Diagnostics()
    wheel = replace(link.collisions[0], surface=surface)
    grip = with_wheel_friction(model, link, wheel, found).surface
    assert (grip.mu1, grip.mu2) == counts
    if counts[0] == counts[1]:
        (finding,) = found.by_code("engine.friction-direction")
        assert "of a wheel has mu 3 and mu2 1; the engine cannot turn" in finding.message
    else:
        assert not list(found)


def test_only_wheels_are_limited():
    model = robot(200.0)
    for name, most in (("left", MAX_WHEEL_MU), ("ball", 0.0)):
        link = next(item for item in model.links if item.name == name)
        surface = with_wheel_friction(model, link, link.collisions[0], Diagnostics()).surface
        assert (surface.mu1, surface.mu2) == (most, most)


def test_endless_revolute_joints_of_sdf_carry_wheels_too():
    text = """<sdf version="1.6"><model name="bot"><link name="base"/>
      <link name="wheel"><collision name="c"><geometry><cylinder><radius>0.1</radius>
        <length>0.05</length></cylinder></geometry><surface><friction><ode><mu>200</mu>
        <mu2>200</mu2></ode></friction></surface></collision></link>
      <joint name="j" type="revolute"><parent>base</parent><child>wheel</child>
        <axis><xyz>0 0 1</xyz>{}</axis></joint></model></sdf>"""
    for limit, most in (
        ("", MAX_WHEEL_MU),
        ("<limit><lower>-1e16</lower><upper>1e16</upper></limit>", MAX_WHEEL_MU),
        ("<limit><lower>-3</lower><upper>3</upper></limit>", 200.0),
    ):
        context = ReadContext(None, Diagnostics(), "bot.sdf")
        (model,) = read_sdf(text.format(limit), context=context).models
        surface = with_wheel_friction(
            model, model.links[1], model.links[1].collisions[0], Diagnostics()
        ).surface
        assert (surface.mu1, surface.mu2) == (most, most)
