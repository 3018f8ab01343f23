"""Parameters of a node in another process."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from gazelle.cli.tool import ToolError, hint
from gazelle.graph import Graph, Node
from gazelle.graph.ros2_parameter_values import ParameterType, value_from_message, value_message
from gazelle.interfaces import message_type, service_type

__all__ = ["RemoteParameters", "nodes_with_parameters", "remote"]

_MARK = "/list_parameters"
_TIMEOUT_S = 10.0


def nodes_with_parameters(graph: Graph) -> list[str]:
    """Return the global names of the nodes that offer parameters."""
    names = {one.name for one in graph.services(include_hidden=True)}
    return sorted(name.removesuffix(_MARK) for name in names if name.endswith(_MARK))


def remote(graph: Graph, node: str) -> RemoteParameters:
    """Return access to a node's parameters.

    Raises:
        ToolError: there is no such node, with the nearest names.
    """
    name = "/" + node.strip("/")
    there = nodes_with_parameters(graph)
    if name not in there:
        raise ToolError(f"Node not found: '{name}' offers no parameters{hint(name, there)}")
    return RemoteParameters(graph.create_node("ros2cli", anonymous=True, rosout=False), name)


class RemoteParameters:
    """Calls the parameter services of one node."""

    def __init__(self, node: Node, name: str) -> None:
        """Use `remote`."""
        self.node = name
        self._node = node

    def names(self, prefixes: Sequence[str]) -> list[str]:
        """Return the names of the parameters."""
        found = self._call("list_parameters", "ListParameters", prefixes=list(prefixes))
        return sorted(found.result.names)

    def get(self, name: str) -> Any:
        """Return one value, None when it is not set."""
        return self.get_all([name])[0]

    def get_all(self, names: Sequence[str]) -> list[Any]:
        """Return values."""
        found = self._call("get_parameters", "GetParameters", names=list(names))
        return [value_from_message(item) for item in found.values]

    def types(self, names: Sequence[str]) -> list[ParameterType]:
        """Return types."""
        found = self._call("get_parameter_types", "GetParameterTypes", names=list(names))
        return [ParameterType(item) for item in found.types]

    def describe(self, names: Sequence[str]) -> list[Any]:
        """Return ``ParameterDescriptor`` messages."""
        found = self._call("describe_parameters", "DescribeParameters", names=list(names))
        return list(found.descriptors)

    def set(self, values: Mapping[str, Any]) -> list[str]:
        """Set values; return why each is refused, empty when it is not."""
        parameter = message_type("rcl_interfaces/Parameter")
        rows = [parameter(name=name, value=value_message(v)) for name, v in values.items()]
        found = self._call("set_parameters", "SetParameters", parameters=rows)
        return [
            "" if row.successful else (row.reason or "no reason given") for row in found.results
        ]

    def _call(self, name: str, kind: str, **fields: Any) -> Any:
        service = service_type(f"rcl_interfaces/{kind}")
        client = self._node.create_client(f"{self.node}/{name}", service)
        return client.call(service.Request(**fields), timeout_s=_TIMEOUT_S)
