from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.workspace import Workspace

MANIFEST = """<?xml version="1.0"?>
<package format="2">
  <name>{name}</name>
  <version>1.2.3</version>
  <description>A package.</description>
  <buildtool_depend>{tool}</buildtool_depend>
  <depend>roscpp</depend>
  <export>{export}</export>
</package>
"""

MakePackage = Callable[..., Path]


@pytest.fixture
def make_package() -> MakePackage:
    def make(folder: Path, name: str = "", *, tool: str = "catkin", export: str = "") -> Path:
        folder.mkdir(parents=True)
        text = MANIFEST.format(name=name or folder.name, tool=tool, export=export)
        (folder / "package.xml").write_text(text)
        return folder

    return make


@pytest.fixture
def discover(tmp_path: Path) -> Callable[..., Workspace]:
    """A workspace that sees nothing of the machine but what is named."""

    def make(cwd: Path | None = None, extra: tuple[Path, ...] = (), **environ: str) -> Workspace:
        home = tmp_path / "home"
        elsewhere = tmp_path / "elsewhere"
        elsewhere.mkdir(exist_ok=True)
        variables = {"HOME": str(home), **environ}
        return Workspace.discover(environ=variables, cwd=cwd or elsewhere, extra=extra)

    return make
