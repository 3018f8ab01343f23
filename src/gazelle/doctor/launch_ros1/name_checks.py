"""Checks of names: remaps to nowhere, topics that nobody publishes, robot descriptions."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.doctor.launch_ros1.launched_nodes import Launched, LaunchedNode, Role
from gazelle.doctor.launch_ros1.topics import NodeTopics
from gazelle.doctor.topic_checks import check_topic_names, check_topic_types, same_type
from gazelle.documents import read_text_limited
from gazelle.graph.names import resolve

__all__ = ["check_descriptions", "check_remaps", "check_topics"]

_WORD = "robot_description"
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_NEEDS_DESCRIPTION = {
    Role.STATE_PUBLISHER: "ends at once",
    Role.JOINT_STATES: "publishes nothing",
}
# Published from outside a launch: by hand, by RViz, by a teleoperation of its own.
_FROM_OUTSIDE = frozenset({"cmd_vel", "clicked_point", "goal", "initialpose", "tf", "tf_static"})
_UNREMAPPED = frozenset({Role.MODEL_SPAWNER, Role.CONTROLLER_SPAWNER, Role.VIEW})


def check_remaps(
    launched: Launched, topics: Sequence[NodeTopics], diagnostics: Diagnostics
) -> None:
    """Report remaps of names that none of the nodes they are for uses.

    Only where that is sure: all those nodes are built in, simulated or complete scripts.
    """
    pairs: dict[tuple[str, str], list[NodeTopics]] = {}
    for item in topics:
        for pair in item.node.spec.remaps:
            pairs.setdefault(pair, []).append(item)
    for (source, target), items in pairs.items():
        concerned = [item for item in items if not _needs_no_topics(item.node)]
        if not concerned or any(_may_use(source, item, launched) for item in concerned):
            continue
        names = ", ".join(item.node.full_name for item in concerned)
        known = {name for item in concerned for name in item.written}
        text = f"the remap from '{source}' to '{target}' is of no use: {names} does not use "
        text += f"'{source}'"
        used = sorted(name for name in known if not name.startswith(("/gazebo/", "/rosout")))
        shown = ", ".join(used[:6]) + (" …" if len(used) > 6 else "")
        near = _nearest(resolve(source), known)
        fix = near or (f"names in use: {shown}" if shown else "remove it")
        diagnostics.report("doctor.remap-unused", text, concerned[0].node.spec.span, fix=fix)


def check_topics(
    launched: Launched, topics: Sequence[NodeTopics], diagnostics: Diagnostics
) -> None:
    """Report topics that the user's scripts and others know under other names or types."""
    ends = [end for item in topics for end in item.ends()]
    check_topic_types(ends, diagnostics, ros_version=1)
    unknown = [item for item in topics if not item.is_complete and item.node.role is not Role.VIEW]
    taken = [_target(pair, item.node) for item in unknown for pair in item.node.spec.remaps]
    check_topic_names(ends, diagnostics, is_whole=not unknown, others=taken)
    if unknown:
        return
    offered = {name: kind for item in topics for name, kind in item.publishes.items()}
    heard = {name: kind for item in topics for name, kind in item.listens.items()}
    for item in topics:
        if item.node.role is not Role.SCRIPT:
            continue
        for name, kind in item.listens.items():
            if name not in offered and name.rpartition("/")[2] not in _FROM_OUTSIDE:
                _report_topic(item.node, name, kind, offered, False, diagnostics)
        for name, kind in item.publishes.items():
            if name not in heard:
                _report_topic(item.node, name, kind, heard, True, diagnostics)


def _target(remap: tuple[str, str], node: LaunchedNode) -> str:
    return resolve(remap[1], node.program.namespace, node=node.full_name)


