"""Which topics the nodes of a launch use: tables for known nodes, reading for users' scripts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from gazelle.doctor.dry_start import DryStart
from gazelle.doctor.launch_ros1.builtin_topics import builtin_topics
from gazelle.doctor.launch_ros1.launched_nodes import Launched, LaunchedNode, Role
from gazelle.doctor.launch_ros1.script_reading import read_script
from gazelle.graph.names import resolve
from gazelle.node_specs.registry import node_specs
from gazelle.node_specs.unavailable_package_rows import Sends
from gazelle.node_specs.unavailable_packages import what_it_sends

__all__ = ["KnownNode", "NodeTopics", "topics_of"]

_JOINT_STATE = "sensor_msgs/msg/JointState"


@dataclass(frozen=True, slots=True)
class KnownNode:
    """A node that sends no joint states, or known ones.

    Attributes:
        transforms: parent and child of each it sends; None when they cannot be told.
    """

    transforms: tuple[tuple[str, str], ...] | None = ()


@dataclass(frozen=True, slots=True)
class NodeTopics:
    """Topics of one node by global name, with types; a type may be empty.

    Attributes:
        node: whose.
        publishes, listens: after remapping.
        written: names before remapping that its code uses, global.
        is_complete: the node surely uses no others.
        known: what is known of joint states and tf of a node whose topics are not.
        joints: whose states a built-in node sends, where it always sends the same.
    """

    node: LaunchedNode
    publishes: Mapping[str, str]
    listens: Mapping[str, str]
    written: frozenset[str]
    is_complete: bool = True
    known: KnownNode | None = None
    joints: frozenset[str] = frozenset()


def topics_of(launched: Launched, starts: Mapping[str, DryStart]) -> tuple[NodeTopics, ...]:
    """Return what is known of every node's topics.

    Args:
        launched: the launch.
        starts: simulators that came up, by global name of their node.
    """
    return tuple(_topics(node, launched, starts) for node in launched.nodes)


def _topics(node: LaunchedNode, launched: Launched, starts: Mapping[str, DryStart]) -> NodeTopics:
    match node.role:
        case Role.SIMULATOR:
            return _of_simulator(node, starts.get(node.full_name))
        case Role.SCRIPT if node.file is not None:
            script = read_script(node.file)
            return _named(node, dict(script.publishes), dict(script.listens), script.is_complete)
        case Role.JOINT_STATES:
            sources = launched.private(node, "source_list", [])
            names = sources if isinstance(sources, list) else []
            listens = {name: _JOINT_STATE for name in names if isinstance(name, str)}
            return _named(node, {"joint_states": _JOINT_STATE}, listens)
        case Role.RELAY:
            return _of_relay(node)
    builtin = builtin_topics(node, launched)
    if builtin is not None:
        return NodeTopics(
            node,
            builtin.publishes,
            builtin.listens,
            builtin.written,
            builtin.is_complete,
            KnownNode(builtin.transforms) if builtin.joints is not None else None,
            builtin.joints or frozenset(),
        )
    known = _elsewhere(node)
    return NodeTopics(node, {}, {}, frozenset(), is_complete=False, known=known)


def _elsewhere(node: LaunchedNode) -> KnownNode | None:
    """Return what is known of a node of ROS that is not here; None when it may send anything.

    All of its topics are not listed, so nothing is said of remaps and topics.
    """
    package = [spec for spec in node_specs() if spec.package == node.spec.package]
    if package and all(spec.frames == () and spec.joints == () for spec in package):
        # A program that its package does not have: none of its others sends anything.
        return KnownNode()
    match what_it_sends(node.spec.package, node.spec.type):
        case Sends.NOTHING:
            return KnownNode()
        case Sends.TRANSFORMS:
            return KnownNode(None)
        case Sends.ANYTHING:
            return None


def _named(
    node: LaunchedNode,
    publishes: Mapping[str, str],
    listens: Mapping[str, str],
    is_complete: bool = True,
) -> NodeTopics:
    place, own = node.program.namespace, node.full_name
    written = frozenset(resolve(name, place, node=own) for name in (*publishes, *listens))
    return NodeTopics(
        node,
        {node.resolve(name): kind for name, kind in publishes.items()},
        {node.resolve(name): kind for name, kind in listens.items()},
        written,
        is_complete,
    )


def _of_relay(node: LaunchedNode) -> NodeTopics:
    words = [word for word in node.program.words if word != "messages"]
    if not words:
        return NodeTopics(node, {}, {}, frozenset(), is_complete=False)
    last = words[-1]
    is_number = last.replace(".", "", 1).isdigit()
    target = last if len(words) > 1 and not is_number else f"{words[0]}_{node.spec.type}"
    return _named(node, {target: ""}, {words[0]: ""})


def _of_simulator(node: LaunchedNode, start: DryStart | None) -> NodeTopics:
    if start is None:
        return NodeTopics(node, {}, {}, frozenset(), is_complete=False)
    own = start.node
    return NodeTopics(node, own.offered, own.heard, frozenset(own.asked))
