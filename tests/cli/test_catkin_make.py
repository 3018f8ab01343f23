"""``catkin_make``: its lines, and the documents' workspace."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from gazelle.cli.catkin_make import main
from gazelle.workspace.building.packages import BuildError

Captured = pytest.CaptureFixture[str]
_MANIFEST = """<package format="2"><name>{0}</name><version>0.1.0</version>
<description>x</description><maintainer email="a@example.org">a</maintainer><license>MIT</license>
<buildtool_depend>{1}</buildtool_depend>{2}</package>"""


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Packages ``arm`` and ``base``, which arm needs; the current folder is the workspace."""
    for name, needs in (("arm", "<depend>base</depend>"), ("base", "")):
        folder = tmp_path / "src" / name
        folder.mkdir(parents=True)
        (folder / "package.xml").write_text(_MANIFEST.format(name, "catkin", needs))
        (folder / "CMakeLists.txt").write_text(f"project({name})\ncatkin_package()\n")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_lines_are_familiar(workspace: Path, capsys: Captured) -> None:
    assert main([]) == 0
    rule = "-- " + "~" * 49
    assert capsys.readouterr().out.splitlines() == [
        f"Base path: {workspace}",
        *(f"{n.title()} space: {workspace / p}" for n, p in
          (("source", "src"), ("build", "build"), ("devel", "devel"), ("install", "install"))),
        rule,
        "-- ~~  traversing 2 packages in topological order:",
        "-- ~~  - base",
        "-- ~~  - arm",
        rule,
        "-- +++ processing catkin package: 'base'",
        "-- ==> add_subdirectory(base)",
        "-- +++ processing catkin package: 'arm'",
        "-- ==> add_subdirectory(arm)",
        "-- Configuring done",
        "-- Generating done",
        f"-- Build files are in: {workspace / 'build'}",
    ]  # fmt: skip
    assert (workspace / ".catkin_workspace").exists()


def test_a_failure_ends_with_one(workspace: Path, capsys: Captured) -> None:
    (workspace / "src/base/CMakeLists.txt").write_text("project(base\n")
    assert main([]) == 1
    printed = capsys.readouterr()
    assert printed.out.endswith("-- Configuring incomplete, errors occurred!\n")
    assert "[package.cmake-syntax]" in printed.err
    assert 'Invoking "cmake" failed' in printed.err


def test_packages_are_chosen(workspace: Path, capsys: Captured) -> None:
    main(["--pkg", "arm"])
    main(["--only-pkg-with-deps", "arm"])
    main(["-DCATKIN_BLACKLIST_PACKAGES=base"])
    lines = [line for line in capsys.readouterr().out.splitlines() if "traversing" in line]
    assert [line.split()[3] for line in lines] == ["1", "2", "1"]
    with pytest.raises(BuildError, match=r"Packages bsae not found .* did you mean 'base'"):
        main(["--pkg", "bsae"])


def test_install_goes_where_it_is_told(workspace: Path, capsys: Captured) -> None:
    assert main(["install", "-DCMAKE_INSTALL_PREFIX=there", "-j4"]) == 0
    assert (workspace / "there/share/arm/package.xml").is_file()
    printed = capsys.readouterr()
    assert "Install the project...\n" in printed.out
    assert "no effect" not in printed.err


@pytest.mark.parametrize(
    ("words", "said"),
    [(["-C", "src/arm"], "contains a package"), (["-C", "build"], "does not exist")],
)
def test_a_place_that_is_no_workspace_is_refused(
    workspace: Path, words: list[str], said: str
) -> None:
    with pytest.raises(BuildError, match=said):
        main(words)


def test_packages_of_ros2_are_named(workspace: Path) -> None:
    file = workspace / "src/arm/package.xml"
    file.write_text(_MANIFEST.format("arm", "ament_cmake", ""))
    with pytest.raises(BuildError, match=r"non-catkin packages in it.*: arm; 'colcon build'"):
        main([])


def test_an_unknown_target_is_named(workspace: Path, capsys: Captured) -> None:
    with pytest.raises(SystemExit):
        main(["instal"])
    assert "No rule to make target 'instal'; did you mean 'install'?" in capsys.readouterr().err


@pytest.mark.tutorial
def test_the_documents_workspace_is_built_sourced_and_found(
    workspaces_dir: Path, tmp_path: Path
) -> None:
    source = tmp_path / "ws/src"
    shutil.copytree(workspaces_dir / "catkin_ws/src", source)
    gazelle = f"{sys.executable} -m gazelle.cli"
    script = f"set -e\n{gazelle} catkin_make\nsource devel/setup.bash\ncd /\n"
    script += f"for name in slam_robot urdf_exam; do {gazelle} rospack find $name; done\n"
    names = ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH")
    environ = {key: value for key, value in os.environ.items() if key not in names}
    done = subprocess.run(
        ["bash", "-c", script], cwd=source.parent, env=environ, capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    found = [str(source / name) for name in ("slam_robot", "urdf_exam")]
    assert done.stdout.splitlines()[-2:] == found
