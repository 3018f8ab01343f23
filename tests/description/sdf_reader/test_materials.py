from __future__ import annotations

import pytest

from gazelle.description.sdf_reader.materials import read_material


@pytest.fixture
def look(tag, context):
    return lambda text: read_material(tag(f"<material>{text}</material>"), context)


def test_nothing_written_leaves_the_meshs_own_look(look, context):
    assert read_material(None, context) is None
    assert look("") is None


def test_script_by_name(look):
    found = look("<script><name>Gazebo/Red</name></script>")
    assert (found.name, found.diffuse) == ("Gazebo/Red", (1, 0, 0, 1))


def test_colours_beside_a_script_replace_it(look):
    text = "<script><name>Gazebo/Red</name></script><diffuse>0 1 0 0.5</diffuse>"
    found = look(text)
    assert (found.ambient, found.diffuse) == ((1, 0, 0, 1), (0, 1, 0, 0.5))


def test_white_beside_a_picture_keeps_the_pictures_look(look):
    plain = look("<script><name>Gazebo/Bricks</name></script>")
    found = look("<script><name>Gazebo/Bricks</name></script><diffuse>1 1 1 1</diffuse>")
    assert found.diffuse == plain.diffuse
    assert found.diffuse != (1, 1, 1, 1)


def test_colours_alone(look):
    found = look(
        "<ambient>.1 .2 .3 1</ambient><diffuse>.4 .5 .6</diffuse><specular>.7 .8 .9 1</specular>"
        "<emissive>.1 .1 .1 1</emissive><lighting>0</lighting><shininess>20</shininess>"
    )
    assert (found.ambient, found.diffuse) == ((0.1, 0.2, 0.3, 1), (0.4, 0.5, 0.6, 1))
    assert (found.specular, found.emissive) == ((0.7, 0.8, 0.9, 1), (0.1, 0.1, 0.1, 1))
    assert (found.lighting, found.shininess) == (False, 20)


def test_one_of_ambient_and_diffuse_stands_for_the_other(look):
    assert look("<ambient>1 0 0 1</ambient>").diffuse == (1, 0, 0, 1)
    assert look("<diffuse>0 1 0 1</diffuse>").ambient == (0, 1, 0, 1)


def test_base_colour_picture(look, tmp_path):
    (tmp_path / "a.png").write_bytes(b"")
    found = look("<pbr><metal><albedo_map>a.png</albedo_map></metal></pbr>")
    assert found.texture == tmp_path / "a.png"
    assert found.diffuse == (1, 1, 1, 1)


def test_missing_base_colour_picture_is_reported(look, diagnostics):
    look("<pbr><specular><albedo_map>no.png</albedo_map></specular></pbr>")
    assert "no.png" in diagnostics.by_code("material.texture-missing")[0].message


def test_default_script_is_no_script(look, diagnostics):
    assert look("<script><name>__default__</name><uri>__default__</uri></script>") is None
    assert not len(diagnostics)


def test_bad_colour_is_reported(look, diagnostics):
    look("<diffuse>red</diffuse>")
    assert "<diffuse>: 'red' is not a finite number" in diagnostics.errors[0].message
