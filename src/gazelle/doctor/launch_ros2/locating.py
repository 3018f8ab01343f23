"""Where a path of a share folder lies in the source tree."""

from __future__ import annotations

from pathlib import Path

from gazelle.documents.files import exists
from gazelle.workspace import Package, Workspace
from gazelle.workspace.installed_files import installed_source

__all__ = ["located", "package_of"]


def located(name: str) -> Path | None:
    """Return the file that a path of a share folder means, None when there is none.

    In a source folder that is the file that its build files install to there.
    """
    path = Path(name)
    if not path.is_absolute():
        return None
    if exists(path):
        return path
    try:
        return installed_source(path)
    except (OSError, ValueError):
        # Names that are too long, or hold a NUL.
        return None


def package_of(path: Path, workspace: Workspace) -> Package | None:
    """Return the package a path lies in, None when in none."""
    for package in workspace.packages.values():
        if path.is_absolute() and path.is_relative_to(package.path):
            return package
    return None
