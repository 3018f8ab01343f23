"""The share folder of a package that was never built, its files where installing puts them."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.diagnostics.share_links import as_written, written_file
from gazelle.launch.node_commands import find_executable
from gazelle.workspace import Workspace, ament_index

LISTS = """project(heron)
find_package(ament_cmake REQUIRED)
install(DIRECTORY description/urdf bringup/launch DESTINATION share/${PROJECT_NAME})
install(DIRECTORY worlds/ DESTINATION share/${PROJECT_NAME}/yard FILES_MATCHING PATTERN "*.sdf")
install(FILES notes.txt DESTINATION share/${PROJECT_NAME}/doc RENAME README)
install(PROGRAMS tools/drive_all.py DESTINATION lib/${PROJECT_NAME} RENAME drive)
ament_package()
"""
SETUP = """from glob import glob
from setuptools import setup
name = "egret"
setup(name=name, version="1.0.0", packages=[], data_files=[
    ("share/ament_index/resource_index/packages", ["resource/egret"]),
    ("share/" + name, ["package.xml"]),
    ("share/" + name, glob("launch/*.launch.py")),
    ("share/" + name + "/maps", glob("data/maps/*")),
])
"""
FILES = (
    "description/urdf/heron.urdf",
    "description/urdf/arms/left.urdf",
    "bringup/launch/heron.launch.py",
    "worlds/pond.sdf",
    "worlds/pond.txt",
    "notes.txt",
    "extra/kept.yaml",
)
LAUNCH = """import os
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch.substitutions import PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare
from ament_index_python.packages import get_package_share_directory
beside = os.path.join(os.path.dirname(__file__), "..", "urdf", "heron.urdf")
assert os.path.isfile(beside), beside
assert os.path.isfile(get_package_share_directory("heron") + "/doc/README")
joined = PathJoinSubstitution([FindPackageShare("heron"), "urdf", "heron.urdf"])
def generate_launch_description():
    return LaunchDescription([ExecuteProcess(cmd=["cat", joined], output="screen")])
