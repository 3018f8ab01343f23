from __future__ import annotations

import pytest

from gazelle.description.sdf_reader import read_sdf
from gazelle.diagnostics import Severity

BOX = "<model name='box'><link name='l'><pose>0 0 0.5 0 0 0</pose></link></model>"


@pytest.fixture
def world(here):
    def read(body, version="1.9"):
        text = f"<sdf version='{version}'><world name='w'>{body}</world></sdf>"
        return read_sdf(text, context=here).worlds[0]

    return read


def test_include_with_its_own_words(world, models_folder):
    models_folder("box", BOX)
    found = world(
        "<include><uri>model://box</uri><name>b1</name><pose>1 2 3 0 0 0</pose><static>1</static>"
        "<plugin name='p' filename='libp.so'/></include>"
    ).model("b1")
    assert found.T_world_model.position_m == (1, 2, 3)
    assert found.static
    assert found.plugins[0].filename == "libp.so"
    assert found.file.name == "model.sdf"


def test_without_pose_the_models_own_stays(world, models_folder):
    models_folder("box", BOX.replace("<link", "<pose>0 0 9 0 0 0</pose><link", 1))
    assert world("<include><uri>model://box</uri></include>").models[
        0
    ].T_world_model.position_m == (0, 0, 9)


def test_same_model_twice_gets_two_names(world, models_folder, diagnostics):
    models_folder("box", BOX)
    found = world("<include><uri>model://box</uri></include>" * 2)
    assert [item.name for item in found.models] == ["box", "box_0"]
    (warning,) = diagnostics.by_code("sdf.duplicate-name")
    assert warning.severity is Severity.WARNING


def test_missing_model_leaves_the_rest_and_says_where_it_looked(
    world, models_folder, diagnostics, tmp_path
):
    models_folder("box", BOX)
    found = world(
        "<include><uri>model://bx</uri></include><include><uri>model://box</uri></include>"
    )
    assert [item.name for item in found.models] == ["box"]
    (warning,) = diagnostics.by_code("sdf.missing-model")
    assert warning.severity is Severity.WARNING
    assert str(tmp_path / "models") in warning.message
    assert "box" in warning.message
    assert "the world goes on without it" in warning.message
    assert "GAZEBO_MODEL_PATH" in warning.fix
    assert "Unable to find uri[model://" in warning.phrase
    assert "~/.ignition/fuel/config.yaml" in warning.phrase
    assert warning.span.line == 1


def test_missing_model_inside_a_single_model_is_an_error(here, diagnostics):
    text = "<sdf version='1.9'><model name='m'><link name='a'/><include><uri>model://no</uri></include></model></sdf>"
    read_sdf(text, context=here)
    assert diagnostics.errors[0].code == "sdf.missing-model"


def test_address_of_a_model_server_is_looked_up_by_name(world, models_folder, diagnostics):
    models_folder("coffee_box", BOX)
    address = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Coffee Box/2"
    found = world(f"<include><uri>{address}</uri></include>")
    assert [item.name for item in found.models] == ["box"]
    assert not diagnostics.by_code("sdf.missing-model")
    (notice,) = diagnostics.by_code("load.stand-in")
    assert notice.severity is Severity.INFO
    assert "stands in for Fuel's model 'Coffee Box'" in notice.message


def test_ground_and_sun_of_fuel_are_no_news(world, diagnostics):
    address = "https://fuel.gazebosim.org/1.0/OpenRobotics/models"
    uris = (f"<include><uri>{address}/{name}</uri></include>" for name in ("Ground Plane", "Sun"))
    found = world("".join(uris))
    assert [item.name for item in found.models] == ["ground_plane"]
    assert not list(diagnostics)


def test_spelling_of_fuel_behind_model_is_told_with_the_name_that_exists(world, diagnostics):
    found = world("<include><uri>model://Ground Plane</uri></include>")
    assert [item.name for item in found.models] == ["ground_plane"]
    (warning,) = diagnostics.by_code("sdf.bad-value")
    assert "the spelling differs: the model is 'ground_plane'" in warning.message
    assert warning.fix == "write model://ground_plane"


def test_include_without_address_is_reported(world, diagnostics):
    world("<include><name>x</name></include>")
    assert "<include> has no <uri>" in diagnostics.by_code("xml.missing-tag")[0].message


def test_folder_without_model_is_reported(world, tmp_path, diagnostics):
    (tmp_path / "empty").mkdir()
    world("<include><uri>empty</uri></include>")
    assert (
        "neither model.config nor model.sdf" in diagnostics.by_code("sdf.missing-model")[0].message
    )


def test_circle_of_includes_is_reported_with_its_chain(world, models_folder, diagnostics):
    models_folder(
        "a", "<model name='a'><link name='l'/><include><uri>model://b</uri></include></model>"
    )
    models_folder(
        "b", "<model name='b'><link name='l'/><include><uri>model://a</uri></include></model>"
    )
    found = world("<include><uri>model://a</uri></include>")
    assert [link.name for link in found.models[0].links] == ["l", "b::l"]
    (circle,) = diagnostics.by_code("sdf.include-cycle")
    assert "a/model.sdf → b/model.sdf → a/model.sdf" in circle.message
    assert [place.file for place in circle.span.via][-1] == "test.world"


def test_findings_inside_an_include_name_the_way_there(world, models_folder, diagnostics):
    models_folder("a", "<model name='a'><link name='l'/><link name='l'/></model>")
    world("<include><uri>model://a</uri></include>")
    (found,) = diagnostics.by_code("sdf.duplicate-name")
    assert found.span.file.endswith("a/model.sdf")
    assert found.span.via[0].file == "test.world"
    assert found.severity is Severity.WARNING


