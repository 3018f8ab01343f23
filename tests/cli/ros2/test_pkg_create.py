"""``ros2 pkg create``: files and lines of the original, and packages that build and run."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from gazelle.cli.ros2.pkg_create import main
from gazelle.diagnostics import Diagnostics
from gazelle.doctor.packages import check_package
from gazelle.workspace import Workspace
from gazelle.workspace.building.build import BuildOptions, build_package
from gazelle.workspace.building.packages import find_packages
from gazelle.workspace.building.plan import site_packages
from gazelle.workspace.package_xml import read_manifest

Captured = pytest.CaptureFixture[str]
_WHO = ["--maintainer-name", "ann", "--maintainer-email", "ann@example.org"]


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_the_lines_of_a_python_package(tmp_path: Path, capsys: Captured) -> None:
    words = ["bot", "--build-type", "ament_python", "--dependencies", "rclpy", "std_msgs"]
    assert main([*words, "--node-name", "walk", "--license", "MIT", *_WHO]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "going to create a new package",
        "package name: bot",
        f"destination directory: {tmp_path}",
        "package format: 3",
        "version: 0.0.0",
        "description: TODO: Package description",
        "maintainer: ['ann <ann@example.org>']",
        "licenses: ['MIT']",
        "build type: ament_python",
        "dependencies: ['rclpy', 'std_msgs']",
        "node_name: walk",
        "creating folder ./bot",
        "creating ./bot/package.xml",
        "creating source folder",
        "creating folder ./bot/bot",
        "creating ./bot/setup.py",
        "creating ./bot/setup.cfg",
        "creating folder ./bot/resource",
        "creating ./bot/resource/bot",
        "creating ./bot/bot/__init__.py",
        "creating folder ./bot/test",
        "creating ./bot/test/test_copyright.py",
        "creating ./bot/test/test_flake8.py",
        "creating ./bot/test/test_pep257.py",
        "creating ./bot/bot/walk.py",
    ]
    assert (tmp_path / "bot/LICENSE").read_text().startswith("SPDX-License-Identifier: MIT\n")


def test_a_new_python_package_builds_runs_and_has_nothing_to_complain_about(
    tmp_path: Path,
) -> None:
    words = ["bot", "--build-type", "ament_python", "--node-name", "walk", *_WHO]
    main([*words, "--description", 'it\'s "quoted" & <odd>', "--license", "MIT"])
    diagnostics = Diagnostics()
    (package,) = find_packages([tmp_path], diagnostics)
    assert package.manifest.description == 'it\'s "quoted" & <odd>'
    outcome = build_package(package, BuildOptions(tmp_path / "build", tmp_path / "install"))
    assert (outcome.code, outcome.errors) == (0, ())
    prefix = tmp_path / "install/bot"
    done = subprocess.run(
        [prefix / "lib/bot/walk"], capture_output=True, text=True, check=True,
        env={**os.environ, "PYTHONPATH": str(prefix / site_packages())},
    )  # fmt: skip
    assert done.stdout == "Hi from bot.\n"
    workspace = Workspace.discover(environ={"HOME": str(tmp_path)}, cwd=tmp_path, extra=[tmp_path])
    check_package(workspace.package("bot"), workspace=workspace, diagnostics=diagnostics)
    assert not list(diagnostics)


def test_its_tests_are_skipped_without_the_linters(tmp_path: Path) -> None:
    main(["bot", "--build-type", "ament_python", *_WHO])
    words = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "bot/test"]
    environ = {**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}
    done = subprocess.run(
        words, cwd=tmp_path, env=environ, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout
    assert "3 skipped" in done.stdout


@pytest.mark.parametrize("build_type", ["ament_cmake", "cmake"])
def test_a_cmake_package_has_cpp_that_is_named_where_nothing_compiles_it(
    build_type: str, tmp_path: Path, capsys: Captured
) -> None:
    words = ["bot", "--build-type", build_type, "--node-name", "core", "--library-name", "core"]
    assert main([*words, "--dependencies", "rclcpp", *_WHO]) == 0
    printed = capsys.readouterr()
    assert "[WARNING] renaming node to core_node" in printed.err
    assert "[WARNING]: Unknown license 'TODO: License declaration'." in printed.out
    for name in ("src/core_node.cpp", "src/core.cpp", "include/bot/core.hpp",
                 "include/bot/visibility_control.h", "CMakeLists.txt"):  # fmt: skip
        assert f"creating ./bot/{name}\n" in printed.out
        assert (tmp_path / "bot" / name).is_file()
    (package,) = find_packages([tmp_path], Diagnostics())
    options = BuildOptions(tmp_path / "build", tmp_path / "install")
    outcome = build_package(package, options)
    assert outcome.code == 0
    found = [line for line in "\n".join(outcome.errors).splitlines() if "is not built" in line]
    assert len(found) == 2
    assert "library 'core' (src/core.cpp)" in found[0]
    assert "executable 'core_node' (src/core_node.cpp)" in found[1]


def test_fields_of_an_ament_cmake_manifest(tmp_path: Path) -> None:
    words = ["bot", "--library-name", "core", "--package-format", "2", "--dependencies", "rclcpp"]
    main([*words, *_WHO])
    manifest = read_manifest(tmp_path / "bot/package.xml")
    assert (manifest.format, manifest.build_type) == (2, "ament_cmake")
    assert [tuple(item) for item in manifest.dependencies] == [
        ("buildtool_depend", "ament_cmake_ros"),
        ("depend", "rclcpp"),
        ("test_depend", "ament_lint_auto"),
        ("test_depend", "ament_lint_common"),
    ]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["test", "--build-type", "ament_python"], "packages can't be named 'test'"),
        (["my-bot", "--build-type", "ament_python"], "'my_bot' would do"),
        (["../bot"], "is no name for a package"),
        (["bot", "--node-name", "a/b"], "'a/b' is no name for a source file"),
    ],
)
def test_what_cannot_be_is_refused(
    words: list[str], said: str, tmp_path: Path, capsys: Captured
) -> None:
    assert main(words) == 1
    assert said in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_an_existing_folder_is_left_alone(tmp_path: Path, capsys: Captured) -> None:
    (tmp_path / "there/bot").mkdir(parents=True)
    assert main(["bot", "--destination-directory", "there"]) == 1
    assert "Aborted!\nThe directory already exists: there/bot\n" in capsys.readouterr().err


def test_licenses_can_be_listed(capsys: Captured) -> None:
    assert main(["bot", "--license", "?"]) == 0
    assert "Supported licenses:\nApache-2.0\n" in capsys.readouterr().out
