"""The frames of tf that a launch will have, and who publishes each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from gazelle.description.model import Joint, JointType, Model
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.doctor.dry_start import DryStart
from gazelle.doctor.launch_ros1.launched_nodes import Launched, LaunchedNode, Role
from gazelle.doctor.launch_ros1.script_reading import read_script
from gazelle.doctor.launch_ros1.topics import NodeTopics
from gazelle.errors import LaunchError
from gazelle.nodes.robot_description import read_description
from gazelle.nodes.static_transform_publisher import parse_arguments

__all__ = ["Edge", "Frames", "StatePublisher", "frames_of"]

_MOVING = frozenset(set(JointType) - {JointType.FIXED})


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
        found = parse_arguments(node.program.words, with_period=node.spec.package == "tf")
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
