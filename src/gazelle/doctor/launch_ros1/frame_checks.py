"""Checks of the tf tree: gaps, frames with two parents, frames that sensors name."""

from __future__ import annotations

from collections.abc import Mapping

from gazelle.description.model import JointType, Model, PluginTag
from gazelle.description.xml import Tag
from gazelle.diagnostics import Diagnostics, Severity
from gazelle.doctor.dry_start import DryStart
from gazelle.doctor.launch_ros1.frames import Edge, Frames, StatePublisher
from gazelle.doctor.launch_ros1.launched_nodes import Launched
from gazelle.doctor.report import Section

__all__ = ["check_frames", "frames_section"]

_FRAME_KEYS = ("frameName", "frame_name", "frameId", "frame_id")
_MAX_TABLE = 60
_RATE_OF_2011 = "/pr2_controller_manager/joint_state_publish_rate"


def check_frames(
    frames: Frames, launched: Launched, starts: Mapping[str, DryStart], diagnostics: Diagnostics
) -> None:
    """Report what keeps transforms from being found.

    Args:
        frames: of the launch.
        launched: the launch.
        starts: simulators that came up.
        diagnostics: receives the findings.
    """
    is_of_2011 = launched.parameters.has(_RATE_OF_2011)
    for publisher in frames.publishers:
        _check_silent_joints(publisher, frames, starts, is_of_2011, diagnostics)
    _check_parents(frames, diagnostics)
    if frames.is_complete:
        _check_roots(frames, starts, diagnostics)
        for start in starts.values():
            for model in start.world.models:
                _check_sensor_frames(model, frames, diagnostics)


def frames_section(frames: Frames, subject: str) -> Section:
    """Return the table of all edges, children below their parents."""
    rows = [
        (f"{'  ' * depth}{edge.parent} → {edge.child}", edge.how, edge.by)
        for depth, edge in _in_depth(frames.edges)
    ]
    hidden = len(rows) - _MAX_TABLE
    if hidden > 0:
        rows = [*rows[:_MAX_TABLE], (f"… and {hidden} more", "", "")]
    return Section("frames", "tf frames", ("frame", "how", "by"), tuple(rows), subject)


def _in_depth(edges: tuple[Edge, ...]) -> list[tuple[int, Edge]]:
    children: dict[str, list[Edge]] = {}
    for edge in edges:
        children.setdefault(edge.parent, []).append(edge)
    below = {edge.child for edge in edges}
    waiting = [(0, edge) for name, items in children.items() if name not in below for edge in items]
    waiting.reverse()
    found: dict[Edge, int] = {}
    while waiting:
        depth, edge = waiting.pop()
        if edge not in found:
            found[edge] = depth
            waiting += [(depth + 1, item) for item in reversed(children.get(edge.child, []))]
    # What is in a ring has no root.
    found |= {edge: 0 for edge in edges if edge not in found}
    return [(depth, edge) for edge, depth in found.items()]


def _check_silent_joints(
    publisher: StatePublisher,
    frames: Frames,
    starts: Mapping[str, DryStart],
    is_of_2011: bool,
    diagnostics: Diagnostics,
) -> None:
    published = {edge.child for edge in frames.edges}
    silent = [
        joint
        for joint in publisher.silent or ()
        if f"{publisher.prefix}{joint.child}" not in published
    ]
    if not silent:
        return
    names = ", ".join(joint.name for joint in silent)
    links = ", ".join(joint.child for joint in silent)
    text = f"nobody publishes the state of {_joints(len(silent))} {names} on {publisher.topic}, so "
    text += f"'{publisher.node.full_name}' sends no tf to {links}"
    others = {
        topic: sorted(found & {joint.name for joint in silent})
        for start in starts.values()
        for topic, found in start.joint_states.items()
        if found & {joint.name for joint in silent}
    }
    fix = "start a joint_state_publisher, or a joint_state_controller for a simulated robot"
    if others:
        topic = next(iter(others))
        text += f"; the simulator publishes them on {topic}"
        fix = f'write <remap from="joint_states" to="{topic}"/> into the node'
    severity = None
    if is_of_2011:
        text += "; the PR2's controller manager published them itself, Gazelle's does not"
        severity = Severity.INFO
    elif not starts and len(silent) == _moving(publisher):
        text += "; right where another launch brings the robot to life"
        severity = Severity.INFO
    span = publisher.node.spec.span
    diagnostics.report("doctor.joint-without-state", text, span, fix=fix, severity=severity)


