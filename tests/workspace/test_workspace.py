from __future__ import annotations

import os
from pathlib import Path

import pytest

from gazelle.errors import NotFoundError
from gazelle.workspace import Workspace


def own(workspace: Workspace) -> list[str]:
    return [name for name, package in workspace.packages.items() if not package.is_builtin]


def test_packages_of_the_current_folders_workspace_are_found(tmp_path, make_package, discover):
    make_package(tmp_path / "ws/src/alpha")
    make_package(tmp_path / "ws/src/group/beta")
    assert own(discover(tmp_path / "ws")) == ["alpha", "beta"]


def test_a_subfolder_of_a_package_sees_the_whole_workspace(tmp_path, make_package, discover):
    (make_package(tmp_path / "ws/src/alpha") / "launch").mkdir()
    make_package(tmp_path / "ws/src/beta")
    assert own(discover(tmp_path / "ws/src/alpha/launch")) == ["alpha", "beta"]


def test_a_lone_package_sees_its_neighbours(tmp_path, make_package, discover):
    make_package(tmp_path / "robots/arm_description")
    make_package(tmp_path / "robots/arm_gazebo")
    workspace = discover(tmp_path / "robots/arm_gazebo")
    assert own(workspace) == ["arm_description", "arm_gazebo"]


@pytest.mark.parametrize("marker", ["CATKIN_IGNORE", "COLCON_IGNORE", "AMENT_IGNORE"])
def test_ignored_folders_are_left_out(tmp_path, make_package, discover, marker):
    make_package(tmp_path / "src/kept")
    (make_package(tmp_path / "src/group/dropped").parent / marker).touch()
    assert own(discover(tmp_path)) == ["kept"]


def test_build_products_and_nested_packages_are_left_out(tmp_path, make_package, discover):
    make_package(tmp_path / "src/kept")
    for folder in ("build/copy", ".git/copy", "node_modules/copy", "kept/inner"):
        make_package(tmp_path / "src" / folder)
    assert own(discover(tmp_path)) == ["kept"]


def test_a_link_back_to_its_parent_does_not_loop(tmp_path, make_package, discover):
    make_package(tmp_path / "src/group/alpha")
    (tmp_path / "src/group/again").symlink_to(tmp_path / "src")
    workspace = discover(tmp_path)
    assert own(workspace) == ["alpha"]


def test_the_name_is_the_manifests_not_the_folders(tmp_path, make_package, discover):
    make_package(tmp_path / "src/my-robot-main", "my_robot")
    assert discover(tmp_path).package("my_robot").path == tmp_path / "src/my-robot-main"


def test_a_name_in_a_comment_does_not_count(tmp_path, discover):
    folder = tmp_path / "src/alpha"
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(
        "<package><!-- <name>old</name> --><name> new </name></package>"
    )
    assert own(discover(tmp_path)) == ["new"]


def test_ros_package_path_is_searched_in_order(tmp_path, make_package, discover):
    first = make_package(tmp_path / "one/alpha")
    make_package(tmp_path / "two/alpha")
    path = os.pathsep.join([str(tmp_path / "one"), str(tmp_path / "two")])
    workspace = discover(ROS_PACKAGE_PATH=path)
    assert workspace.package("alpha").path == first


def test_given_folders_come_before_the_environment(tmp_path, make_package, discover):
    make_package(tmp_path / "one/alpha")
    given = make_package(tmp_path / "two/alpha")
    workspace = discover(extra=(tmp_path / "two",), ROS_PACKAGE_PATH=str(tmp_path / "one"))
    assert workspace.package("alpha").path == given


@pytest.mark.parametrize("variable", ["AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH"])
def test_install_prefixes_are_searched(tmp_path, make_package, discover, variable):
    make_package(tmp_path / "install/share/alpha", tool="ament_cmake")
    package = discover(**{variable: str(tmp_path / "install")}).package("alpha")
    assert package.path == tmp_path / "install/share/alpha"
    assert package.prefix == tmp_path / "install"


def test_colcons_isolated_install_is_searched(tmp_path, make_package, discover):
    make_package(tmp_path / "install/alpha/share/alpha", tool="ament_python")
    package = discover(COLCON_PREFIX_PATH=str(tmp_path / "install")).package("alpha")
    assert package.prefix == tmp_path / "install/alpha"


