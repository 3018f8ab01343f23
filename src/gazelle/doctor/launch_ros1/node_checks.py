"""Checks of nodes: how they end and respawn, parameters without effect, and their clock."""

from __future__ import annotations

import shlex
from collections.abc import Mapping
from difflib import SequenceMatcher

from gazelle.description.xml import attribute_span
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.doctor.dry_start import DryStart
from gazelle.doctor.launch_ros1.launched_nodes import Launched, LaunchedNode, Role
from gazelle.doctor.report import Section
from gazelle.doctor.script_parameters import (
    ScriptParameters,
    read_script_parameters,
    report_unread,
)
from gazelle.nodes.unsupported_parameters import misspelt_parameters, unsupported_parameters
from gazelle.parameters.trees import flattened

__all__ = [
    "check_clock",
    "check_nodes",
    "check_script_parameters",
    "check_unsupported_parameters",
    "nodes_section",
]

_NAME = "/use_sim_time"
_WORD = "use_sim_time"
_MIN_LIKENESS = 0.76
_ENDS = frozenset({Role.MODEL_SPAWNER})
_BOND = "-b"
_REPLACEMENTS = {
    Role.VIEW: "a window: stays alive",
    Role.BUILTIN: "built in",
}


def check_clock(
    launched: Launched, starts: Mapping[str, DryStart], diagnostics: Diagnostics
) -> None:
    """Report clocks that contradict each other.

    Args:
        launched: the launch.
        starts: simulators that came up.
        diagnostics: receives the findings.
    """
    owners = [node for node in launched.nodes if _owns_clock(node)]
    if len(owners) > 1:
        names = " and ".join(f"'{node.full_name}'" for node in owners)
        text = f"{names} both publish /clock: time jumps back and forth for every node"
        diagnostics.report("doctor.two-clocks", text, owners[1].spec.span)
    _check_names(launched, diagnostics)
    _check_value(launched, owners, diagnostics)
    _check_pause(launched, starts, diagnostics)


def check_nodes(launched: Launched, diagnostics: Diagnostics) -> None:
    """Report nodes that are required or respawned and end by themselves, and bad arguments."""
    for node in launched.nodes:
        try:
            shlex.split(node.spec.args)
        except ValueError as error:
            text = f"args of '{node.full_name}' cannot be split into words: {error}"
            diagnostics.report("doctor.bad-arguments", text, node.spec.span)
        if node.role not in _ENDS or _BOND in node.program.argv:
            continue
        if node.spec.required:
            text = f"'{node.full_name}' is required and ends as soon as its model is there: that "
            text += "ends the whole launch"
            diagnostics.report("doctor.required-ends", text, node.spec.span)
        if node.spec.respawn:
            text = f"'{node.full_name}' is started again after it has spawned its model, and fails "
            text += "for ever since the model is there already"
            diagnostics.report("doctor.respawn-ends", text, node.spec.span)


def check_unsupported_parameters(launched: Launched, diagnostics: Diagnostics) -> None:
    """Report parameters of built-in nodes that change nothing here, or are misspelt."""
    for node in launched.nodes:
        builtin = node.executable.builtin if node.executable is not None else None
        values = launched.parameters.get(node.full_name) if _has_own(launched, node) else {}
        if builtin is None or not isinstance(values, dict):
            continue
        for item in unsupported_parameters(f"{builtin.package}/{builtin.executable}", values, 1):
            text = f"'{node.full_name}': parameter '{item.key}' has no effect here: {item.reason}"
            span = _parameter_span(node, item.key, launched)
            diagnostics.report("parameter.idle", text, span)
        for wrong in misspelt_parameters(f"{builtin.package}/{builtin.executable}", values, 1):
            text = f"'{node.full_name}': parameter '{wrong.key}' is not known; it has no effect"
            span = _parameter_span(node, wrong.key, launched)
            place = attribute_span(span, "name") if span is not None else None
            diagnostics.report("parameter.unknown", text, place, fix=wrong.hint)


def check_script_parameters(launched: Launched, diagnostics: Diagnostics) -> None:
    """Report parameters of the user's scripts that these never read."""
    for node in launched.of_role(Role.SCRIPT):
        values = launched.parameters.get(node.full_name) if _has_own(launched, node) else {}
        known = read_script_parameters(node.file) if node.file is not None else ScriptParameters()
        if not known.is_complete or not isinstance(values, dict):
            continue
        for key, _ in flattened(values):
            name = key.replace(".", "/")
            full = f"{node.full_name}/{name}"
            span = launched.spans.get(full)
            if span is not None and not known.reads(full, node.resolve):
                place = attribute_span(span, "name")
                report_unread(node.full_name, name, known, node.spec.type, place, diagnostics)