def _moving(publisher: StatePublisher) -> int:
    return sum(joint.type is not JointType.FIXED for joint in publisher.model.joints)


def _joints(count: int) -> str:
    return "joint" if count == 1 else "joints"


def _check_parents(frames: Frames, diagnostics: Diagnostics) -> None:
    by_child: dict[str, list[Edge]] = {}
    for edge in frames.edges:
        by_child.setdefault(edge.child, []).append(edge)
    twice: dict[tuple[str, ...], list[Edge]] = {}
    for child, edges in by_child.items():
        parents = {edge.parent for edge in edges}
        if len(parents) > 1:
            who = "; ".join(f"{edge.parent} → {child} by {edge.by}" for edge in edges)
            text = f"frame '{child}' gets {len(parents)} parents, and tf is a tree: {who}"
            diagnostics.report("doctor.frame-two-parents", text, edges[-1].span)
        elif len({edge.by for edge in edges}) > 1:
            twice.setdefault(tuple(edge.by for edge in edges), []).append(edges[-1])
    for nodes, edges in twice.items():
        which = ", ".join(f"{edge.parent} → {edge.child}" for edge in edges)
        text = f"{' and '.join(nodes)} publish the same transforms: {which}"
        diagnostics.report("doctor.frame-published-twice", text, edges[0].span)


def _check_roots(frames: Frames, starts: Mapping[str, DryStart], diagnostics: Diagnostics) -> None:
    """Report a tree that falls apart, where one robot alone makes it sure that it should not."""
    if len(frames.publishers) != 1 or not frames.edges:
        return
    children = {edge.child for edge in frames.edges}
    roots = list(dict.fromkeys(e.parent for e in frames.edges if e.parent not in children))
    if len(roots) < 2 or sum(len(start.spawned) for start in starts.values()) > 1:
        return
    parts = "; ".join(f"{root} (with {_below(root, frames)})" for root in roots)
    text = f"tf falls into {len(roots)} parts that nobody connects: {parts}"
    span = frames.publishers[0].node.spec.span
    diagnostics.report("doctor.frames-apart", text, span, fix=_connecting(frames, roots))


def _below(root: str, frames: Frames) -> str:
    names = [edge.child for edge in frames.edges if edge.parent == root]
    return ", ".join(names[:3]) + (" …" if len(names) > 3 else "")


def _connecting(frames: Frames, roots: list[str]) -> str:
    own = frames.publishers[0]
    base = next((root for root in roots if own.model.link(root) is not None), "")
    loose = {edge.child for edge in frames.edges if edge.parent in roots} - {
        f"{own.prefix}{link.name}" for link in own.model.links
    }
    if not base or not loose:
        return ""
    wanted = sorted(loose)[0]
    return (
        f"let the plug-in name '{base}' as its base frame (robotBaseFrame), or add a link "
        f"'{wanted}' with a fixed joint to '{base}' to the robot"
    )


def _check_sensor_frames(model: Model, frames: Frames, diagnostics: Diagnostics) -> None:
    """Report frames that sensors stamp with and that no tf leads to."""
    links = {link.name for link in model.links}
    mine = [item for item in frames.publishers if links & {link.name for link in item.model.links}]
    if not mine:
        return
    known = frames.names
    for link in model.links:
        for sensor in link.sensors:
            for plugin in sensor.plugins:
                tag = _frame_tag(plugin)
                name = tag.text.strip().lstrip("/") if tag is not None else ""
                prefixed = {f"{item.prefix}{name}" for item in mine}
                if tag is None or not name or name in known or prefixed & known:
                    continue
                text = f"sensor '{sensor.name}' on link '{link.name}' stamps its data with frame "
                text += f"'{name}', which no tf leads to"
                fix = f"write <{tag.name}>{link.name}</{tag.name}>"
                diagnostics.report("doctor.sensor-frame", text, tag.span, fix=fix)


def _frame_tag(plugin: PluginTag) -> Tag | None:
    found = (plugin.parameters.find(key) for key in _FRAME_KEYS)
    return next((tag for tag in found if tag is not None), None)