def test_a_devel_space_leads_to_its_sources(tmp_path, make_package, discover):
    source = make_package(tmp_path / "ws/src/alpha")
    (tmp_path / "ws/devel").mkdir()
    (tmp_path / "ws/devel/.catkin").write_text(str(tmp_path / "ws/src"))
    workspace = discover(CMAKE_PREFIX_PATH=str(tmp_path / "ws/devel"))
    assert workspace.package("alpha").path == source


def test_a_users_package_hides_the_builtin_one(tmp_path, make_package, discover):
    mine = make_package(tmp_path / "src/gazebo_ros")
    package = discover(tmp_path).package("gazebo_ros")
    assert (package.path, package.is_builtin) == (mine, False)


def test_a_missing_package_names_the_nearest_and_the_places(tmp_path, make_package, discover):
    make_package(tmp_path / "src/slam_robot")
    with pytest.raises(NotFoundError) as caught:
        discover(tmp_path).package("slam_robt")
    text = str(caught.value)
    assert "package 'slam_robt' not found; did you mean 'slam_robot'" in text
    assert f"workspace: {tmp_path / 'src'}" in text
    assert "ROS_PACKAGE_PATH" in text
    assert caught.value.kind == "package"


def test_a_broken_manifest_is_reported_with_its_place(tmp_path, discover):
    folder = tmp_path / "src/alpha"
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text("<package>\n<name>alpha</name>\n<export>\n</package>")
    workspace = discover(tmp_path)
    assert workspace.package("alpha").exports == ()
    (found,) = workspace.diagnostics.by_code("workspace.bad-manifest")
    assert "mismatched tag: <export> has no end before </package> of line 4" in found.message
    assert (found.span.file, found.span.line) == (str(folder / "package.xml"), 3)


def test_a_manifest_without_a_name_is_reported(tmp_path, discover):
    folder = tmp_path / "src/alpha"
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text("<package><version>1</version></package>")
    workspace = discover(tmp_path)
    assert workspace.package("alpha").version == "1"
    (found,) = workspace.diagnostics.by_code("workspace.bad-manifest")
    assert "no <name>" in found.message


def test_two_packages_of_one_name_are_reported(tmp_path, make_package, discover):
    first = make_package(tmp_path / "src/a", "alpha")
    second = make_package(tmp_path / "src/b", "alpha")
    workspace = discover(tmp_path)
    assert workspace.package("alpha").path == first
    (found,) = workspace.diagnostics.by_code("workspace.duplicate-package")
    assert str(second) in found.message
    assert "CATKIN_IGNORE" in found.fix


def test_nothing_is_read_before_it_is_asked_for(tmp_path, make_package, discover):
    (tmp_path / "src").mkdir()
    workspace = discover(tmp_path)
    make_package(tmp_path / "src/late")
    assert own(workspace) == ["late"]


def test_models_come_from_environment_home_exports_and_builtins(tmp_path, make_package, discover):
    for folder in ("models/env_model", "home/.gazebo/models/home_model", "src/p/models/own_model"):
        (tmp_path / folder).mkdir(parents=True)
        (tmp_path / folder / "model.config").touch()
    export = '<gazebo_ros gazebo_model_path="${prefix}/models"/>'
    (tmp_path / "src/p/package.xml").write_text(
        f"<package><name>p</name><export>{export}</export></package>"
    )
    workspace = discover(tmp_path, GAZEBO_MODEL_PATH=str(tmp_path / "models"))
    assert {"env_model", "home_model", "own_model", "sun", "ground_plane"} <= set(workspace.models)
    assert workspace.model_dir("own_model") == tmp_path / "src/p/models/own_model"
    assert workspace.model_dir("no_such_model") is None


def test_a_users_model_hides_the_builtin_one(tmp_path, discover):
    (tmp_path / "models/sun").mkdir(parents=True)
    (tmp_path / "models/sun/model.sdf").touch()
    workspace = discover(GAZEBO_MODEL_PATH=str(tmp_path / "models"))
    assert workspace.model_dir("sun") == tmp_path / "models/sun"


def test_the_newest_fuel_version_counts(tmp_path, discover):
    cache = tmp_path / "home/.ignition/fuel/fuel.gazebosim.org/openrobotics/models/cart"
    for version in ("2", "10", "x"):
        (cache / version).mkdir(parents=True)
        (cache / version / "model.sdf").touch()
    assert discover().models["cart"] == cache / "10"


