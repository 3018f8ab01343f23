"""What is wrong with a node's parameters, said in its log."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from gazelle.diagnostics import Diagnostic, Diagnostics, brief
from gazelle.graph import Level
from gazelle.graph.console import aside_path, write_aside

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["log_findings"]

_LEVELS = {10: "info", 20: "warn", 30: "error"}


def log_findings(
    node: Node, diagnostics: Diagnostics, text_of: Callable[[Diagnostic], str] = str
) -> bool:
    """Say what was found; parameters without effect are summed, and listed in the log file.

    So is what works and asks for nothing, which the terminal is spared.
    A node that logs at level debug says all of it.

    Args:
        node: logs it.
        diagnostics: what was found.
        text_of: a finding in words.

    Returns:
        whether there was no error.
    """
    shown, kept = brief(diagnostics, str(aside_path(node)))
    if kept and (node.log_level <= Level.DEBUG or not write_aside(node, map(text_of, kept))):
        shown = tuple(diagnostics)
    for item in shown:
        node.log(_LEVELS[int(item.severity)], text_of(item), depth=2)
    return not diagnostics.errors
