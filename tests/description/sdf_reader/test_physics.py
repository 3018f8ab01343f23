from __future__ import annotations

from gazelle.description.model import Physics


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
