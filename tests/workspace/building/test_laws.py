"""Laws of building: what a rule names is found through the installed share folder."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.doctor.packages.source import SourcePackage
from gazelle.workspace import Workspace
from gazelle.workspace.building.build import BuildOptions, build_package
from gazelle.workspace.building.packages import find_packages
from gazelle.workspace.scaffold import KINDS, create_package


def _build(top: Path, *, symlinks: bool) -> None:
    options = BuildOptions(top / "build", top / "install", symlinks=symlinks)
    packages = find_packages([top / "src"], Diagnostics())
    for package in packages:
        outcome = build_package(package, options)
        assert (outcome.code, outcome.errors) == (0, ()), outcome.errors


def _check_law(top: Path, least: int) -> None:
    """Everything that the doctor says is installed is there, and found by its package URI."""
    sources = Workspace.discover(environ={"HOME": str(top)}, cwd=top, extra=[top / "src"])
    prefixes = ":".join(str(path) for path in sorted((top / "install").iterdir()) if path.is_dir())
    environ = {"HOME": str(top), "AMENT_PREFIX_PATH": prefixes, "CMAKE_PREFIX_PATH": prefixes}
    installed = Workspace.discover(environ=environ, cwd=top / "install")
    count = 0
    for package in sources.packages.values():
        if package.is_builtin:
            continue
        source = SourcePackage(package)
        assert source.rules is not None
        for relative in source.files:
            for target in source.rules.targets(relative):
                count += 1
                place = top / "install" / package.name / target
                assert place.read_bytes() == (package.path / relative).read_bytes()
                share = f"share/{package.name}/"
                if target.startswith(share):
                    uri = f"package://{package.name}/{target.removeprefix(share)}"
                    assert installed.resolve(uri).path == place
    assert count >= least


@pytest.mark.parametrize("symlinks", [False, True])
def test_new_packages_of_every_kind(tmp_path: Path, symlinks: bool) -> None:
    for kind in KINDS:
        create_package(kind, f"{kind}_one", tmp_path / "src", ros_version=1)  # type: ignore[arg-type]
        create_package(kind, f"{kind}_two", tmp_path / "src", ros_version=2)  # type: ignore[arg-type]
    _build(tmp_path, symlinks=symlinks)
    _check_law(tmp_path, least=25)


def test_the_example_arms_workspace(examples_dir: Path, tmp_path: Path) -> None:
    shutil.copytree(examples_dir / "arm_ws/src", tmp_path / "src")
    _build(tmp_path, symlinks=False)
    _check_law(tmp_path, least=18)


@pytest.mark.tutorial
def test_the_documents_workspace(workspaces_dir: Path, tmp_path: Path) -> None:
    shutil.copytree(workspaces_dir / "ros2_ws/src", tmp_path / "src")
    _build(tmp_path, symlinks=False)
    _check_law(tmp_path, least=18)
