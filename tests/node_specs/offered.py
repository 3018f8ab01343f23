"""What a running node has on a graph, in the words of its row."""

from __future__ import annotations

from typing import NamedTuple

from gazelle.graph.graph_info import NodeInfo
from gazelle.node_specs.parameter_substitution import expanded, holds
from gazelle.node_specs.spec import Direction, Interface, NodeSpec

GIVES, TAKES = Direction.GIVES, Direction.TAKES
# Every node has these, or every node with parameters that change while it runs.
_EVERYBODYS = frozenset(
    {
        "describe_parameters", "get_loggers", "get_parameter_types", "get_parameters",
        "list_parameters", "parameter_descriptions", "parameter_updates", "set_logger_level",
        "set_parameters", "set_parameters_atomically",
    }
)  # fmt: skip
_OF_ALL = frozenset({(GIVES, "/rosout"), (GIVES, "/parameter_events"), (TAKES, "/clock")})
_OF_GOALS = frozenset({"goal", "cancel", "feedback", "result", "status"})
_GOAL_SERVICE, _GOAL_TOPIC = "/_action/send_goal", "ActionGoal"
_OTHER_SIDE = {GIVES: TAKES, TAKES: GIVES}


class Offered(NamedTuple):
    """Directions, names as the node's code says them, and types."""

    topics: frozenset[tuple[Direction, str, str]]
    services: frozenset[tuple[Direction, str, str]]
    actions: frozenset[tuple[Direction, str, str]]

    def minus(self, other: Offered) -> list[str]:
        """Return what is here and not there, for people."""
        pairs = zip(self._fields, self, other, strict=True)
        return [
            f"{field}: {name} {kind} ({direction.value})"
            for field, own, others in pairs
            for direction, name, kind in sorted(own - others, key=lambda row: row[1:])
        ]


def offered_by_row(spec: NodeSpec) -> Offered:
    """Return what a node's row says, with every parameter at its default."""

    def default(_name: str, value: str) -> str:
        return value

    def rows(items: tuple[Interface, ...]) -> frozenset[tuple[Direction, str, str]]:
        return frozenset(
            (item.direction, expanded(item.name, default), item.type)
            for item in items
            if holds(item.when, default)
        )

    return Offered(rows(spec.topics), rows(spec.services), rows(spec.actions))


def offered_by_node(info: NodeInfo, namespace: str) -> Offered:
    """Return what a node has; what all nodes have, and hidden names, are left out."""
    topics = [(GIVES, *one) for one in info.publications]
    topics += [(TAKES, *one) for one in info.subscriptions]
    services = [(GIVES, *one) for one in info.services]
    services += [(TAKES, *one) for one in info.clients]

    def said(rows: list[tuple[Direction, str, str]]) -> set[tuple[Direction, str, str]]:
        return {
            (direction, _as_said(name, info.name, namespace), "" if kind == "*" else kind)
            for direction, name, kind in rows
        }

    actions = {
        (direction, name.removesuffix(_GOAL_SERVICE), kind.removesuffix("_SendGoal"))
        for direction, name, kind in said(services)
        if name.endswith(_GOAL_SERVICE)
    }
    actions |= {
        (
            _OTHER_SIDE[direction],
            name.removesuffix("goal").removesuffix("/") or "~",
            kind.replace("/msg/", "/action/").removesuffix(_GOAL_TOPIC),
        )
        for direction, name, kind in said(topics)
        if kind.endswith(_GOAL_TOPIC)
    }
    names = [name for _direction, name, _kind in actions]
    return Offered(
        frozenset(row for row in said(topics) if _is_own(row, names)),
        frozenset(row for row in said(services) if _is_own(row, names)),
        frozenset(actions),
    )


def _as_said(name: str, node: str, namespace: str) -> str:
    if name.startswith(f"{node}/"):
        return f"~{name.removeprefix(f'{node}/')}"
    return name.removeprefix(f"{namespace}/")


def _is_own(row: tuple[Direction, str, str], actions: list[str]) -> bool:
    direction, name, _kind = row
    parts = name.lstrip("~").split("/")
    if (direction, name) in _OF_ALL or parts[-1] in _EVERYBODYS:
        return False
    if any(part.startswith("_") for part in parts):
        return False
    return not any(
        name.startswith(action) and name.removeprefix(action).lstrip("/") in _OF_GOALS
        for action in actions
    )