def test_hundred_includes_report_a_problem_once(world, models_folder, diagnostics):
    models_folder("a", "<model name='a'><lnk/><link name='l'/></model>")
    includes = "".join(
        f"<include><uri>model://a</uri><name>a{n}</name></include>" for n in range(100)
    )
    assert len(world(includes).models) == 100
    assert len(diagnostics.by_code("xml.unknown-tag")) == 1


def test_included_light_becomes_the_worlds(world, models_folder):
    models_folder("lamp", "<light name='lamp' type='directional'><pose>0 0 9 0 0 0</pose></light>")
    found = world("<include><uri>model://lamp</uri><name>sun2</name></include>")
    assert [(item.name, item.T_parent_light.position_m) for item in found.lights] == [
        ("sun2", (0, 0, 9))
    ]
    assert found.models == ()


def test_built_in_sun_and_ground_are_there(world, diagnostics):
    found = world(
        "<include><uri>model://sun</uri></include><include><uri>model://ground_plane</uri></include>"
    )
    assert [item.name for item in found.lights] == ["sun"]
    assert [item.name for item in found.models] == ["ground_plane"]
    assert not diagnostics.errors


def test_placement_frame_of_an_include(world, models_folder):
    models_folder(
        "box", BOX.replace("</model>", "<frame name='f'><pose>0 0 2 0 0 0</pose></frame></model>")
    )
    found = world(
        "<include><uri>model://box</uri><pose>0 0 5 0 0 0</pose>"
        "<placement_frame>f</placement_frame></include>"
    )
    assert found.models[0].T_world_model.position_m == pytest.approx((0, 0, 3))


def test_unknown_placement_frame_is_reported(world, models_folder, diagnostics):
    models_folder("box", BOX)
    world("<include><uri>model://box</uri><placement_frame>top</placement_frame></include>")
    assert "placement_frame 'top'" in diagnostics.by_code("sdf.unknown-frame")[0].message


def test_merged_include_brings_its_links_as_own(here, models_folder):
    models_folder("box", BOX)
    text = (
        "<sdf version='1.9'><model name='m'><link name='base'/><include merge='true'>"
        "<uri>model://box</uri><pose>1 0 0 0 0 0</pose></include>"
        "<joint name='j' type='fixed'><parent>base</parent><child>l</child></joint></model></sdf>"
    )
    found = read_sdf(text, context=here).models[0]
    assert [link.name for link in found.links] == ["base", "l"]
    assert found.link("l").T_model_link.position_m == (1, 0, 0.5)
    assert found.joint("j").child == "l"


def test_merging_a_name_that_is_taken_is_reported(here, models_folder, diagnostics):
    models_folder("box", BOX)
    text = (
        "<sdf version='1.9'><model name='m'><link name='l'/><include merge='1'>"
        "<uri>model://box</uri></include></model></sdf>"
    )
    assert len(read_sdf(text, context=here).models[0].links) == 1
    assert "twice by merging" in diagnostics.by_code("sdf.duplicate-name")[0].message


def test_nested_names_plugins_and_static_links(here, models_folder):
    models_folder(
        "arm",
        "<model name='arm'><static>1</static><link name='a'/><link name='b'/>"
        "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz>"
        "<mimic joint='k'/></axis></joint><plugin name='p' filename='f'/></model>",
    )
    text = "<sdf version='1.9'><model name='m'><link name='l'/><include><uri>model://arm</uri><name>left</name></include></model></sdf>"
    found = read_sdf(text, context=here).models[0]
    joint = found.joint("left::j")
    assert (joint.parent, joint.child, joint.mimic.joint) == ("left::a", "left::b", "left::k")
    assert found.plugins[0].reference == "left"
    assert found.joint("left::a::__static__").parent == "world"


def test_urdf_robot_can_be_included(world, tmp_path, diagnostics):
    (tmp_path / "r.urdf").write_text(
        "<robot name='r'><link name='base'/></robot>", encoding="utf-8"
    )
    found = world("<include><uri>r.urdf</uri><pose>1 0 0 0 0 0</pose></include>")
    assert [(item.name, item.T_world_model.position_m) for item in found.models] == [
        ("r", (1, 0, 0))
    ]


def test_merging_into_a_world_is_plain_including(world, models_folder):
    models_folder("box", BOX)
    found = world("<include merge='1'><uri>model://box</uri><pose>1 0 0 0 0 0</pose></include>")
    assert found.model("box").T_world_model.position_m == (1, 0, 0)


def test_model_off_every_path_is_found_and_said_once_per_folder(here, diagnostics):
    for name in ("lamp", "shelf"):
        folder = here.base_dir / name
        folder.mkdir(parents=True)
        (folder / "model.sdf").write_text(
            f"<sdf version='1.6'><model name='{name}'><link name='l'/></model></sdf>"
        )
    body = "<include><uri>model://lamp</uri></include><include><uri>model://shelf</uri></include>"
    text = f"<sdf version='1.9'><world name='w'>{body}</world></sdf>"
    assert [model.name for model in read_sdf(text, context=here).worlds[0].models] == [
        "lamp",
        "shelf",
    ]
    (finding,) = diagnostics
    assert (finding.code, finding.severity) == ("load.off-path", Severity.INFO)
    assert "'model://lamp' was found in" in finding.message


def test_bare_name_of_a_model_is_looked_up_like_an_address(world, models_folder, diagnostics):
    models_folder("box", BOX)
    assert world("<include><uri>box</uri></include>").models[0].name == "box"
    assert not diagnostics.errors
