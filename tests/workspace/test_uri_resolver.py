from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.workspace.file_lookup import nearest_packages


@pytest.fixture
def robot(tmp_path, make_package) -> Path:
    folder = make_package(tmp_path / "src/robot")
    (folder / "meshes").mkdir()
    (folder / "meshes/Base.STL").touch()
    return folder


@pytest.fixture
def workspace(tmp_path, robot, discover):
    model = tmp_path / "models/Chair"
    (model / "meshes").mkdir(parents=True)
    (model / "model.config").touch()
    (model / "meshes/chair.dae").touch()
    return discover(tmp_path, GAZEBO_MODEL_PATH=str(tmp_path / "models"))


@pytest.mark.parametrize(
    "uri",
    [
        "package://robot/meshes/Base.STL",
        " package://robot/meshes/Base.STL ",
        "$(find robot)/meshes/Base.STL",
        "$(find-pkg-share robot)/meshes/Base.STL",
        "model://robot/meshes/Base.STL",
        "package://robot/meshes/B%61se.STL",
    ],
)
def test_every_spelling_leads_to_the_file(workspace, robot, uri):
    found = workspace.resolve(uri)
    assert (found.path, found.note) == (robot / "meshes/Base.STL", "")


@pytest.mark.parametrize("prefix", ["file://", "file:", "file://localhost", ""])
def test_absolute_files_are_found(workspace, robot, prefix):
    assert workspace.resolve(f"{prefix}{robot / 'package.xml'}").path == robot / "package.xml"


def test_the_package_itself_can_be_named(workspace, robot):
    assert workspace.resolve("package://robot").path == robot
    assert workspace.resolve("$(find robot)").path == robot


def test_relative_paths_start_at_the_files_folder(workspace, robot):
    assert workspace.resolve("meshes/Base.STL", base_dir=robot).path == robot / "meshes/Base.STL"
    found = workspace.resolve("../meshes/Base.STL", base_dir=robot / "meshes")
    assert found.path is not None
    assert found.path.samefile(robot / "meshes/Base.STL")
    assert workspace.resolve("file://meshes/Base.STL", base_dir=robot).path is not None


def test_a_difference_in_case_is_forgiven_and_told(workspace, robot):
    found = workspace.resolve("package://robot/Meshes/base.stl")
    assert found.path == robot / "meshes/Base.STL"
    assert "upper and lower case differ: the file is 'meshes/Base.STL'" in found.note


def test_an_ambiguous_case_is_not_guessed(workspace, robot):
    (robot / "meshes/BASE.stl").touch()
    if len(list((robot / "meshes").iterdir())) == 1:
        pytest.skip("this file system does not tell upper from lower case")
    assert workspace.resolve("package://robot/meshes/base.stl").path is None


def test_backslashes_are_forgiven_and_told(workspace, robot):
    found = workspace.resolve("package://robot\\meshes\\Base.STL")
    assert found.path == robot / "meshes/Base.STL"
    assert "'\\' was read as '/'" in found.note


def test_a_missing_file_names_its_neighbours(workspace, robot):
    found = workspace.resolve("package://robot/meshes/Bse.STL")
    assert found.path is None
    assert found.nearest == ("package://robot/meshes/Base.STL",)
    assert found.tried == (str(robot / "meshes/Bse.STL"),)
    assert found.note == "package 'robot' has no 'meshes/Bse.STL'"
    assert "did you mean 'package://robot/meshes/Base.STL'?" in found.explain("package://…")


def test_a_file_that_only_the_original_of_a_stand_in_has_says_where_to_put_it(workspace):
    found = workspace.resolve("package://turtlebot3_teleop/launch/turtlebot3_teleop_key.launch")
    assert found.path is None
    assert found.note == (
        "package 'turtlebot3_teleop' has no 'launch/turtlebot3_teleop_key.launch'; this "
        "'turtlebot3_teleop' is Gazelle's and stands in for the original; put the original's "
        "folder into your workspace's src for its other files"
    )


def test_a_missing_package_names_the_places(workspace, tmp_path):
    found = workspace.resolve("package://robto/meshes/Base.STL")
    assert found.path is None
    assert found.note == "there is no package 'robto'"
    assert found.nearest[0] == "robot"
    assert f"workspace: {tmp_path / 'src'}" in found.tried


def test_models_and_files_in_them_are_found(workspace, tmp_path):
    assert workspace.resolve("model://Chair").path == tmp_path / "models/Chair"
    inside = workspace.resolve("model:///Chair/meshes/chair.dae")
    assert inside.path == tmp_path / "models/Chair/meshes/chair.dae"


def test_a_model_whose_name_differs_in_case_is_found(workspace, tmp_path):
    found = workspace.resolve("model://chair/meshes/chair.dae")
    assert found.path is not None
    assert found.path.samefile(tmp_path / "models/Chair/meshes/chair.dae")
    if found.note:
        assert "the model is 'Chair'" in found.note


