"""Parameters of both generations, as viewers read, set and follow them.

Those of ROS 2 nodes have names such as ``/talker.rate``, as Foxglove's bridge has them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

from gazelle.errors import GazelleError, GraphError
from gazelle.graph import Kind
from gazelle.graph.callback_queue import CallbackQueue
from gazelle.graph.names import check_name, resolve
from gazelle.graph.ros2_parameter_values import value_from_message, value_message
from gazelle.interfaces import message_type, service_type
from gazelle.parameters.trees import leaves_at, values_only

if TYPE_CHECKING:
    from gazelle.graph import Graph, Node, ParameterStore

__all__ = ["NodeParameters", "Parameters", "plain_value"]

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


def plain_value(value: Any) -> Any:
    """Return a parameter's value in types that the protocol has; dates and nan become text."""
    if isinstance(value, dict):
        return {str(name): plain_value(one) for name, one in value.items()}
    if isinstance(value, list | tuple):
        return [plain_value(one) for one in value]
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    if value is None or isinstance(value, bool | int | float | str | bytes):
        return value
    return str(value)


class Parameters:
    """The tree's by global name, single values without namespaces; those of ROS 2's nodes."""

    def __init__(
        self, store: ParameterStore, nodes: NodeParameters, notice: Callable[[str], None]
    ) -> None:
        """Wrap both.

        Args:
            store: the tree.
            nodes: asks nodes of ROS 2.
            notice: told what cannot be set.
        """
        self._store = store
        self._nodes = nodes
        self._notice = notice
        self._changes: CallbackQueue | None = None

    def follow(self, tell: Callable[[Mapping[str, Any]], None]) -> None:
        """Call back with what changes from now on; None for what is not set any more."""
        before = self._tree()

        def tell_changes(_name: str) -> None:
            nonlocal before
            now = self._tree()
            changes = {k: v for k, v in now.items() if k not in before or before[k] != v}
            changes |= dict.fromkeys(before.keys() - now.keys())
            before = now
            if changes:
                tell(changes)

        # The store waits for its listeners, and so may the server for the store.
        self._changes = CallbackQueue(tell_changes, size=1, name="foxglove parameters")
        self._store.on_change(self._changes.put)
        self._nodes.follow(tell)

    def close(self) -> None:
        """Tell of no changes any more."""
        if self._changes is not None:
            self._changes.close()

    def get(self, names: Iterable[str]) -> dict[str, Any]:
        """Return values by name, all of them without names."""
        wanted = list(names)
        known = self._tree()
        if not wanted:
            return known | self._nodes.get(())
        of_nodes = [name for name in wanted if self._nodes.knows(name)]
        known |= self._nodes.get(of_nodes) if of_nodes else {}
        return {name: known[name] for name in wanted if name in known}

    def set(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """Set values, delete those that are None; return what they are afterwards."""
        for name, value in values.items():
            try:
                self._set(name, value)
            except GazelleError as error:
                self._notice(f"a viewer cannot set parameter {name}: {error}")
            except KeyError:
                self._notice(f"a viewer cannot delete parameter {name}: it is not set")
        known = self.get(values)
        return {name: known.get(name) for name in values}

    def _tree(self) -> dict[str, Any]:
        return dict(values_only(leaves_at("/", self._store.get_cached("/", {}))))

    def _set(self, name: str, value: Any) -> None:
        if self._nodes.knows(name):
            self._nodes.set(name, value)
            return
        full = resolve(check_name(name, "parameter name"))
        if full == "/":
            raise GraphError("that is the whole tree; set its parameters one by one")
        if value is None:
            self._store.delete(full)
        else:
            self._store.set(full, value)
