"""Which topics the nodes of a launch use: tables for known nodes, reading for users' scripts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from gazelle.doctor.dry_start import DryStart
from gazelle.doctor.launch_ros1.launched_nodes import Launched, LaunchedNode, Role
from gazelle.doctor.script_topics import TopicEnd, TopicUse, read_script
from gazelle.graph.names import resolve
from gazelle.node_specs.parameter_substitution import ValueOf, expanded, holds
from gazelle.node_specs.registry import node_specs
from gazelle.node_specs.spec import Direction, Interface, NodeSpec
from gazelle.node_specs.unavailable_packages import Sends, what_it_sends

__all__ = [
    "BuiltinTopics",
    "KnownNode",
    "NodeTopics",
    "builtin_topics",
    "topics_of",
]

_EKF = frozenset({"ekf_localization_node", "ekf_node"})
_JOINT_STATE = "sensor_msgs/msg/JointState"


@dataclass(frozen=True, slots=True)
class BuiltinTopics:
    """What one node has.

    Attributes:
        publishes, listens: types by global topic, after remapping; a type may be empty.
        written: names before remapping that its code uses, global.
        transforms: parent and child of each it sends; None when they cannot be told.
        joints: whose states it sends; None when they cannot be told.
        is_complete: there are no further topics.
    """

    publishes: Mapping[str, str]
    listens: Mapping[str, str]
    written: frozenset[str]
    transforms: tuple[tuple[str, str], ...] | None
    joints: frozenset[str] | None
    is_complete: bool


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
        uses: topics of a script, with their places.
    """

    node: LaunchedNode
    publishes: Mapping[str, str]
    listens: Mapping[str, str]
    written: frozenset[str]
    is_complete: bool = True
    known: KnownNode | None = None
    joints: frozenset[str] = frozenset()
    uses: tuple[TopicUse, ...] = ()

    def ends(self) -> list[TopicEnd]:
        """Return what is known as ends of topics."""
        node = self.node
        if self.uses:
            return [
                TopicEnd(node.full_name, node.resolve(use.name), use.type, use.publishes, use)
                for use in self.uses
            ]
        gives = [TopicEnd(node.full_name, *item, True) for item in self.publishes.items()]
        return gives + [TopicEnd(node.full_name, *item, False) for item in self.listens.items()]


def builtin_topics(node: LaunchedNode, launched: Launched) -> BuiltinTopics | None:
    """Return what a built-in node has; None for other nodes."""
    spec = node.executable.builtin if node.executable is not None else None
    if spec is None:
        return None

    def value_of(name: str, default: str) -> str:
        full = name if name.startswith("~") else node.resolve(name)
        full = resolve(full, node.program.namespace, node=node.full_name)
        has_own = launched.parameters.has(full)
        return str(launched.parameters.get(full)) if has_own else default

    rows = [row for row in spec.topics if holds(row.when, value_of)]
    others = (*spec.services, *spec.actions)
    names = [expanded(row.name, value_of) for row in (*rows, *others)]
    return BuiltinTopics(
        _by_topic(_of(rows, Direction.GIVES), node, spec, value_of),
        _by_topic(_of(rows, Direction.TAKES), node, spec, value_of),
        frozenset(_global(name, node) for name in (*names, *spec.namespaces)),
        _transforms(spec, node, launched, value_of),
        None if spec.joints is None else frozenset(expanded(one, value_of) for one in spec.joints),
        spec.is_complete,
    )


def topics_of(launched: Launched, starts: Mapping[str, DryStart]) -> tuple[NodeTopics, ...]:
    """Return what is known of every node's topics.

    Args:
        launched: the launch.
        starts: simulators that came up, by global name of their node.
    """
    return tuple(_topics(node, launched, starts) for node in launched.nodes)


def _of(rows: Iterable[Interface], direction: Direction) -> list[Interface]:
    return [row for row in rows if row.direction is direction]


def _by_topic(
    rows: Iterable[Interface], node: LaunchedNode, spec: NodeSpec, value_of: ValueOf
) -> dict[str, str]:
    return {_remapped(expanded(row.name, value_of), node, spec): row.type for row in rows}


def _remapped(name: str, node: LaunchedNode, spec: NodeSpec) -> str:
    """Return the global name of a topic; a namespace that is remapped by itself comes first."""
    first, _, rest = name.partition("/")
    return node.resolve(f"{node.resolve(first)}/{rest}" if first in spec.namespaces else name)


def _global(name: str, node: LaunchedNode) -> str:
    return resolve(name, node.program.namespace, node=node.full_name)


def _transforms(
    spec: NodeSpec, node: LaunchedNode, launched: Launched, value_of: ValueOf
) -> tuple[tuple[str, str], ...] | None:
    if spec.executable in _EKF:
        return _filtered(node, launched)
    if spec.frames is None:
        return None
    return tuple(
        (expanded(row.parent, value_of).strip("/"), expanded(row.child, value_of).strip("/"))
        for row in spec.frames
        if holds(row.when, value_of)
    )


def _filtered(node: LaunchedNode, launched: Launched) -> tuple[tuple[str, str], ...]:
    """Return what a filter of robot_localization sends, by REP 105 from its world frame."""

    def frame(name: str, default: str) -> str:
        return str(launched.private(node, name, default)).strip("/")

    if launched.private(node, "publish_tf", True) is False:
        return ()
    odom = frame("odom_frame", "odom")
    world = frame("world_frame", odom)
    base = frame("base_link_frame", "base_link")
    return ((world, odom if world == frame("map_frame", "map") else base),)


def _topics(node: LaunchedNode, launched: Launched, starts: Mapping[str, DryStart]) -> NodeTopics:
    match node.role:
        case Role.SIMULATOR:
            return _of_simulator(node, starts.get(node.full_name))
        case Role.SCRIPT if node.file is not None:
            script = read_script(node.file)
            known = _named(node, script.publishes, script.listens, script.is_complete)
            return replace(known, uses=script.uses)
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
    sent = _elsewhere(node)
    return NodeTopics(node, {}, {}, frozenset(), is_complete=False, known=sent)


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
    namespace, own = node.program.namespace, node.full_name
    written = frozenset(resolve(name, namespace, node=own) for name in (*publishes, *listens))
    return NodeTopics(
        node,
        {node.resolve(name): kind for name, kind in publishes.items()},
        {node.resolve(name): kind for name, kind in listens.items()},
        written,
        is_complete,
    )


def _of_relay(node: LaunchedNode) -> NodeTopics:
    argv = [word for word in node.program.argv if word != "messages"]
    if not argv:
        return NodeTopics(node, {}, {}, frozenset(), is_complete=False)
    last = argv[-1]
    is_number = last.replace(".", "", 1).isdigit()
    target = last if len(argv) > 1 and not is_number else f"{argv[0]}_{node.spec.type}"
    return _named(node, {target: ""}, {argv[0]: ""})


def _of_simulator(node: LaunchedNode, start: DryStart | None) -> NodeTopics:
    if start is None:
        return NodeTopics(node, {}, {}, frozenset(), is_complete=False)
    own = start.node
    return NodeTopics(node, own.offered, own.heard, frozenset(own.asked))
