"""What both Gazebos ship by name is here, or is refused with what to do."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.simulator.description_sources import world_from
from gazelle.workspace.environment_paths import BUILTIN
from gazelle.workspace.gazebo_models import original_models, original_worlds, originals_markdown

ROOT = Path(__file__).parents[2]
HERE = sorted(row.name for row in original_worlds().values() if row.is_here)


def test_the_list_and_the_folders_agree() -> None:
    assert sorted(path.name for path in (BUILTIN / "worlds").iterdir()) == HERE
    models = {row.name for row in original_models().values() if row.is_here}
    assert models == {path.name for path in (BUILTIN / "models").iterdir()}


def test_the_page_is_generated_from_the_list() -> None:
    page = (ROOT / "docs" / "worlds.md").read_text(encoding="utf-8")
    assert page == originals_markdown(), "run: python -m gazelle.workspace.gazebo_models"


@pytest.mark.parametrize("name", HERE)
def test_each_world_loads_by_its_name_without_an_error(name: str, discover, tmp_path) -> None:
    diagnostics = Diagnostics()
    world = world_from(name, discover(tmp_path), diagnostics)
    assert not diagnostics.errors
    assert bool(world.models) == (name != "blank.world")


@pytest.mark.parametrize(
    ("file", "name"),
    [("empty.sdf", "empty"), ("default.sdf", "default"), ("sensors_demo.sdf", "lidar_sensor"),
     ("visualize_lidar.sdf", "visualize_lidar_world"), ("shapes.sdf", "shapes"),
     ("diff_drive.sdf", "diff_drive"), ("empty.world", "default")],
)  # fmt: skip
def test_worlds_have_the_names_that_topics_and_services_are_called_by(
    file: str, name: str, discover, tmp_path
) -> None:
    assert world_from(file, discover(tmp_path), Diagnostics()).name == name


def test_a_world_that_is_not_here_is_refused_with_where_it_is(discover, tmp_path) -> None:
    found = discover(tmp_path).world_file("actor.sdf")
    assert found.path is None
    assert found.note == (
        "'actor.sdf' ships with gz-sim (actors that walk by skin and animation); Gazelle has none "
        "of its own: take the file from https://github.com/gazebosim/gz-sim, examples/worlds, and "
        "give its path"
    )
    assert not found.nearest
    note = discover(tmp_path).world_file("worlds/pr2.world").note
    assert note.startswith("'pr2.world' ships with Gazebo Classic (the PR2 and its meshes)")


def test_a_model_that_is_not_here_is_refused_with_where_it_is(discover, tmp_path) -> None:
    note = discover(tmp_path).resolve("model://reactor").note
    assert note == (
        "'reactor' is a model of Gazebo's model database; Gazelle has none of its own and "
        "downloads nothing: git clone https://github.com/osrf/gazebo_models and name that folder "
        "in GAZEBO_MODEL_PATH"
    )


@pytest.mark.parametrize(
    "address",
    [
        "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Ground Plane",
        "https://fuel.ignitionrobotics.org/1.0/openrobotics/models/Ground%20Plane/2",
        "https://fuel.gazebosim.org/1.0/someone/models/ground-plane/tip",
        "https://api.example.org/models/ground_plane",
    ],
)
def test_ground_and_sun_of_any_server_are_those_that_are_here(
    address: str, discover, tmp_path
) -> None:
    found = discover(tmp_path).resolve(address)
    assert found.path == BUILTIN / "models/ground_plane"
    assert not found.note


def test_shapes_stand_in_only_where_the_user_has_no_such_model(discover, tmp_path) -> None:
    found = discover(tmp_path).resolve("model://cafe_table")
    assert found.path == BUILTIN / "models/cafe_table"
    assert found.is_stand_in
    assert found.note == "plain shapes of Gazelle's own stand in for Gazebo's model 'cafe_table'"
    own = tmp_path / "robot/models/cafe_table"
    own.mkdir(parents=True)
    (own / "model.sdf").touch()
    found = discover(tmp_path).resolve("model://cafe_table", base_dir=tmp_path / "robot/worlds")
    assert found.path == own
    assert found.is_off_path
    fuel = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Construction Cone"
    found = discover(tmp_path).resolve(fuel)
    assert found.path == BUILTIN / "models/construction_cone"
    assert found.is_stand_in


def test_what_no_server_is_asked_for_says_where_to_put_it(discover, tmp_path) -> None:
    fuel = "https://fuel.gazebosim.org/1.0/OpenRobotics"
    assert discover(tmp_path).resolve(f"{fuel}/models/Rescue Randy").note == (
        "model 'Rescue Randy' of OpenRobotics is in no local cache and nothing is downloaded: put "
        "it into a folder 'rescue_randy' of GAZEBO_MODEL_PATH or GZ_SIM_RESOURCE_PATH"
    )
    assert discover(tmp_path).resolve(f"{fuel}/worlds/Fortress").note == (
        "world 'Fortress' of OpenRobotics lies on a server and nothing is downloaded: give the "
        "path of a local file"
    )
