"""Packages whose nodes, types or modules are built in can be looked up like any other."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import gazelle.interfaces
from gazelle.cli import rospack
from gazelle.compat.rospkg import RosPack
from gazelle.diagnostics import Diagnostics
from gazelle.launch.ros1.loader import load_launch_files
from gazelle.launch.ros2.launch_description_sources import (
    get_launch_description_from_any_launch_file,
)
from gazelle.node_specs.registry import builtin_packages
from gazelle.workspace import Workspace
from gazelle.workspace.ament_index import get_package_share_directory
from gazelle.workspace.environment_paths import BUILTIN

# Gazelle's own types, and a package that every beginner makes.
NOT_OF_ROS = {"gazelle_msgs", "beginner_tutorials"}
DEFINITIONS = Path(gazelle.interfaces.__file__).parent / "definitions"
NODES = set(builtin_packages())
TYPES = {path.stem for path in DEFINITIONS.rglob("*.txt")} - NOT_OF_ROS
FILES = (
    "amcl/examples/amcl_diff.launch",
    "amcl/examples/amcl_omni.launch",
    "cartographer_ros/configuration_files/backpack_2d.lua",
    "cartographer_ros/configuration_files/revo_lds.lua",
    "depthimage_to_laserscan/cfg/param.yaml",
    "explore_lite/config/params.yaml",
    "explore_lite/launch/explore_costmap.launch",
    "gmapping/launch/slam_gmapping_pr2.launch",
    "hector_mapping/launch/mapping_default.launch",
    "hector_slam_launch/launch/tutorial.launch",
    "ros_gz_sim/launch/ros_gz_sim.launch.py",
    "ros_gz_sim/launch/ros_gz_spawn_model.launch.py",
    "nav2_bringup/params/nav2_params.yaml",
    "nav2_bt_navigator/behavior_trees/navigate_to_pose_w_replanning_and_recovery.xml",
    "robot_localization/launch/ekf_template.launch",
    "robot_localization/params/ekf.yaml",
    "robot_pose_ekf/robot_pose_ekf.launch",
    "slam_karto/launch/karto_slam.launch",
    "slam_toolbox/config/mapper_params_online_async.yaml",
    "urdf_launch/config/urdf.rviz",
)


def _is_ros2(file: Path) -> bool:
    return "find-pkg-share" in file.read_text()


@pytest.fixture
def empty(tmp_path: Path) -> Workspace:
    return Workspace.discover(environ={"HOME": str(tmp_path)}, cwd=tmp_path)


@pytest.mark.parametrize("kind", [NODES, TYPES], ids=["nodes", "types"])
def test_every_package_that_is_stood_in_for_is_found(empty: Workspace, kind: set[str]) -> None:
    assert sorted(kind - set(empty.packages)) == []


def test_their_manifests_name_them_and_need_only_what_is_found(empty: Workspace) -> None:
    for name, package in empty.packages.items():
        assert (package.path.name, package.is_builtin) == (name, True)
        assert package.description and package.version and package.build_type, name
        needed = set(package.depends) - {"catkin", "ament_cmake"}
        assert sorted(needed - set(empty.packages)) == [], name
    assert not list(empty.diagnostics)


@pytest.mark.parametrize("uri", FILES)
def test_files_that_others_include_from_them_are_there(empty: Workspace, uri: str) -> None:
    assert empty.resolve(f"package://{uri}").path is not None


@pytest.mark.parametrize(
    "file",
    [file for file in sorted(BUILTIN.glob("packages/*/**/*.launch")) if not _is_ros2(file)],
    ids=lambda file: file.stem,
)
def test_their_launch_files_of_ros_1_load(empty: Workspace, file: Path) -> None:
    diagnostics = Diagnostics()
    config = load_launch_files([file], {}, workspace=empty, diagnostics=diagnostics)
    assert config.nodes and not diagnostics.errors


@pytest.mark.parametrize(
    "file",
    sorted(BUILTIN.glob("packages/*/launch/*launch.py")),
    ids=lambda file: f"{file.parts[-3]}-{file.stem}",
)
def test_their_launch_files_of_ros_2_describe_their_arguments(file: Path) -> None:
    description = get_launch_description_from_any_launch_file(str(file))
    assert all(one.description for one in description.get_launch_arguments())


@pytest.mark.parametrize(
    "file",
    [file for file in sorted(BUILTIN.glob("packages/*/**/*.launch")) if _is_ros2(file)],
    ids=lambda file: file.stem,
)
def test_xml_files_of_ros_2_give_the_files_they_include_what_those_take(file: Path) -> None:
    description = get_launch_description_from_any_launch_file(str(file))
    own = {one.name for one in description.get_launch_arguments()}
    includes = re.findall(
        r'<include file="\$\(find-pkg-share (\w+)\)/([^"]+)">(.*?)</include>',
        file.read_text(),
        re.S,
    )
    assert includes
    for package, name, arguments in includes:
        inner = get_launch_description_from_any_launch_file(
            str(BUILTIN / "packages" / package / name)
        )
        taken = {one.name for one in inner.get_launch_arguments()} | {*"xyzRPY"}
        given = re.findall(r'<arg name="(\w+)" value="\$\(var (\w+)\)"/>', arguments)
        assert given and {key for key, _ in given} <= taken
        assert {key for _, key in given} <= own


def test_ros_1_and_ros_2_look_them_up(capsys: pytest.CaptureFixture[str]) -> None:
    expected = str(BUILTIN / "packages" / "amcl")
    assert RosPack().get_path("amcl") == expected
    assert rospack.main(["rospack", "find", "amcl"]) == 0
    assert capsys.readouterr().out.strip() == expected
    assert rospack.main(["rospack", "depends1", "amcl"]) == 0
    assert {"map_server", "nav_msgs", "tf2_ros"} <= set(capsys.readouterr().out.split())
    share = Path(get_package_share_directory("nav2_map_server"))
    assert share == BUILTIN / "packages" / "nav2_map_server"


def test_ros2_pkg_knows_their_executables(gazelle) -> None:
    run = gazelle("ros2", "pkg", "executables", "nav2_amcl")
    assert run.wait() == 0
    assert run.text.strip() == "nav2_amcl amcl"
