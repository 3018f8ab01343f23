"""``colcon``: what it prints and leaves, on the documents' workspace and on made ones."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from gazelle.cli.colcon import main

_MANIFEST = """<package format="3"><name>{0}</name><version>0.1.0</version>
<description>x</description><maintainer email="a@example.org">a</maintainer><license>MIT</license>
{1}<export><build_type>ament_cmake</build_type></export></package>"""


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Packages ``arm`` and ``base``, which arm needs; the current folder is the workspace."""
    for name, needs in (("arm", "<depend>base</depend>"), ("base", "")):
        folder = tmp_path / "src" / name
        folder.mkdir(parents=True)
        (folder / "package.xml").write_text(_MANIFEST.format(name, needs))
        (folder / "CMakeLists.txt").write_text(f"project({name})\nament_package()\n")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_lines_are_those_of_colcon(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["build", "--symlink-install"]) == 0
    printed = re.sub(r"\[\d+\.\d\ds\]", "[T]", capsys.readouterr().out).splitlines()
    assert printed == [
        "Starting >>> base",
        "Finished <<< base [T]",
        "Starting >>> arm",
        "Finished <<< arm [T]",
        "",
        "Summary: 2 packages finished [T]",
    ]
    assert (workspace / "install/.colcon_install_layout").read_text() == "isolated\n"
    assert (workspace / "log/latest_build/arm/stdout.log").read_text().startswith("-- Installing")
    assert (workspace / "install/arm/share/colcon-core/packages/arm").read_text() == "base"


def test_a_failure_stops_what_needs_it(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lists = workspace / "src/base/CMakeLists.txt"
    lists.write_text("project(base)\ninstall(FILES no.txt DESTINATION share)\nament_package()\n")
    assert main(["build"]) == 2
    printed = capsys.readouterr()
    assert "--- stderr: base\n" in printed.err
    assert "[package.install-missing]" in printed.err
    assert re.search(r"^Failed   <<< base \[\d\.\d\ds, exited with code 2\]$", printed.err, re.M)
    assert "Starting >>> arm" not in printed.out
    end = printed.out.splitlines()[-4:]
    assert end[0].startswith("Summary: 0 packages finished [")
    assert end[1:] == [
        "  1 package failed: base",
        "  1 package had stderr output: base",
        "  1 package not processed",
    ]


def test_only_the_chosen_package_is_built(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["build", "--packages-select", "base", "aarm"]) == 0
    printed = capsys.readouterr()
    assert (
        "ignoring unknown package 'aarm' in --packages-select; did you mean 'arm'?" in printed.err
    )
    assert not (workspace / "install/arm").exists()
    assert main(["build", "--packages-up-to", "arm", "--cmake-args", "-DA=1", "-DB=2"]) == 0
    assert (workspace / "install/arm").exists()


def test_the_two_layouts_do_not_mix(workspace: Path) -> None:
    from gazelle.workspace.building.packages import BuildError

    assert main(["build", "--merge-install"]) == 0
    with pytest.raises(BuildError, match="created with the layout 'merged'") as caught:
        main(["build"])
    assert "add the '--merge-install' option" in str(caught.value)


def test_event_handlers_switch_what_is_printed(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["build", "--packages-select", "base", "--event-handlers"]
    main([*words, "console_direct+", "console_start_end-", "summary-", "console_drect+"])
    printed = capsys.readouterr()
    assert "-- Installing: " in printed.out
    assert "Starting" not in printed.out
    assert "Summary" not in printed.out
    assert "no event handler 'console_drect'; did you mean 'console_direct'" in printed.err


def test_options_for_compilers_are_said_to_do_nothing(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["--log-base", "/dev/null", "build", "--cmake-clean-first"]) == 0
    assert "--cmake-clean-first has no effect here" in capsys.readouterr().err
    assert not (workspace / "log").exists()


def test_list_info_and_graph(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["list"])
    main(["list", "-t", "-n"])
    main(["list", "-p"])
    main(["info", "arm"])
    main(["graph"])
    main(["graph", "--dot"])
    assert capsys.readouterr().out.splitlines() == [
        "arm\tsrc/arm\t(ros.ament_cmake)",
        "base\tsrc/base\t(ros.ament_cmake)",
        "base",
        "arm",
        "src/arm",
        "src/base",
        "path: src/arm",
        "  type: ros.ament_cmake",
        "  name: arm",
        "  dependencies:",
        "    build: base",
        "    run: base",
        "    test: ",
        "  metadata:",
        "    maintainers: ['a <a@example.org>']",
        "    version: 0.1.0",
        "base  +*",
        "arm    +",
        "digraph graphname {",
        '  "base";',
        '  "arm";',
        '  "arm" -> "base" [color="blue"];',
        '  "arm" -> "base" [color="red"];',
        "}",
    ]


def test_a_verb_that_does_not_exist_is_named(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["biuld"]) == 2
    assert "invalid choice: 'biuld' (did you mean 'build'?)" in capsys.readouterr().err


@pytest.mark.tutorial
def test_luck_is_built_sourced_and_found(workspaces_dir: Path, tmp_path: Path) -> None:
    source = tmp_path / "ws/src"
    shutil.copytree(workspaces_dir / "ros2_ws/src", source)
    script = """
set -e
{gazelle} colcon build --symlink-install
source install/setup.bash
cd /
for name in luck_description luck_gazebo luck_robot; do {gazelle} rospack find $name; done
"""
    text = script.format(gazelle=f"{sys.executable} -m gazelle.cli")
    names = ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH")
    environ = {key: value for key, value in os.environ.items() if key not in names}
    done = subprocess.run(
        ["bash", "-c", text], cwd=source.parent, env=environ, capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    assert "Summary: 3 packages finished [" in done.stdout
    install = source.parent / "install"
    found = [str(install / name / "share" / name) for name in
             ("luck_description", "luck_gazebo", "luck_robot")]  # fmt: skip
    assert done.stdout.splitlines()[-3:] == found
    for name, below in (
        ("luck_gazebo", "launch/gazebo_moveit.launch.py"),
        ("luck_gazebo", "config/controllers.yaml"),
        ("luck_robot", "config/luck_description.urdf.xacro"),
        ("luck_description", "urdf/luck_description.urdf"),
        ("luck_description", "meshes/visual/base_link.STL"),
    ):
        file = install / name / "share" / name / below
        assert file.resolve() == (source / name / below).resolve()


def test_a_folder_without_packages_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["build"]) == 0
    assert f"there is no package.xml below {tmp_path}" in capsys.readouterr().err