def check_descriptions(launched: Launched, diagnostics: Diagnostics) -> None:
    """Report robot descriptions that are missing, elsewhere, or still xacro."""
    # What follows from a file that cannot be read in full would hide why.
    for node in launched.nodes if launched.is_whole else ():
        if node.role in _NEEDS_DESCRIPTION and launched.description(node) is None:
            _report_no_description(node, launched, diagnostics)
    for name, value in launched.config.params.items():
        if isinstance(value, str) and _is_unexpanded(value):
            file = _file_with(value, launched.config.text_files)
            text = f"parameter '{name}' holds xacro that nobody has expanded"
            text += f", the text of '{file}'" if file else ""
            text += ": its ${…} and <xacro:…> mean nothing to a URDF reader"
            span = launched.spans.get(name)
            fix = 'write command="$(find xacro)/xacro FILE" in place of textfile='
            diagnostics.report("doctor.description-not-expanded", text, span, fix=fix)


def _file_with(text: str, files: Sequence[str]) -> str:
    """Return which of the files a parameter's text was read from, empty when none is."""
    for file in files:
        try:
            if read_text_limited(Path(file)) == text:
                return file
        except (OSError, UnicodeDecodeError):
            continue
    return ""


def _is_unexpanded(text: str) -> bool:
    start = _COMMENT.sub("", text).lstrip()
    return start.startswith("<") and "<robot" in start and "<xacro:" in start


def _report_no_description(
    node: LaunchedNode, launched: Launched, diagnostics: Diagnostics
) -> None:
    wanted = node.resolve(_WORD)
    others = [name for name in launched.config.params if name.endswith(_WORD) and name != wanted]
    lack = "is empty" if launched.parameters.has(wanted) else "is not set"
    text = f"'{node.full_name}' {_NEEDS_DESCRIPTION[node.role]}: parameter '{wanted}' {lack}"
    fix = f'add <param name="{_WORD}" command="…"/> above the node'
    if others:
        text += f"; there is {', '.join(others)}"
        fix = f'write <remap from="{_WORD}" to="{others[0]}"/> into the node, or give it the ns'
    diagnostics.report("doctor.no-description", text, node.spec.span, fix=fix)


def _needs_no_topics(node: LaunchedNode) -> bool:
    """Tell whether a node has no topics that a remap in a wide scope could be meant for."""
    is_window = node.spec.type in {"gzclient", "gzclient.py"}
    return node.role in _UNREMAPPED and (node.role is not Role.VIEW or is_window)


def _may_use(source: str, item: NodeTopics, launched: Launched) -> bool:
    node = item.node
    if not item.is_complete:
        return True
    name = resolve(source, node.program.namespace, node=node.full_name)
    if name in item.written or launched.parameters.has(name):
        return True
    if name.endswith(("/tf", "/tf_static", "/clock", _WORD)):
        return True
    return node.file is not None and _mentions(node, name.rpartition("/")[2])


def _mentions(node: LaunchedNode, word: str) -> bool:
    """Tell whether a script has a word anywhere: a service, a parameter or an action may be so."""
    assert node.file is not None
    return word in node.file.read_text(encoding="utf-8", errors="replace")


def _report_topic(
    node: LaunchedNode,
    name: str,
    kind: str,
    others: Mapping[str, str],
    publishes: bool,
    diagnostics: Diagnostics,
) -> None:
    fitting = [
        item for item, other in others.items() if not kind or not other or same_type(kind, other)
    ]
    last = name.rpartition("/")[2]
    same = [item for item in fitting if item.rpartition("/")[2] == last and item != name]
    near = same[0] if same else ""
    if not near:
        return
    verb, lack = ("publishes", "listens to") if publishes else ("listens to", "publishes")
    text = f"'{node.full_name}' {verb} '{name}', which nobody in this launch {lack}; there is "
    text += f"'{near}' of the same type"
    fix = f'write <remap from="{name}" to="{near}"/> into the node, or correct its ns'
    diagnostics.report("doctor.topic-elsewhere", text, node.spec.span, fix=fix)


def _nearest(name: str, known: set[str]) -> str:
    last = name.rpartition("/")[2]
    same = sorted(item for item in known if item.rpartition("/")[2] == last)
    return f"did you mean '{same[0]}'?" if same else did_you_mean(name, known)
