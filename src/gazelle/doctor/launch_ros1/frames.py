"""The tf tree that a launch will have: who publishes each frame, and what is wrong with it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from gazelle.description.model import Joint, JointType, Model
from gazelle.diagnostics import Diagnostics, Severity, SourceSpan
from gazelle.doctor.dry_start import DryStart
from gazelle.doctor.launch_ros1.launched_nodes import Launched, LaunchedNode, Role
from gazelle.doctor.launch_ros1.topics import NodeTopics
from gazelle.doctor.report import Section
from gazelle.doctor.robots_and_worlds import frame_slip, frame_tag
from gazelle.doctor.script_topics import read_script
from gazelle.errors import LaunchError
from gazelle.nodes.link_tree import read_description
from gazelle.nodes.static_transform_publisher import parse_arguments

__all__ = ["Edge", "Frames", "StatePublisher", "check_frames", "frames_of", "frames_section"]

_MOVING = frozenset(set(JointType) - {JointType.FIXED})
_MAX_TABLE = 60
_RATE_OF_2011 = "/pr2_controller_manager/joint_state_publish_rate"


@dataclass(frozen=True, slots=True)
class Edge:
    """A transform from parent to child.

    Attributes:
        by: the node that publishes it.
        how: ``static``, ``joint NAME`` or ``moving``.
        span: place of the node.
    """

    parent: str
    child: str
    by: str
    how: str
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class StatePublisher:
    """A ``robot_state_publisher`` and its robot.

    Attributes:
        node: the node.
        model: its robot description.
        prefix: put before each frame, with a slash; empty for none.
        topic: where it hears joint states.
        silent: joints that nobody publishes the state of; None when that is not known.
    """

    node: LaunchedNode
    model: Model
    prefix: str
    topic: str
    silent: tuple[Joint, ...] | None


@dataclass(frozen=True, slots=True)
class Frames:
    """All edges, and whether there can be others.

    Attributes:
        edges: in the order of the nodes.
        publishers: the robot_state_publishers.
        is_complete: no node of the launch can publish further edges.
    """

    edges: tuple[Edge, ...]
    publishers: tuple[StatePublisher, ...]
    is_complete: bool

    @property
    def names(self) -> frozenset[str]:
        """Every frame there will be."""
        return frozenset(name for edge in self.edges for name in (edge.parent, edge.child))


def frames_of(
    launched: Launched,
    topics: Sequence[NodeTopics],
    starts: Mapping[str, DryStart],
    diagnostics: Diagnostics,
) -> Frames:
    """Collect the edges of tf; report nodes that cannot publish theirs.

    Args:
        launched: the launch.
        topics: of every node.
        starts: simulators that came up.
        diagnostics: receives the findings.
    """
    edges: list[Edge] = []
    publishers: list[StatePublisher] = []
    is_complete = True
    for node, known in zip(launched.nodes, topics, strict=True):
        match node.role:
            case Role.STATE_PUBLISHER:
                publisher = _state_publisher(node, launched, topics, starts, diagnostics)
                if publisher is not None:
                    publishers.append(publisher)
                    edges += _edges_of(publisher)
            case Role.STATIC_TRANSFORM:
                edges += _static_edges(node, diagnostics)
            case Role.SIMULATOR if node.full_name in starts:
                edges += _simulated_edges(node, starts[node.full_name])
            case Role.SCRIPT if node.file is not None:
                sends = read_script(node.file).sends_transforms
                is_complete &= known.is_complete and not sends
            case Role.VIEW:
                continue
            case _ if known.known is not None and known.known.transforms is not None:
                edges += [
                    Edge(parent, child, node.full_name, "moving", node.spec.span)
                    for parent, child in known.known.transforms
                ]
            case _:
                is_complete &= known.is_complete
    return Frames(tuple(edges), tuple(publishers), is_complete)


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


def _state_publisher(
    node: LaunchedNode,
    launched: Launched,
    topics: Sequence[NodeTopics],
    starts: Mapping[str, DryStart],
    diagnostics: Diagnostics,
) -> StatePublisher | None:
    text = launched.description(node)
    if text is None:
        return None
    try:
        model = read_description(text)
    except LaunchError as error:
        # Whoever loads the robot into a world tells all that is wrong with it.
        if not diagnostics.errors:
            said = f"'{node.full_name}' ends at once: {error}"
            diagnostics.report("doctor.no-description", said, node.spec.span)
        return None
    prefix = str(launched.private(node, "tf_prefix", "")).strip("/")
    topic = node.resolve("joint_states")
    known = _joints_heard(topic, launched, topics, starts)
    silent = None if known is None else _silent(model, known)
    return StatePublisher(node, model, f"{prefix}/" if prefix else "", topic, silent)


def _joints_heard(
    topic: str,
    launched: Launched,
    topics: Sequence[NodeTopics],
    starts: Mapping[str, DryStart],
) -> frozenset[str] | None:
    """Return the joints whose states come on a topic; None when a node may send any."""
    names: set[str] = set()
    for item in topics:
        node = item.node
        if node.role is Role.VIEW:
            continue
        if not item.is_complete and item.known is None:
            return None
        if topic not in item.publishes:
            continue
        if node.role is Role.JOINT_STATES:
            text = launched.description(node)
            names |= _joints_in(text) if text is not None else set()
        elif node.role is Role.SIMULATOR:
            names |= starts[node.full_name].joint_states.get(topic, frozenset())
        elif item.joints:
            names |= item.joints
        else:
            return None
    return frozenset(names)


def _joints_in(text: str) -> set[str]:
    try:
        return {joint.name for joint in read_description(text).joints}
    except LaunchError:
        return set()


def _silent(model: Model, known: frozenset[str]) -> tuple[Joint, ...]:
    return tuple(
        joint
        for joint in model.joints
        if joint.type in _MOVING
        and joint.name not in known
        and not (joint.mimic is not None and joint.mimic.joint in known)
    )


def _edges_of(publisher: StatePublisher) -> list[Edge]:
    silent = {joint.name for joint in publisher.silent or ()}
    return [
        Edge(
            f"{publisher.prefix}{joint.parent}",
            f"{publisher.prefix}{joint.child}",
            publisher.node.full_name,
            "static" if joint.type is JointType.FIXED else f"joint {joint.name}",
            publisher.node.spec.span,
        )
        for joint in publisher.model.joints
        if joint.name not in silent
    ]


def _static_edges(node: LaunchedNode, diagnostics: Diagnostics) -> list[Edge]:
    try:
        found = parse_arguments(node.program.argv, with_period=node.spec.package == "tf")
    except LaunchError as error:
        text = f"'{node.full_name}' ends at once: {error}"
        diagnostics.report("doctor.bad-arguments", text, node.spec.span)
        return []
    names = (found.frame_id.lstrip("/"), found.child_frame_id.lstrip("/"))
    return [Edge(*names, node.full_name, "static", node.spec.span)]


def _simulated_edges(node: LaunchedNode, start: DryStart) -> list[Edge]:
    return [
        Edge(parent, child, node.full_name, "static" if is_static else "moving", node.spec.span)
        for (parent, child), is_static in start.transforms.items()
    ]


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
                tag = frame_tag(plugin)
                name = tag.text.strip().lstrip("/") if tag is not None else ""
                prefixed = {f"{item.prefix}{name}" for item in mine}
                if tag is None or not name or name in known or prefixed & known:
                    continue
                if frame_slip(name, model):
                    continue  # that is told of the robot as such
                text = f"sensor '{sensor.name}' on link '{link.name}' stamps its data with frame "
                text += f"'{name}', which no tf leads to"
                fix = f"write <{tag.name}>{link.name}</{tag.name}>"
                diagnostics.report("doctor.sensor-frame", text, tag.span, fix=fix)