def nodes_section(launched: Launched) -> Section:
    """Return the table of what is started, and by what."""
    rows = tuple(
        (node.full_name, f"{node.spec.package}/{node.spec.type}", _runs(node), _location(node))
        for node in launched.nodes
    )
    return Section("nodes", "nodes", ("node", "package/type", "what it is", "place"), rows,
                   launched.name)  # fmt: skip


def _owns_clock(node: LaunchedNode) -> bool:
    plays = (node.spec.package, node.spec.type) == ("rosbag", "play")
    return node.role is Role.SIMULATOR or (plays and "--clock" in node.program.argv)


def _check_names(launched: Launched, diagnostics: Diagnostics) -> None:
    """Report values under names that no node of ROS 1 looks at."""
    fix = f'write <param name="{_NAME}" …/> with the slash'
    for name, value in launched.config.params.items():
        last = name.rpartition("/")[2]
        if name == _NAME or not isinstance(value, bool):
            continue
        if last == _WORD:
            text = f"parameter '{name}' has no effect: nodes of ROS 1 look at {_NAME} only"
        elif _is_misspelled(last):
            text = f"parameter '{name}' is looked at by no node; did you mean '{_WORD}'?"
        else:
            continue
        span = launched.spans.get(name)
        diagnostics.report("doctor.sim-time-name", text, span, fix=fix)


def _is_misspelled(name: str) -> bool:
    """Tell whether a name is a slip for the clock's: ``use_map_topic`` is another thing."""
    argv = name.casefold().replace("_", "")
    likeness = SequenceMatcher(None, argv, _WORD.replace("_", "")).ratio()
    return name.startswith("use") and likeness >= _MIN_LIKENESS


def _check_value(launched: Launched, owners: list[LaunchedNode], diagnostics: Diagnostics) -> None:
    value = launched.config.params.get(_NAME)
    if owners and value is not True:
        how = "not set" if value is None else f"{value!r}"
        others = [node for node in launched.nodes if _has_a_clock(node)]
        if not others:
            return
        names = ", ".join(node.full_name for node in others[:4])
        text = f"{_NAME} is {how} while '{owners[0].full_name}' publishes /clock: nodes that start "
        text += f"before it sets the parameter keep the wall's time ({names}), and their stamps "
        text += "lie decades apart from the simulator's"
        diagnostics.report("doctor.sim-time-off", text, owners[0].spec.span)
    elif not owners and value is True:
        text = f"{_NAME} is true and nothing in this launch publishes /clock: time stands at 0 "
        text += "until a simulator or `rosbag play --clock` runs elsewhere"
        diagnostics.report("doctor.no-clock", text, launched.spans.get(_NAME))


def _has_a_clock(node: LaunchedNode) -> bool:
    """Tell whether a node stamps or compares times on its own."""
    return node.role in {
        Role.STATE_PUBLISHER,
        Role.JOINT_STATES,
        Role.STATIC_TRANSFORM,
        Role.SCRIPT,
        Role.NATIVE,
        Role.BUILTIN,
    }


def _check_pause(
    launched: Launched, starts: Mapping[str, DryStart], diagnostics: Diagnostics
) -> None:
    for name, start in starts.items():
        if start.paused and not start.unpaused_by:
            node = next(item for item in launched.nodes if item.full_name == name)
            text = f"'{name}' starts paused and nothing in this launch unpauses it"
            diagnostics.report("doctor.paused", text, node.spec.span)


def _parameter_span(node: LaunchedNode, key: str, launched: Launched) -> SourceSpan | None:
    name = f"{node.full_name}/{key.replace('.', '/')}"
    return launched.spans.get(name, node.spec.span)


def _has_own(launched: Launched, node: LaunchedNode) -> bool:
    return launched.parameters.has(node.full_name)


def _runs(node: LaunchedNode) -> str:
    if node.role is Role.SCRIPT and node.file is not None:
        return f"your {node.file.name}"
    return _REPLACEMENTS.get(node.role, node.role.value)


def _location(node: LaunchedNode) -> str:
    span = node.spec.span
    return "" if span is None else f"{span.file.rpartition('/')[2]}:{span.line}"
