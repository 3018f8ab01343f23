"""Workspaces with C++ in them, and the commands over them."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest
from tests.patience import stretched

__all__ = ["Gazelle", "Workspace", "environment"]

Workspace = Callable[[Mapping[str, str]], Path]
Gazelle = Callable[..., "subprocess.CompletedProcess[str]"]


@pytest.fixture
def workspace(tmp_path: Path) -> Workspace:
    """Writes files below ``src`` of a new workspace; those of ``scripts`` are programs."""

    def write(files: Mapping[str, str]) -> Path:
        top = tmp_path / "ws"
        for name, text in files.items():
            path = top / "src" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
            if path.parent.name == "scripts":
                path.chmod(0o755)
        return top

    return write


def environment(port: int, **more: str) -> dict[str, str]:
    """Return the environment of a shell that nobody has set up for a ROS."""
    dropped = ("PATH", "PREFIX", "PACKAGE", "CPP", "PARENT_PID")
    kept = {
        name: value
        for name, value in os.environ.items()
        if not (name.startswith(("AMENT_", "CMAKE_", "COLCON_", "ROS_PACKAGE", "GAZELLE_"))
                and name.endswith(dropped))
    }  # fmt: skip
    return {**kept, "GAZELLE_PORT": str(port), **more}


@pytest.fixture
def gazelle(free_port: int) -> Gazelle:
    """Runs a command of Gazelle in a folder, to its end."""

    def run(
        *words: str, folder: Path, limit_s: float = 240.0, **more: Any
    ) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, "-m", "gazelle.cli", *words],
            cwd=folder,
            env=environment(free_port, **more),
            capture_output=True,
            text=True,
            timeout=stretched(limit_s),
            check=False,
        )

    return run