def test_a_missing_model_lists_every_folder_and_the_caches(workspace, tmp_path):
    found = workspace.resolve("model://Chiar")
    assert found.path is None
    assert found.nearest == ("model://Chair",)
    text = found.explain("model://Chiar")
    assert str(tmp_path / "models/Chiar") in text
    assert str(tmp_path / "home/.gazebo/models/Chiar") in text
    assert "(Fuel cache)" in text
    assert "GAZEBO_MODEL_PATH (nothing is downloaded)" in text


def test_a_missing_file_of_a_model_says_so(workspace):
    found = workspace.resolve("model://Chair/meshes/chiar.dae")
    assert found.path is None
    assert found.note == "model 'Chair' has no 'meshes/chiar.dae'"
    assert found.nearest == ("model://Chair/meshes/chair.dae",)


def test_fuel_addresses_are_looked_up_in_the_cache_only(workspace, tmp_path):
    address = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Cart"
    missing = workspace.resolve(address)
    assert missing.path is None
    assert "in no local cache and nothing is downloaded" in missing.note
    cached = tmp_path / "home/.gz/fuel/fuel.gazebosim.org/openrobotics/models/cart/3"
    cached.mkdir(parents=True)
    (cached / "model.sdf").touch()
    assert workspace.resolve(address).path == cached
    assert workspace.resolve(f"{address}/tip/files/model.sdf").path == cached / "model.sdf"


def test_a_local_model_stands_in_for_a_fuel_one(workspace, tmp_path):
    found = workspace.resolve("https://fuel.gazebosim.org/1.0/someone/models/Chair")
    assert found.path == tmp_path / "models/Chair"
    assert "stands in" in found.note


def test_an_unknown_scheme_says_which_are_known(workspace):
    found = workspace.resolve("robot://base")
    assert found.path is None
    assert "'robot://' is not known; known are package://, model://, file://" in found.note


@pytest.mark.parametrize("place", ["examples_dir", "workspaces_dir"])
def test_the_sample_robots_meshes_are_all_found(
    request: pytest.FixtureRequest, place: str, discover
):
    import re

    folder: Path = request.getfixturevalue(place)
    workspace = discover(extra=(folder,))
    files = [path for kind in ("*.urdf", "*.xacro") for path in folder.rglob(kind)]
    uris = {uri for path in files for uri in re.findall(r"package://[^\"'<> ]+", path.read_text())}
    # A name with a property of xacro is no name yet.
    uris = {uri for uri in uris if "$" not in uri}
    assert len(uris) >= 4
    for uri in uris:
        assert workspace.resolve(uri).path is not None, uri


def test_the_slambot_worlds_models_are_found(workspaces_dir: Path, discover):
    models = workspaces_dir / "gazebo_models"
    workspace = discover(GAZEBO_MODEL_PATH=str(models))
    for name in ("ISCAS_groundplane", "ISCAS_Museum", "sun"):
        assert workspace.resolve(f"model://{name}").path is not None
    missing = discover(workspaces_dir / "catkin_ws").resolve("model://ISCAS_Museum")
    assert missing.path is None
    assert "GAZEBO_MODEL_PATH" in missing.note


def _model(folder: Path) -> Path:
    folder.mkdir(parents=True)
    (folder / "model.sdf").touch()
    return folder


@pytest.mark.parametrize("place", ["src/robot/models", "src/robot/worlds", "src/other/models"])
def test_model_near_its_user_is_found_without_a_path(
    workspace, tmp_path, robot, make_package, place
):
    make_package(tmp_path / "src/other")
    lamp = _model(tmp_path / place / "lamp")
    found = workspace.resolve("model://lamp", base_dir=robot / "worlds")
    assert (found.path, found.is_off_path) == (lamp, True)
    assert found.note == f"found in '{lamp.parent}', which no GAZEBO_MODEL_PATH names"


def test_model_path_comes_before_the_neighbourhood(workspace, robot, tmp_path):
    _model(robot / "models/Chair")
    found = workspace.resolve("model://Chair", base_dir=robot / "worlds")
    assert (found.path, found.is_off_path) == (tmp_path / "models/Chair", False)


def test_missing_file_of_a_neighbour_names_the_model(workspace, robot):
    lamp = _model(robot / "models/lamp")
    (lamp / "shade.dae").touch()
    found = workspace.resolve("model://lamp/shades.dae", base_dir=robot / "worlds")
    assert found.path is None
    assert found.note == "model 'lamp' has no 'shades.dae'"
    assert found.nearest == ("model://lamp/shade.dae",)


@pytest.mark.parametrize(
    ("written", "nearest"),
    [
        ("hector_sensors_description", ()),
        ("husky_descripton", ("husky_description",)),
        ("huskey_description", ("husky_description",)),
        ("husky_gazebo", ("husky_description",)),
    ],
)
def test_common_ending_alone_makes_no_package_near(written, nearest):
    assert nearest_packages(written, ["champ_description", "husky_description"])[:1] == nearest
