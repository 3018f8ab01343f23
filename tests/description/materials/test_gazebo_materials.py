from __future__ import annotations

import pytest

from gazelle.description.materials import GAZEBO_MATERIAL_NAMES, gazebo_material, picture_colour


@pytest.mark.parametrize(
    ("name", "ambient", "diffuse"),
    [
        ("Gazebo/Red", (1, 0, 0, 1), (1, 0, 0, 1)),
        ("Gazebo/Grey", (0.3, 0.3, 0.3, 1), (0.7, 0.7, 0.7, 1)),
        ("Gazebo/DarkGrey", (0.175, 0.175, 0.175, 1), (0.175, 0.175, 0.175, 1)),
        ("Gazebo/FlatBlack", (0.1, 0.1, 0.1, 1), (0.1, 0.1, 0.1, 1)),
        ("Gazebo/SkyBlue", (0.13, 0.44, 0.7, 1), (0, 0, 1, 1)),
        ("Gazebo/Orange", (1, 0.5088, 0.0468, 1), (1, 0.5088, 0.0468, 1)),
        ("Gazebo/ZincYellow", (0.9725, 0.9529, 0.2078, 1), (0.9725, 0.9529, 0.2078, 1)),
        ("Gazebo/GreyTransparent", (0.5, 0.5, 0.5, 0.5), (0.5, 0.5, 0.5, 0.5)),
    ],
)
def test_colours_are_those_of_gazebos_script(name, ambient, diffuse):
    found = gazebo_material(name)
    assert (found.name, found.ambient, found.diffuse) == (name, ambient, diffuse)


def test_glowing_materials_shine_in_their_own_colour():
    assert gazebo_material("Gazebo/GreenGlow").emissive == (0, 1, 0, 1)
    assert gazebo_material("Gazebo/Green").emissive == (0, 0, 0, 1)


def test_overlays_are_unlit():
    assert not gazebo_material("Gazebo/RedTransparent").lighting
    assert gazebo_material("Gazebo/GreenTransparent").lighting


@pytest.mark.parametrize("name", ["Gazebo/Nothing", "Red", "", "gazebo/red", "Gazebo/Gazebo/Red"])
def test_other_names_are_none(name):
    assert gazebo_material(name) is None


@pytest.mark.parametrize("name", GAZEBO_MATERIAL_NAMES)
def test_every_material_has_legal_colours(name):
    found = gazebo_material(name)
    for colour in (found.ambient, found.diffuse, found.specular, found.emissive):
        assert len(colour) == 4
        assert all(0 <= value <= 1 for value in colour)
    assert found.shininess >= 0


@pytest.mark.parametrize("name", ["Wood", "Bricks", "Road", "Grass", "WoodFloor", "PaintedWall"])
def test_pictures_have_a_mean_colour(name):
    mean = picture_colour(f"Gazebo/{name}")
    assert gazebo_material(f"Gazebo/{name}").diffuse[0] <= mean[0]
    assert len(set(mean)) > 1


def test_plain_materials_have_no_picture():
    assert picture_colour("Gazebo/Red") is None
