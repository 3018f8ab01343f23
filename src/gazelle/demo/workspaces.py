"""Where a demo's workspace, pictures and files are, and its copy for the user to change."""

from __future__ import annotations

import shutil
import stat
from pathlib import Path
from typing import Any

from gazelle.demo.demo import Demo, Panel
from gazelle.errors import GazelleError
from gazelle.workspace.environment_paths import demo_folder

__all__ = ["copy_demo", "panel_params", "picture", "workspace_folder"]

_PICTURES = Path(__file__).parent / "pictures"


def workspace_folder(demo: Demo) -> Path:
    """Return the folder whose ``src`` holds the packages; nothing is ever written there."""
    return demo_folder() / demo.workspace


def picture(demo: Demo) -> Path | None:
    """Return a picture of the demo, 480 by 270 pixels, None when there is none."""
    path = _PICTURES / f"{demo.name}.webp"
    return path if path.is_file() else None


def panel_params(demo: Demo, panel: Panel) -> dict[str, Any]:
    """Return what a panel is opened with, its file as an absolute path."""
    file = {"file": str(workspace_folder(demo) / panel.file)} if panel.file else {}
    return {**panel.params, **file}


def copy_demo(demo: Demo, folder: Path) -> tuple[Path, ...]:
    """Write a demo's packages as a workspace that is the user's.

    Args:
        demo: whose packages.
        folder: the workspace, which is made; an empty folder will do.

    Returns:
        The folders of the packages.

    Raises:
        GazelleError: there is something already; nothing is written then.
    """
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise GazelleError(
            f"'{folder}' is there already, and nothing is written over it; name a new folder: "
            f"gazelle demo {demo.name} --copy {folder.name}_2"
        )
    source = workspace_folder(demo) / "src"
    for file in sorted(source.rglob("*")):
        if file.is_file() and "__pycache__" not in file.parts:
            _copy_file(file, folder / "src" / file.relative_to(source))
    return tuple(folder / "src" / name for name in demo.packages)


def _copy_file(file: Path, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(file, target)
    # An installed file may be read-only, and an installer may have lost who may run it.
    with file.open("rb") as stream:
        is_program = stream.read(2) == b"#!"
    runnable = stat.S_IXUSR | stat.S_IXGRP | stat.S_IXOTH if is_program else 0
    target.chmod(target.stat().st_mode | stat.S_IWUSR | runnable)
