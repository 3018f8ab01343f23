"""Examines packages of the fixtures, and packages made for one test."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.doctor import Options, Report, examine
from gazelle.workspace import Workspace

FIXTURES = Path(__file__).parent / "fixtures"
_FOREIGN = ("AMENT_", "CMAKE_PREFIX", "COLCON_", "GAZEBO_", "GZ_", "IGN_", "ROS_", "SDF_")

Examine = Callable[..., Report]
Write = Callable[..., Path]


@pytest.fixture
def examined(tmp_path_factory: pytest.TempPathFactory) -> Examine:
    """Examines words in a folder, with nothing of this machine's ROS or Gazebo in sight."""
    home = tmp_path_factory.mktemp("home")
    environ = {key: text for key, text in os.environ.items() if not key.startswith(_FOREIGN)}
    environ["HOME"] = str(home)

    def run(folder: Path, *words: str, probe: bool = False, **arguments: str) -> Report:
        workspace = Workspace.discover(environ=environ, cwd=folder)
        options = Options(arguments=arguments, probe=probe, environ=environ)
        return examine(words, workspace=workspace, options=options, cwd=folder)

    return run


@pytest.fixture
def written(tmp_path: Path) -> Write:
    """Writes package ``bot`` with these files, ``__`` for a slash, and returns its folder."""

    def write(**files: str) -> Path:
        manifest = '<package format="2"><name>bot</name><version>1.0.0</version></package>'
        for name, text in {"package.xml": manifest, **files}.items():
            path = tmp_path / "bot" / name.replace("__", "/")
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return tmp_path / "bot"

    return write


def codes(report: Report, least: str = "warning") -> list[str]:
    """Return the codes of findings that are at least so bad, sorted."""
    order = ["info", "warning", "error"]
    bad = order[order.index(least) :]
    return sorted(item.code for item in report.findings if str(item.severity) in bad)
