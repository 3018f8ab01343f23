from __future__ import annotations

import pytest

from gazelle.description.sdf_reader import read_sdf
from gazelle.diagnostics import Severity

BOX = "<model name='{}'>{}<link name='l'><pose>0 0 0.5 0 0 0</pose></link></model>"


def test_models_frames_and_joints_of_a_world(world):
    found = world(
        BOX.format("a", "<pose>1 0 0 0 0 0</pose>")
        + "<frame name='f' attached_to='a'><pose>0 0 1 0 0 0</pose></frame>"
        + BOX.format("b", "<pose relative_to='f'>0 1 0 0 0 0</pose>")
        + "<joint name='j' type='fixed'><parent>a</parent><child>b::l</child></joint>"
        + "<plugin name='p' filename='libw.so'/>"
    )
    assert found.model("a").T_world_model.position_m == (1, 0, 0)
    assert found.model("b").T_world_model.position_m == (1, 1, 1)
    assert [(item.name, item.attached_to) for item in found.frames] == [("f", "a::l")]
    assert found.frames[0].T_model_frame.position_m == (1, 0, 1)
    joint = found.joints[0]
    assert (joint.parent, joint.child) == ("a::l", "b::l")
    assert joint.T_model_joint.position_m == pytest.approx((1, 1, 1.5))
    assert found.plugins[0].filename == "libw.so"


def test_model_relative_to_a_link_of_another_model(world):
    found = world(
        BOX.format("a", "") + BOX.format("b", "<pose relative_to='a::l'>0 0 1 0 0 0</pose>")
    )
    assert found.model("b").T_world_model.position_m == (0, 0, 1.5)


def test_joint_to_a_missing_model_is_reported(world, diagnostics):
    world(
        BOX.format("a", "")
        + "<joint name='j' type='fixed'><parent>a</parent><child>z</child></joint>"
    )
    assert "not found in the world" in diagnostics.by_code("sdf.bad-joint")[0].message


def test_fields_of_the_air(world):
    found = world(
        "<gravity>0 0 -1.6</gravity><magnetic_field>1e-6 2e-6 3e-6</magnetic_field>"
        "<wind><linear_velocity>1 2 3</linear_velocity></wind>"
    )
    assert found.gravity_m_s2 == (0, 0, -1.6)
    assert found.magnetic_field_t == (1e-6, 2e-6, 3e-6)
    assert found.wind_m_s == (1, 2, 3)


def test_second_model_of_a_name_is_renamed(world, diagnostics):
    found = world(BOX.format("a", "") * 3)
    assert [item.name for item in found.models] == ["a", "a_0", "a_1"]
    assert {item.severity for item in diagnostics} == {Severity.WARNING}


def test_lights_may_be_relative_to_models(world):
    found = world(
        BOX.format("a", "<pose>1 0 0 0 0 0</pose>")
        + "<light name='s' type='point'><pose relative_to='a'>0 0 2 0 0 0</pose></light>"
    )
    assert found.lights[0].T_parent_light.position_m == (1, 0, 2)


def test_words_of_a_light(world):
    light = world(
        "<light name='s' type='spot'><cast_shadows>1</cast_shadows><intensity>2</intensity>"
        "<diffuse>.1 .2 .3 1</diffuse><specular>.4 .5 .6 1</specular><direction>1 0 0</direction>"
        "<attenuation><range>7</range><constant>.8</constant><linear>.9</linear><quadratic>.01"
        "</quadratic></attenuation><spot><inner_angle>.1</inner_angle><outer_angle>.2"
        "</outer_angle><falloff>3</falloff></spot></light>"
    ).lights[0]
    assert (light.cast_shadows, light.intensity, light.range_m) == (True, 2, 7)
    assert (light.diffuse, light.specular) == ((0.1, 0.2, 0.3, 1), (0.4, 0.5, 0.6, 1))
    assert (light.direction, light.attenuation_constant) == ((1, 0, 0), 0.8)
    assert (light.attenuation_linear, light.attenuation_quadratic) == (0.9, 0.01)
    assert (light.spot_inner_angle_rad, light.spot_outer_angle_rad, light.spot_falloff) == (
        0.1,
        0.2,
        3,
    )


def test_model_without_link_leaves_the_others_in_the_world(world, diagnostics):
    found = world("<model name='empty'/>" + BOX.format("a", ""))
    assert [item.name for item in found.models] == ["a"]
    (warning,) = diagnostics.by_code("sdf.model-without-link")
    assert warning.severity is Severity.WARNING


def test_actor_is_told_of(world, context, diagnostics):
    world("<actor name='walker'><skin/></actor>")
    read_sdf("<sdf version='1.6'><actor name='sitter'/></sdf>", context=context)
    messages = [item.message for item in diagnostics.by_code("sdf.actor")]
    assert messages == [
        f"actor '{name}' is an animation; it is left out" for name in ("walker", "sitter")
    ]


def test_world_without_name_is_called_default(context, diagnostics):
    found = read_sdf("<sdf version='1.6'><world/></sdf>", context=context).worlds[0]
    assert found.name == "default"
    assert "'default' is used" in diagnostics.errors[0].message


def test_windows_of_gazebo_are_told_of(world, diagnostics):
    world("<gui fullscreen='0'><plugin name='p' filename='GzScene3D'><any/></plugin></gui>")
    (found,) = diagnostics
    assert found.message == "<plugin> in <gui> is legal and not simulated"
