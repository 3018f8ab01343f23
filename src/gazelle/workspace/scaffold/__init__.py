"""New packages that run at once: a robot, a world, or a node."""

from __future__ import annotations

from gazelle.workspace.scaffold.create_package import (
    KINDS,
    ScaffoldError,
    check_package_name,
    create_package,
)

__all__ = ["KINDS", "ScaffoldError", "check_package_name", "create_package"]
