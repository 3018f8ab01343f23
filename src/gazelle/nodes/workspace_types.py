"""Message types of the workspace's own packages."""

from __future__ import annotations

from functools import cache

__all__ = ["learn_workspace_types"]

_PARTS = ("msg", "srv", "action")


@cache
def learn_workspace_types() -> None:
    """Let the packages of the workspace define types, except those that Gazelle brings."""
    from gazelle.interfaces import add_package, known_types
    from gazelle.workspace import Workspace

    for package in Workspace.discover().user_packages:
        if not any((package.path / part).is_dir() for part in _PARTS):
            continue
        if not any(known_types(part, package.name) for part in _PARTS):
            add_package(package.name, package.path)
