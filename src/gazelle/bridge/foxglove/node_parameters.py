"""Parameters of ROS 2 nodes under names such as ``/talker.rate``, as Foxglove's bridge has them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

from gazelle.errors import GazelleError, GraphError
from gazelle.graph import Kind
from gazelle.graph.ros2_parameter_values import value_from_message, value_message
from gazelle.interfaces import message_type, service_type

if TYPE_CHECKING:
    from gazelle.graph import Graph, Node

__all__ = ["NodeParameters"]

_MARK = "/get_parameters"
_EVENTS = "/parameter_events"
_EVENT = "rcl_interfaces/msg/ParameterEvent"
_CALL_S = 2.0
_AT_ONCE = 8


class NodeParameters:
    """Asks each node for its own."""

    def __init__(self, graph: Graph, node: Node, notice: Callable[[str], None]) -> None:
        """Ask nobody yet.

        Args:
            graph: knows the nodes.
            node: asks them.
            notice: told of nodes that do not answer.
        """
        self._graph = graph
        self._node = node
        self._notice = notice

    def follow(self, tell: Callable[[Mapping[str, Any]], None]) -> None:
        """Call back with what changes from now on; None for what is not set any more."""

        def on_event(event: Any) -> None:
            told = [*event.new_parameters, *event.changed_parameters]
            values = {f"{event.node}.{one.name}": value_from_message(one.value) for one in told}
            gone = [f"{event.node}.{one.name}" for one in event.deleted_parameters]
            tell(values | dict.fromkeys(gone))

        self._node.create_subscription(_EVENTS, _EVENT, on_event)

    def _nodes(self) -> frozenset[str]:
        known = self._graph.discovery.known()
        return frozenset(
            one.name.removesuffix(_MARK)
            for one in known
            if one.kind is Kind.SERVICE and one.name.endswith(_MARK)
        )

    def knows(self, name: str) -> bool:
        """Return whether a name belongs to a parameter of a node that is there."""
        node, dot, _ = name.partition(".")
        return bool(dot) and node in self._nodes()

    def get(self, names: Iterable[str]) -> dict[str, Any]:
        """Return values by name, all of them without names."""
        wanted = list(names)
        asked = frozenset(name.partition(".")[0] for name in wanted)
        owners = self._nodes() & asked if wanted else self._nodes()
        found: dict[str, Any] = {}
        with ThreadPoolExecutor(_AT_ONCE, thread_name_prefix="foxglove parameters") as workers:
            for values in workers.map(self._all_of, sorted(owners)):
                found |= values
        return {name: found[name] for name in wanted if name in found} if wanted else found

    def set(self, name: str, value: Any) -> None:
        """Set one value; None unsets it.

        Raises:
            GraphError: the node refuses, or does not answer.
        """
        node, _, own = name.partition(".")
        before = self._values(node, [own])
        if isinstance(value, int) and not isinstance(value, bool) and isinstance(before[0], float):
            # A viewer writes 2 for 2.0, which ROS 2 keeps apart.
            value = float(value)
        row = message_type("rcl_interfaces/msg/Parameter")(name=own, value=value_message(value))
        result = self._call(node, "set_parameters", "SetParameters", parameters=[row]).results[0]
        if not result.successful:
            raise GraphError(result.reason or "the node gives no reason")

    def _all_of(self, node: str) -> dict[str, Any]:
        try:
            names = list(self._call(node, "list_parameters", "ListParameters").result.names)
            values = self._values(node, names)
        except GazelleError as error:
            self._notice(f"parameters of {node} are not shown: {error}")
            return {}
        pairs = zip(names, values, strict=True)
        return {f"{node}.{name}": value for name, value in pairs if value is not None}

    def _values(self, node: str, names: list[str]) -> list[Any]:
        found = self._call(node, "get_parameters", "GetParameters", names=names).values
        return [value_from_message(one) for one in found]

    def _call(self, node: str, name: str, kind: str, **fields: Any) -> Any:
        service = service_type(f"rcl_interfaces/srv/{kind}")
        client = self._node.create_client(f"{node}/{name}", service)
        try:
            return client.call(service.Request(**fields), _CALL_S)
        finally:
            client.unregister()
