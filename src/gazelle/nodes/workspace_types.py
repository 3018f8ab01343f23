"""Message types of the workspace's own packages."""

from __future__ import annotations

__all__ = ["learn_workspace_types"]

_PARTS = ("msg", "srv", "action")


def learn_workspace_types() -> None:
    """Let the packages of the workspace define types, except those that Gazelle brings."""
    from gazelle.interfaces import add_package, default_types, known_types
    from gazelle.workspace import Workspace

    if __name__ in default_types().taught_by:
        return
    default_types().taught_by.add(__name__)
    for package in Workspace.discover().user_packages:
        if not any((package.path / part).is_dir() for part in _PARTS):
            continue
        if not any(known_types(part, package.name) for part in _PARTS):
            add_package(package.name, package.path)