@pytest.mark.parametrize("name", ["empty", "empty.world", "worlds/empty.world"])
def test_worlds_are_found_by_name(discover, name):
    assert discover().world_file(name).path.name == "empty.world"


def test_worlds_are_found_on_the_resource_path(tmp_path, discover):
    (tmp_path / "media/worlds").mkdir(parents=True)
    world = tmp_path / "media/worlds/mine.sdf"
    world.touch()
    workspace = discover(GAZEBO_RESOURCE_PATH=str(tmp_path / "media"))
    assert workspace.world_file("worlds/mine.sdf").path == world
    assert workspace.world_file("mine").path == world
    assert workspace.world_file(str(world)).path == world
    missing = workspace.world_file("worlds/mnie.sdf")
    assert missing.path is None
    assert missing.nearest[0] == "mine.sdf"
    assert str(tmp_path / "media/worlds/mnie.sdf") in missing.tried


@pytest.mark.parametrize(
    ("folder", "names"),
    [
        ("arm_ws", ["heron_bringup", "heron_description", "heron_moveit_config"]),
        ("pr2_style_ws", ["tandem_controller"]),
    ],
)
def test_example_workspaces_are_found(examples_dir: Path, discover, folder, names):
    workspace = discover(examples_dir / folder)
    assert set(own(workspace)) == set(names)
    assert not len(workspace.diagnostics)


def test_a_package_of_a_demo_is_found_by_name_everywhere(tmp_path: Path, discover):
    workspace = discover(tmp_path)
    assert "heron_bringup" not in list(workspace.packages)
    assert workspace.user_package("heron_bringup") is None
    package = workspace.package("heron_bringup")
    assert not package.is_builtin
    # Those beside it belong to it; other demos stay unseen.
    assert set(own(workspace)) == {"heron_bringup", "heron_description", "heron_moveit_config"}
    assert workspace.resolve("package://heron_description/meshes/base.stl").path is not None


def test_a_package_of_a_demo_hides_none_of_the_user_s(tmp_path: Path, discover):
    folder = tmp_path / "src" / "heron_description"
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>heron_description</name></package>")
    workspace = discover(tmp_path)
    assert workspace.package("heron_bringup").path != folder.with_name("heron_bringup")
    assert workspace.package("heron_description").path == folder


def test_a_name_that_no_demo_has_is_not_found(tmp_path: Path, discover):
    workspace = discover(tmp_path)
    assert "heron_bringu" not in workspace.packages
    assert own(workspace) == []


def test_generations_of_the_example_packages_are_known(examples_dir: Path, discover):
    workspace = discover(extra=(examples_dir,))
    assert workspace.package("scout_robot").ros_version == 1
    assert workspace.package("heron_bringup").ros_version == 2
    assert workspace.package("heron_bringup").build_type == "ament_python"


def test_sample_workspaces_and_their_generations_are_known(workspaces_dir: Path, discover):
    for folder, names in (
        ("catkin_ws", ["slam_robot", "tutorial_controller", "urdf_exam", "urdf_tutorial"]),
        ("ros2_ws", ["luck_description", "luck_gazebo", "luck_robot"]),
    ):
        workspace = discover(workspaces_dir / folder)
        assert set(names) <= set(own(workspace))
        assert not len(workspace.diagnostics)
    workspace = discover(extra=(workspaces_dir,))
    assert workspace.package("slam_robot").ros_version == 1
    assert workspace.package("luck_gazebo").ros_version == 2
    assert workspace.package("luck_gazebo").build_type == "ament_python"
    assert workspace.package("turtlebot3_gazebo").version == "1.3.2"


def test_all_packages_that_sample_launch_files_find_are_there_or_explained(
    workspaces_dir: Path, discover
):
    import re

    workspace = discover(extra=(workspaces_dir,))
    wanted = set()
    for path in workspaces_dir.rglob("*"):
        if path.suffix in {".launch", ".xacro", ".xml", ".urdf"}:
            wanted |= set(re.findall(r"\$\(find (\w+)\)", path.read_text(errors="replace")))
    missing = {name for name in wanted if name not in workspace.packages}
    # Neither of these is part of the sample workspaces, and both are for hardware or a real arm.
    assert missing == {
        "realsense_camera",
        "turtlebot3_manipulation_description",
        "turtlebot3_manipulation_tools",
    }
    for name in missing:
        with pytest.raises(NotFoundError, match="not that of a package in this workspace"):
            workspace.package(name)