"""


def write(folder: Path, *names: str, text: str = "x: 2\n") -> None:
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)


@pytest.fixture
def heron(make_package, tmp_path: Path) -> Path:
    folder: Path = make_package(tmp_path / "ws" / "src" / "heron", "heron", tool="ament_cmake")
    write(folder, "CMakeLists.txt", text=LISTS)
    write(folder, *FILES)
    write(folder, "bringup/launch/heron.launch.py", text=LAUNCH)
    write(folder, "tools/drive_all.py", text="#!/usr/bin/env python3\nprint('driven')\n")
    return folder


@pytest.fixture
def workspace(heron: Path, discover) -> Workspace:
    found: Workspace = discover(extra=(heron.parent,))
    return found


@pytest.mark.parametrize(
    ("place", "source"),
    [
        ("urdf/heron.urdf", "description/urdf/heron.urdf"),
        ("urdf/arms/left.urdf", "description/urdf/arms/left.urdf"),
        ("urdf/arms/../heron.urdf", "description/urdf/heron.urdf"),
        ("yard/pond.sdf", "worlds/pond.sdf"),
        ("doc/README", "notes.txt"),
        ("extra/kept.yaml", "extra/kept.yaml"),
        ("package.xml", "package.xml"),
    ],
)
def test_any_joined_path_leads_to_the_users_file(
    workspace: Workspace, heron: Path, place: str, source: str
) -> None:
    joined = os.path.join(workspace.package("heron").share, place)  # noqa: PTH118
    assert os.path.samefile(joined, heron / source)  # noqa: PTH121


def test_files_are_only_where_ament_installs_them(workspace: Workspace) -> None:
    share = workspace.package("heron").share
    assert not (share / "yard/pond.txt").exists()
    assert not (share / "bringup/launch").exists()
    assert [path.name for path in share.rglob("*.launch.py")] == ["heron.launch.py"]


def test_catkins_share_folder_has_the_places_of_the_source_too(
    make_package, tmp_path: Path, discover
) -> None:
    folder = make_package(tmp_path / "src" / "stork", "stork")
    write(folder, "robots/a.urdf", "launch/a.launch", "config/c.yaml")
    lists = "project(stork)\ninstall(DIRECTORY robots/ DESTINATION "
    lists += "${CATKIN_PACKAGE_SHARE_DESTINATION}/urdf)\n"
    write(folder, "CMakeLists.txt", text=lists)
    share = discover(extra=(folder.parent,)).package("stork").share
    assert (share / "urdf/a.urdf").samefile(folder / "robots/a.urdf")
    assert (share / "robots/a.urdf").samefile(folder / "robots/a.urdf")
    assert (share / "launch/a.launch").is_file()


def test_data_files_of_setup_py_are_found_where_they_are_installed(
    make_package, tmp_path: Path, discover
) -> None:
    folder = make_package(tmp_path / "src" / "egret", "egret", tool="ament_python")
    write(folder, "resource/egret", "launch/a.launch.py", "data/maps/pond.yaml")
    write(folder, "setup.py", text=SETUP)
    share = discover(extra=(folder.parent,)).package("egret").share
    assert (share / "a.launch.py").samefile(folder / "launch/a.launch.py")
    assert (share / "maps/pond.yaml").samefile(folder / "data/maps/pond.yaml")


@pytest.mark.parametrize(
    ("build_type", "places"),
    [
        ("ament_cmake", {"bringup/a.launch.py"}),
        ("cmake", {"bringup/a.launch.py"}),
        ("ament_python", {"a.launch.py"}),
    ],
)
def test_build_type_alone_says_which_build_file_installs(
    make_package, tmp_path: Path, discover, build_type: str, places: set[str]
) -> None:
    export = f"<build_type>{build_type}</build_type>"
    tool = "ament_cmake" if build_type == "cmake" else build_type
    folder = make_package(tmp_path / "src" / "egret", "egret", tool=tool, export=export)
    write(folder, "resource/egret", "launch/a.launch.py", "data/maps/pond.yaml")
    write(folder, "setup.py", text=SETUP)
    lists = "project(egret)\ninstall(DIRECTORY launch/ DESTINATION share/egret/bringup)\n"
    write(folder, "CMakeLists.txt", text=lists)
    share = discover(extra=(folder.parent,)).package("egret").share
    found = {path.relative_to(share).as_posix() for path in share.rglob("*.launch.py")}
    assert found == places


def test_both_build_files_count_where_the_build_type_is_conditional(
    make_package, tmp_path: Path, discover
) -> None:
    export = """<build_type condition="$ROS_VERSION == 1">catkin</build_type>
        <build_type condition="$ROS_VERSION == 2">ament_python</build_type>"""
    folder = make_package(tmp_path / "src" / "egret", "egret", export=export)
    write(folder, "resource/egret", "launch/a.launch.py", "data/maps/pond.yaml")
    write(folder, "setup.py", text=SETUP)
    lists = "project(egret)\ninstall(DIRECTORY launch/ DESTINATION share/egret/bringup)\n"
    write(folder, "CMakeLists.txt", text=lists)
    share = discover(extra=(folder.parent,)).package("egret").share
    assert (share / "bringup/a.launch.py").is_file()
    assert (share / "a.launch.py").is_file()


def test_package_whose_rules_move_nothing_is_its_own_share_folder(
    make_package, tmp_path: Path, discover
) -> None:
    folder = make_package(tmp_path / "src" / "crane", "crane", tool="ament_cmake")
    write(folder, "launch/a.launch.py")
    lists = "project(crane)\ninstall(DIRECTORY launch DESTINATION share/${PROJECT_NAME})\n"
    write(folder, "CMakeLists.txt", text=lists)
    assert discover(extra=(folder.parent,)).package("crane").share == folder


def test_new_file_is_there_for_the_next_process(heron: Path) -> None:
    script = "import sys; from gazelle.workspace import Workspace; "
    script += "print(Workspace.discover(extra=[sys.argv[1]]).package('heron').share)"

    def share() -> Path:
        command = [sys.executable, "-c", script, str(heron.parent)]
        out = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        return Path(out.strip())

    before = share()
    assert share() == before
    write(heron, "description/urdf/new.urdf")
    after = share()
    assert (after / "urdf/new.urdf").is_file()
    assert not (before / "urdf/new.urdf").exists()


def test_trees_of_packages_that_are_gone_are_removed(heron: Path, workspace: Workspace) -> None:
    share = workspace.package("heron").share
    other = heron.parent / "ibis"
    shutil.copytree(heron, other)
    for name in ("package.xml", "CMakeLists.txt"):
        text = (other / name).read_text().replace("heron", "ibis")
        (other / name).write_text(text.replace("urdf/ibis", "urdf/heron"))
    shutil.rmtree(heron)
    assert Workspace.discover(extra=[other.parent]).package("ibis").share.is_dir()
    assert not share.exists()


def test_texts_name_the_users_file_and_not_the_link(workspace: Workspace, heron: Path) -> None:
    share = workspace.package("heron").share
    file, source = f"{share}/urdf/heron.urdf", f"{heron}/description/urdf/heron.urdf"
    assert as_written(f"'{file}:3': bad") == f"'{source}:3': bad"
    assert as_written(f"no {share}/urdf/none.urdf") == f"no {heron}/description/urdf/none.urdf"
    assert as_written(f"in {share}, {share}/extra") == f"in {heron}, {heron}/extra"
    assert written_file(file) == Path(source)
    assert written_file(source) == Path(source)
    diagnostics = Diagnostics()
    span = SourceSpan(file, 3, via=(SourceSpan(f"{share}/doc/README", 1),))
    diagnostics.report("launch.substitution", f"see '{file}'", span, fix=f"mend {file}")
    (found,) = diagnostics
    assert found.span == SourceSpan(source, 3, via=(SourceSpan(f"{heron}/notes.txt", 1),))
    assert (found.message, found.fix) == (f"see '{source}'", f"mend {source}")


def test_model_path_that_is_exported_follows_the_rules(
    make_package, tmp_path: Path, discover
) -> None:
    export = '<gazebo_ros gazebo_model_path="${prefix}/models"/>'
    folder = make_package(tmp_path / "src" / "rail", "rail", tool="ament_cmake", export=export)
    write(folder, "sim/models/gate/model.config", "sim/models/gate/model.sdf", text="<sdf/>")
    lists = "project(rail)\ninstall(DIRECTORY sim/models DESTINATION share/${PROJECT_NAME})\n"
    write(folder, "CMakeLists.txt", text=lists)
    found = discover(extra=(folder.parent,)).model_dir("gate")
    assert found is not None and written_file(found) == folder / "sim/models/gate"


def test_executable_is_found_under_the_name_it_is_installed_with(
    workspace: Workspace, heron: Path
) -> None:
    diagnostics = Diagnostics()
    found = find_executable("heron", "drive", workspace=workspace, diagnostics=diagnostics)
    assert found is not None and found.command[-1] == str(heron / "tools/drive_all.py")
    assert "drive" in workspace.package("heron").executable_names


def test_package_index_answers_with_that_folder(
    workspace: Workspace, heron: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ament_index, "known_workspace", lambda: workspace)
    share = Path(ament_index.get_package_share_directory("heron"))
    assert (share / "urdf/heron.urdf").samefile(heron / "description/urdf/heron.urdf")


def test_launch_file_of_a_package_that_was_never_built_runs(heron: Path, gazelle) -> None:
    run = gazelle("ros2", "launch", "heron", "heron.launch.py", ROS_PACKAGE_PATH=str(heron.parent))
    run.wait_for_line("x: 2")


def test_mistake_in_such_a_launch_file_is_told_at_the_users_line(heron: Path, gazelle) -> None:
    file = heron / "bringup/launch/heron.launch.py"
    file.write_text("import os\nraise RuntimeError('no ' + __file__)\n")
    run = gazelle("ros2", "launch", "heron", "heron.launch.py", ROS_PACKAGE_PATH=str(heron.parent))
    assert run.wait() == 1
    assert f"{file}:2: error: RuntimeError: no {file}" in run.text
    assert "gazelle/installed" not in run.text
