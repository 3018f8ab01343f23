"""Checks of names: remaps to nowhere, topics that nobody publishes, robot descriptions."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from enum import Enum
from pathlib import Path

from gazelle.description.xml import attribute_span
from gazelle.diagnostics import Diagnostics, SourceSpan, nearest_names
from gazelle.doctor.launch_ros1.launched_nodes import Launched, LaunchedNode, Role
from gazelle.doctor.launch_ros1.topics import NodeTopics
from gazelle.doctor.script_topics import TopicEnd, read_script
from gazelle.doctor.topic_checks import (
    check_topic_names,
    check_topic_types,
    is_typo,
    same_type,
)
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

    Only where that is sure: all those nodes are built in, simulated or complete scripts. Of others,
    a slip for a name that they are known to use.
    """
    pairs: dict[tuple[str, str], list[NodeTopics]] = {}
    spans: dict[tuple[str, str], SourceSpan | None] = {}
    for item in topics:
        spec = item.node.spec
        places = spec.remap_spans or (spec.span,) * len(spec.remaps)
        for pair, span in zip(spec.remaps, places, strict=True):
            pairs.setdefault(pair, []).append(item)
            spans.setdefault(pair, span)
    ends = [end for item in topics for end in item.ends()]
    for (source, target), items in pairs.items():
        concerned = [item for item in items if not _needs_no_topics(item.node)]
        if not concerned or any(_may_use(source, item, launched) for item in concerned):
            continue
        names = ", ".join(item.node.full_name for item in concerned)
        text = f"the remap from '{source}' to '{target}' is of no use: {names} does not use "
        text += f"'{source}'"
        known = {name for item in concerned for name in item.written}
        used = sorted(name for name in known if not name.startswith(("/gazebo/", "/rosout")))
        shown = ", ".join(used[:6]) + (" …" if len(used) > 6 else "")
        near = _meant(source, target, concerned, ends)
        fix = f"did you mean '{near}'?" if near else f"names in use: {shown}" if shown else ""
        span = spans[source, target]
        place = attribute_span(span, "from") if span is not None else None
        diagnostics.report("doctor.remap-unused", text, place, fix=fix or "remove it")


def check_topics(
    launched: Launched, topics: Sequence[NodeTopics], diagnostics: Diagnostics
) -> None:
    """Report topics that the user's scripts and others know under other names or types."""
    ends = [end for item in topics for end in item.ends()]
    check_topic_types(ends, diagnostics, ros_version=1)
    unknown = [item for item in topics if not item.is_complete and item.node.role is not Role.VIEW]
    taken = [_target(pair, item.node) for item in unknown for pair in item.node.spec.remaps]
    # Another namespace is mended by a remap, below.
    check_topic_names(
        ends, diagnostics, is_whole=not unknown, others=taken, of_namespaces=bool(unknown)
    )
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
    name = resolve(source, node.program.namespace, node=node.full_name)
    if not item.is_complete:
        return name in item.written or not any(is_typo(name, other) for other in item.written)
    if name in item.written or launched.parameters.has(name):
        return True
    if name.endswith(("/tf", "/tf_static", "/clock", _WORD)):
        return True
    return node.file is not None and _mentions(node, name.rpartition("/")[2])


def _mentions(node: LaunchedNode, word: str) -> bool:
    """Tell whether a script has a word in a text: a service, a parameter or an action may be so."""
    assert node.file is not None
    return any(word in text for text in read_script(node.file).texts)


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


def _meant(
    source: str, target: str, concerned: Sequence[NodeTopics], ends: Sequence[TopicEnd]
) -> str:
    """Return the name of a node that a remap is to be from, as the remap would write it."""
    for item in concerned:
        namespace = item.node.program.namespace
        name, goal = (resolve(one, namespace, node=item.node.full_name) for one in (source, target))
        fits = {one: _fit(one, goal, item, ends) for one in sorted(item.written)}
        useful = [one for one, fit in fits.items() if fit is not _Fit.NONE]
        last = name.rpartition("/")[2]
        meets = [one for one in useful if fits[one] is _Fit.SURE]
        near = [
            *(one for one in useful if one.rpartition("/")[2] == last),
            *(one for one in useful if is_typo(name, one)),
            *nearest_names(name, meets, count=1),
            *nearest_names(name, useful, count=1),
            *(meets if len(meets) == 1 else ()),
        ]
        if near:
            return _relative(near[0], source, item.node)
    return ""


class _Fit(Enum):
    """Whether a topic of a node would meet what is at the target of a remap."""

    NONE = 0
    PERHAPS = 1
    SURE = 2


def _fit(name: str, target: str, item: NodeTopics, ends: Sequence[TopicEnd]) -> _Fit:
    if name in item.node.rules:
        # It has a remap already.
        return _Fit.NONE
    own = [(kind, True) for kind in [item.publishes.get(name)] if kind]
    own += [(kind, False) for kind in [item.listens.get(name)] if kind]
    there = [end for end in ends if end.topic == target and end.type]
    facing = [end for end in there if any(end.publishes != gives for _, gives in own)]
    if any(same_type(kind, end.type) for kind, _ in own for end in facing):
        return _Fit.SURE
    is_other = own and there and not any(same_type(k, end.type) for k, _ in own for end in there)
    return _Fit.NONE if is_other else _Fit.PERHAPS


def _relative(name: str, source: str, node: LaunchedNode) -> str:
    """Return a global name in the way a remap is written: relative where that is."""
    if source.startswith("/"):
        return name
    private, around = f"{node.full_name}/", f"{node.program.namespace.rstrip('/')}/"
    if name.startswith(private):
        return f"~{name.removeprefix(private)}"
    return name.removeprefix(around) if name.startswith(around) else name
