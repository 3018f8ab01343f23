from __future__ import annotations

import pytest

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
