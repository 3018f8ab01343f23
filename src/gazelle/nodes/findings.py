"""What is wrong with a node's parameters, said in its log."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gazelle.diagnostics import Diagnostics

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["log_findings"]

_LEVELS = {10: "info", 20: "warn", 30: "error"}


def log_findings(node: Node, diagnostics: Diagnostics) -> bool:
    """Say what was found; tell whether there was no error."""
    for item in diagnostics:
        node.log(_LEVELS[int(item.severity)], str(item))
    return not diagnostics.errors
