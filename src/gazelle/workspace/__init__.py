"""Packages, models and worlds: where they are, and what a URI in a robot's files means."""

from __future__ import annotations

# As typing has it: importing that is a part of what not importing the modules below saves.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from gazelle.workspace.file_lookup import Resolved
    from gazelle.workspace.package import Package
    from gazelle.workspace.package_xml import Export
    from gazelle.workspace.workspace import Workspace

__all__ = ["Export", "Package", "Resolved", "Workspace"]

_MODULES = {
    "Export": "gazelle.workspace.package_xml",
    "Package": "gazelle.workspace.package",
    "Resolved": "gazelle.workspace.file_lookup",
    "Workspace": "gazelle.workspace.workspace",
}


def __getattr__(name: str) -> Any:
    """Import what is asked for: a node that needs one module of this package needs no other."""
    if name in _MODULES:
        from importlib import import_module

        found = getattr(import_module(_MODULES[name]), name)
        globals()[name] = found
        return found
    raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
