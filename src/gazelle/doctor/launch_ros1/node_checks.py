"""Checks of nodes: what ends the launch by its own end, what is started again and again."""

from __future__ import annotations

import shlex

from gazelle.diagnostics import Diagnostics
from gazelle.doctor.launch_ros1.launched_nodes import Launched, LaunchedNode, Role
from gazelle.doctor.report import Section
from gazelle.nodes.idle_parameters import idle_parameters

__all__ = ["check_idle_parameters", "check_nodes", "nodes_section"]

_ENDS = frozenset({Role.MODEL_SPAWNER})
_BOND = "-b"
_REPLACEMENTS = {
    Role.VIEW: "a window: stays alive",
    Role.BUILTIN: "built in",
}


def check_nodes(launched: Launched, diagnostics: Diagnostics) -> None:
    """Report nodes that are required or respawned and end by themselves, and bad arguments."""
    for node in launched.nodes:
        try:
            shlex.split(node.spec.args)
        except ValueError as error:
            text = f"args of '{node.full_name}' cannot be split into words: {error}"
            diagnostics.report("doctor.bad-arguments", text, node.spec.span)
        if node.role not in _ENDS or _BOND in node.program.words:
            continue
        if node.spec.required:
            text = f"'{node.full_name}' is required and ends as soon as its model is there: that "
            text += "ends the whole launch"
            diagnostics.report("doctor.required-ends", text, node.spec.span)
        if node.spec.respawn:
            text = f"'{node.full_name}' is started again after it has spawned its model, and fails "
            text += "for ever since the model is there already"
            diagnostics.report("doctor.respawn-ends", text, node.spec.span)


def check_idle_parameters(launched: Launched, diagnostics: Diagnostics) -> None:
    """Report parameters of built-in nodes that are known and change nothing here."""
    for node in launched.nodes:
        builtin = node.executable.builtin if node.executable is not None else None
        values = launched.parameters.get(node.full_name) if _has_own(launched, node) else {}
        if builtin is None or not isinstance(values, dict):
            continue
        for item in idle_parameters(f"{builtin.package}/{builtin.executable}", values, 1):
            text = f"'{node.full_name}': parameter '{item.key}' has no effect here: {item.reason}"
            name = f"{node.full_name}/{item.key.replace('.', '/')}"
            span = launched.places.get(name, node.spec.span)
            diagnostics.report("parameter.idle", text, span)


def _has_own(launched: Launched, node: LaunchedNode) -> bool:
    return launched.parameters.has(node.full_name)


def nodes_section(launched: Launched) -> Section:
    """Return the table of what is started, and by what."""
    rows = tuple(
        (node.full_name, f"{node.spec.package}/{node.spec.type}", _runs(node), _place(node))
        for node in launched.nodes
    )
    return Section("nodes", "nodes", ("node", "package/type", "what it is", "place"), rows,
                   launched.name)  # fmt: skip


def _runs(node: LaunchedNode) -> str:
    if node.role is Role.SCRIPT and node.file is not None:
        return f"your {node.file.name}"
    return _REPLACEMENTS.get(node.role, node.role.value)


def _place(node: LaunchedNode) -> str:
    span = node.spec.span
    return "" if span is None else f"{span.file.rpartition('/')[2]}:{span.line}"
