from __future__ import annotations

import pytest

from gazelle.description.model import Box, LightType


def test_everything_a_link_carries(model):
    link = model(
        "<link name='base'><gravity>0</gravity><self_collide>1</self_collide>"
        "<kinematic>1</kinematic>"
        "<velocity_decay><linear>0.1</linear><angular>0.2</angular></velocity_decay>"
        "<collision name='c'><pose>0 0 1 0 0 0</pose><max_contacts>4</max_contacts>"
        "<laser_retro>2</laser_retro><geometry><box><size>1 2 3</size></box></geometry></collision>"
        "<visual name='v'><transparency>0.25</transparency><cast_shadows>0</cast_shadows>"
        "<visibility_flags>0x0f</visibility_flags><geometry><box/></geometry></visual>"
        "<sensor name='s' type='imu'><pose>0 0 2 0 0 0</pose></sensor>"
        "<light name='l' type='spot'><pose>0 0 3 0 0 0</pose></light></link>"
    ).link("base")
    assert (link.gravity, link.self_collide, link.kinematic) == (False, True, True)
    assert (link.linear_damping, link.angular_damping) == (0.1, 0.2)
    collision, visual = link.collisions[0], link.visuals[0]
    assert collision.shape == Box((1, 2, 3))
    assert collision.T_link_collision.position_m == (0, 0, 1)
    assert (collision.surface.max_contacts, collision.laser_retro) == (4, 2)
    assert (visual.transparency, visual.cast_shadows, visual.visibility_flags) == (0.25, False, 15)
    assert link.sensors[0].T_link_sensor.position_m == (0, 0, 2)
    assert link.lights[0].type is LightType.SPOT
    assert link.lights[0].T_parent_light.position_m == (0, 0, 3)


def test_self_collide_is_none_when_the_file_is_silent(model):
    assert model("<link name='base'/>").link("base").self_collide is None


def test_second_collision_of_a_name_gets_another_name(model, diagnostics):
    shape = "<geometry><box/></geometry>"
    body = f"<link name='l'><collision name='c'>{shape}</collision>"
    body += f"<collision name='c'>{shape}</collision></link>"
    assert [item.name for item in model(body).link("l").collisions] == ["c", "c_1"]
    (found,) = diagnostics.by_code("sdf.duplicate-shape")
    assert "collision with name 'c' stands twice in link 'l'" in found.message
    assert found.message.endswith("the second one becomes 'c_1'")
    assert found.phrase == "Non-unique name detected"


def test_nameless_link_is_reported(model, diagnostics):
    assert len(model("<link name='a'/><link/>").links) == 1
    assert diagnostics.by_code("xml.missing-attribute")[0].message == (
        "<link> has no name; the element is left out"
    )


def test_unknown_light_type_shines_as_a_point(model, diagnostics):
    link = model("<link name='a'><light name='l' type='spott'/></link>").link("a")
    assert link.lights[0].type is LightType.POINT
    assert diagnostics.by_code("sdf.unknown-light-type")[0].fix == "did you mean 'spot' or 'point'?"


def test_model_without_link_is_an_error_with_gazebos_words(context, diagnostics):
    from gazelle.description.sdf_reader import read_sdf

    text = "<sdf version='1.6'><model name='m'><static>1</static></model></sdf>"
    assert read_sdf(text, context=context).models == ()
    (found,) = diagnostics.errors
    assert found.phrase == "A model must have at least one link."
    assert found.span.line == 1


def test_canonical_link_is_the_first_one_or_the_one_named(model):
    body = "<link name='a'/><link name='b'/>"
    assert model(body).canonical_link == "a"
    assert model(body, attributes="canonical_link='b'").canonical_link == "b"


def test_unknown_canonical_link_is_reported(model, diagnostics):
    assert model("<link name='a'/>", attributes="canonical_link='x'").canonical_link == "a"
    assert "canonical_link 'x'" in diagnostics.by_code("sdf.unknown-frame")[0].message


def test_flags_of_a_model(model):
    found = model(
        "<static>1</static><self_collide>true</self_collide>"
        "<allow_auto_disable>0</allow_auto_disable><link name='a'/>"
    )
    assert (found.static, found.self_collide, found.allow_auto_disable) == (True, True, False)


@pytest.mark.parametrize("word", ["maybe", "2"])
def test_bad_truth_value_is_reported(model, diagnostics, word):
    assert not model(f"<static>{word}</static><link name='a'/>").static
    assert f"'{word}' is neither true nor false" in diagnostics.errors[0].message
