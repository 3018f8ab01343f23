"""A workspace made for one test, and building it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.workspace.building.build import BuildOptions, Outcome, build_package
from gazelle.workspace.building.packages import find_packages, in_order
from gazelle.workspace.building.setup_scripts import write_prefix_scripts

Make = Callable[..., Path]
Build = Callable[..., dict[str, Outcome]]

_MANIFEST = """<package format="3">
  <name>{name}</name>
  <version>0.1.0</version>
  <description>A package.</description>
  <maintainer email="bot@example.org">bot</maintainer>
  <license>MIT</license>
{depends}
  <export><build_type>{build_type}</build_type></export>
</package>
"""


@pytest.fixture
def make(tmp_path: Path) -> Make:
    """Writes a package into ``src``; its manifest is right unless given."""

    def write(
        name: str,
        build_type: str = "ament_cmake",
        files: dict[str, str] | None = None,
        needs: tuple[str, ...] = (),
    ) -> Path:
        depends = "".join(f"  <exec_depend>{need}</exec_depend>\n" for need in needs)
        manifest = _MANIFEST.format(name=name, build_type=build_type, depends=depends)
        folder = tmp_path / "src" / name
        for path, text in {"package.xml": manifest, **(files or {})}.items():
            file = folder / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        return folder

    return write


@pytest.fixture
def build(tmp_path: Path) -> Build:
    """Builds all packages of ``src`` into ``install``, in order."""

    def run(
        *, symlinks: bool = False, merged: bool = False, **definitions: str
    ) -> dict[str, Outcome]:
        packages = in_order(find_packages([tmp_path / "src"], Diagnostics()))
        options = BuildOptions(
            tmp_path / "build", tmp_path / "install", merged, symlinks, definitions
        )
        outcomes = {item.name: build_package(item, options) for item in packages}
        if options.install_base.is_dir():
            write_prefix_scripts(options.install_base, merged=merged, environ={})
        return outcomes

    return run
