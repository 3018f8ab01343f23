""""""

from __future__ import annotations

import pytest

from gazelle.description.model import Physics, Scene
from gazelle.description.sdf_reader import read_sdf
from gazelle.diagnostics import Severity


def test_gravity_inside_physics_as_sdf_1_4_writes_it(world):
    assert world(
        "<physics type='ode'><gravity>0 0 -3.7</gravity></physics>", "1.4"
    ).gravity_m_s2 == (0, 0, -3.7)


def test_gravity_of_the_world_goes_first(world):
    text = "<gravity>0 0 -1</gravity><physics type='ode'><gravity>0 0 -2</gravity></physics>"
    assert world(text).gravity_m_s2 == (0, 0, -1)


def test_silence_means_9_8_and_a_millisecond(world):
    found = world("")
    assert found.gravity_m_s2 == (0, 0, -9.8)
    assert found.physics == Physics()


def test_all_words_of_ode(world):
    found = world(
        "<physics name='p' type='ode'><max_step_size>0.002</max_step_size><real_time_factor>0.5"
        "</real_time_factor><real_time_update_rate>250</real_time_update_rate><max_contacts>7"
        "</max_contacts><ode><solver><type>world</type><iters>150</iters><precon_iters>3"
        "</precon_iters><sor>1.4</sor></solver><constraints><cfm>1e-5</cfm><erp>0.3</erp>"
        "<contact_max_correcting_vel>2000</contact_max_correcting_vel><contact_surface_layer>0.01"
        "</contact_surface_layer></constraints></ode></physics>"
    ).physics
    assert (found.name, found.engine, found.max_step_size_s) == ("p", "ode", 0.002)
    assert (found.real_time_factor, found.real_time_update_rate_hz, found.max_contacts) == (
        0.5,
        250,
        7,
    )
    assert (found.solver_type, found.solver_iters, found.solver_precon_iters) == ("world", 150, 3)
    assert (found.solver_sor, found.cfm, found.erp) == (1.4, 1e-5, 0.3)
    assert (found.contact_max_correcting_vel_m_s, found.contact_surface_layer_m) == (2000, 0.01)


def test_bullets_iterations_are_read_from_its_own_words(world):
    text = "<physics type='bullet'><bullet><solver><iters>9</iters></solver></bullet></physics>"
    assert (world(text).physics.engine, world(text).physics.solver_iters) == ("bullet", 9)


def test_profile_marked_as_default_counts(world):
    text = "<physics name='a' type='ode'/><physics name='b' default='true' type='dart'/>"
    assert (world(text).physics.name, world(text).physics.engine) == ("b", "dart")


def test_first_profile_counts_when_none_is_marked(world):
    assert world("<physics name='a' type='ode'/><physics name='b' type='ode'/>").physics.name == "a"


def test_unknown_engine_is_reported(world, diagnostics):
    assert world("<physics type='odee'/>").physics.engine == "ode"
    assert "'odee'" in diagnostics.by_code("sdf.bad-value")[0].message


def test_step_of_zero_is_reported(world, diagnostics):
    found = world("<physics type='ode'><max_step_size>0</max_step_size></physics>")
    assert found.physics.max_step_size_s == 0.001
    assert "must be positive" in diagnostics.by_code("sdf.bad-value")[0].message


def test_words_of_a_scene(world):
    found = world(
        "<scene><ambient>.1 .2 .3 1</ambient><background>.4 .5 .6 1</background><sky/>"
        "<shadows>0</shadows><grid>false</grid></scene>"
    ).scene
    assert (found.ambient, found.background) == ((0.1, 0.2, 0.3, 1), (0.4, 0.5, 0.6, 1))
    assert (found.sky, found.shadows, found.grid) == (True, False, False)


def test_silence_is_the_default_scene(world):
    assert world("").scene == Scene()


def test_fog_is_told_of(world, diagnostics):
    world("<scene><fog><type>linear</type></fog></scene>")
    assert diagnostics.by_code("sdf.not-simulated")[0].message.startswith("<fog> in <scene>")


def test_place_on_earth(world):
    found = world(
        "<spherical_coordinates><surface_model>EARTH_WGS84</surface_model>"
        "<world_frame_orientation>ENU</world_frame_orientation><latitude_deg>49.9</latitude_deg>"
        "<longitude_deg>8.9</longitude_deg><elevation>120</elevation><heading_deg>10</heading_deg>"
        "</spherical_coordinates>"
    ).spherical_coordinates
    assert (found.latitude_deg, found.longitude_deg) == (49.9, 8.9)
    assert (found.elevation_m, found.heading_deg) == (120, 10)


def test_other_axes_than_east_north_up_are_reported(world, diagnostics):
    world(
        "<spherical_coordinates><world_frame_orientation>NED</world_frame_orientation>"
        "</spherical_coordinates>"
    )
    assert "'NED' is not supported" in diagnostics.by_code("sdf.bad-value")[0].message


def test_no_place_on_earth_is_none(world):
    assert world("").spherical_coordinates is None


MODEL = "<model name='{}'><pose>0 0 1 0 0 0</pose><link name='l'/>{}</model>"


def test_saved_poses_of_models_and_lights_count(world):
    found = world(
        MODEL.format("a", "")
        + "<light name='s' type='point'/><state world_name='w'><model name='a'>"
        "<pose>5 6 7 0 0 0</pose><link name='l'><pose>5 6 7 0 0 0</pose></link></model>"
        "<light name='s'><pose>0 0 9 0 0 0</pose></light></state>"
    )
    assert found.model("a").T_world_model.position_m == (5, 6, 7)
    assert found.model("a").link("l").T_model_link.position_m == (0, 0, 0)
    assert found.lights[0].T_parent_light.position_m == (0, 0, 9)


def test_loose_link_moves_to_its_saved_place(world):
    found = world(
        MODEL.format("a", "<link name='k'/>")
        + "<state world_name='w'><model name='a'><pose>1 0 0 0 0 0</pose>"
        "<link name='k'><pose>1 0 3 0 0 0</pose></link></model></state>"
    )
    assert found.model("a").link("k").T_model_link.position_m == pytest.approx((0, 0, 3))


def test_links_held_by_joints_stay_and_that_is_told(world, diagnostics):
    joint = (
        "<link name='k'/><joint name='j' type='revolute'><parent>l</parent><child>k</child>"
        "<axis><xyz>0 0 1</xyz></axis></joint>"
    )
    found = world(
        MODEL.format("a", joint) + "<state world_name='w'><model name='a'><pose>1 0 0 0 0 0</pose>"
        "<link name='k'><pose>1 0 0 0 0 1</pose></link></model></state>"
    )
    assert found.model("a").link("k").T_model_link.position_m == (0, 0, 0)
    assert found.model("a").T_world_model.position_m == (1, 0, 0)
    assert "model 'a' moves links that joints hold" in diagnostics.by_code("sdf.state")[0].message


def test_deleted_models_are_gone(world):
    state = "<state world_name='w'><deletions><name>a</name></deletions></state>"
    assert [
        item.name for item in world(MODEL.format("a", "") + MODEL.format("b", "") + state).models
    ] == ["b"]


def test_inserted_models_are_there(world):
    state = f"<state world_name='w'><insertions>{MODEL.format('c', '')}</insertions></state>"
    assert [item.name for item in world(MODEL.format("a", "") + state).models] == ["a", "c"]


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
