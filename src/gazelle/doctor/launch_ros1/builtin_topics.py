"""Topics, joint states and transforms of built-in nodes, by their rows and their parameters."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from gazelle.doctor.launch_ros1.launched_nodes import Launched, LaunchedNode
from gazelle.graph.names import resolve
from gazelle.node_specs.patterns import ValueOf, expanded, holds
from gazelle.node_specs.spec import Direction, Interface, NodeSpec

__all__ = ["BuiltinTopics", "builtin_topics"]

_EKF = frozenset({"ekf_localization_node", "ekf_node"})


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
        _named(_of(rows, Direction.GIVES), node, spec, value_of),
        _named(_of(rows, Direction.TAKES), node, spec, value_of),
        frozenset(_global(name, node) for name in (*names, *spec.namespaces)),
        _transforms(spec, node, launched, value_of),
        None if spec.joints is None else frozenset(expanded(one, value_of) for one in spec.joints),
        spec.is_complete,
    )


def _of(rows: Iterable[Interface], direction: Direction) -> list[Interface]:
    return [row for row in rows if row.direction is direction]


def _named(
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
