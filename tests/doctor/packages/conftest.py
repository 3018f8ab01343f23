"""Packages made for one test, and those of the fixtures."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.doctor.packages import check_package
from gazelle.doctor.report import Section
from gazelle.workspace import Workspace

Checked = tuple[Diagnostics, tuple[Section, ...]]
Check = Callable[[str, Path], Checked]
Make = Callable[..., Path]

_MANIFEST = """<package format="3">
  <name>bot</name>
  <version>0.1.0</version>
  <description>A bot.</description>
  <maintainer email="bot@example.org">bot</maintainer>
  <license>MIT</license>
  <export><build_type>{build_type}</build_type></export>
</package>
"""


@pytest.fixture
def check() -> Check:
    """Checks a package of a folder of packages."""

    def run(name: str, root: Path) -> Checked:
        workspace = Workspace.discover(environ={"HOME": str(root)}, cwd=root, extra=[root])
        diagnostics = Diagnostics()
        sections = check_package(
            workspace.package(name), workspace=workspace, diagnostics=diagnostics
        )
        return diagnostics, sections

    return run


@pytest.fixture
def make(tmp_path: Path) -> Make:
    """Writes package ``bot`` with these files; the manifest is right unless given."""

    def write(build_type: str = "ament_cmake", **files: str) -> Path:
        texts = {"package.xml": _MANIFEST.format(build_type=build_type)}
        texts |= {name.replace("__", "/"): text for name, text in files.items()}
        for name, text in texts.items():
            path = tmp_path / "bot" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return tmp_path

    return write
