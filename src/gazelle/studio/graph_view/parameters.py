"""Parameters: the store of ROS 1 and the parameter services of ROS 2 nodes."""

from __future__ import annotations

from typing import Any, TypedDict

from gazelle.graph import Graph, Node
from gazelle.graph.ros2_parameter_values import ParameterType, value_from_message, value_message
from gazelle.interfaces import message_type
from gazelle.parameters.trees import leaves_at, values_only
from gazelle.studio.errors import StudioError, unknown
from gazelle.studio.graph_view.services import request_response, services_by_type
from gazelle.studio.json_text import finite_number, message_value
from gazelle.studio.request_params import Params

__all__ = [
    "NodeParameter",
    "ParameterDescriptor",
    "ParameterRow",
    "delete_parameter",
    "get_node_parameters",
    "get_parameter",
    "list_parameters",
    "set_node_parameter",
    "set_parameter",
]

_LIST = "rcl_interfaces/srv/ListParameters"
_GET = "rcl_interfaces/srv/GetParameters"
_DESCRIBE = "rcl_interfaces/srv/DescribeParameters"
_SET = "rcl_interfaces/srv/SetParameters"
_RANGES = ("floating_point_range", "integer_range")


class ParameterRow(TypedDict):
    """A parameter of ROS 1."""

    name: str
    value: Any


class ParameterDescriptor(TypedDict):
    """What a node of ROS 2 says of a parameter.

    Attributes:
        range: with `from_value`, `to_value` and `step`, or null.
    """

    description: str
    read_only: bool
    constraints: str
    range: Any


class NodeParameter(TypedDict):
    """A parameter of a node of ROS 2."""

    name: str
    value: Any
    type: str
    descriptor: ParameterDescriptor


def list_parameters(node: Node, params: Params) -> list[ParameterRow]:
    """``param.list``: names and values below a namespace, all by default."""
    tree = _value(node.graph, params.text("name", "/"))
    start = params.text("name", "/").rstrip("/")
    leaves = sorted(values_only(leaves_at(start, tree)), key=lambda leaf: leaf[0].split("/"))
    return [{"name": name, "value": value} for name, value in leaves]


def get_parameter(node: Node, params: Params) -> Any:
    """``param.get``."""
    return _value(node.graph, params.text("name"))


def set_parameter(node: Node, params: Params) -> dict[str, Any]:
    """``param.set``."""
    if "value" not in params.values:
        raise StudioError(f"{params.where}: parameter 'value' is missing")
    node.graph.parameters.set(params.text("name"), params.values["value"])
    return {}


def delete_parameter(node: Node, params: Params) -> dict[str, Any]:
    """``param.delete``."""
    name = params.text("name")
    try:
        node.graph.parameters.delete(name)
    except KeyError:
        raise unknown("parameter", name, node.graph.parameters.names()) from None
    return {}


def get_node_parameters(node: Node, params: Params) -> list[NodeParameter]:
    """``node.params`` of a ROS 2 node."""
    target = _target(node, params)
    listed = request_response(node, f"{target}/list_parameters", _LIST)
    names = sorted(listed.result.names)
    values = request_response(node, f"{target}/get_parameters", _GET, names=names).values
    told = request_response(node, f"{target}/describe_parameters", _DESCRIBE, names=names)
    rows = zip(names, values, told.descriptors, strict=False)
    return [_row(name, value, descriptor) for name, value, descriptor in rows]


def set_node_parameter(node: Node, params: Params) -> dict[str, Any]:
    """``node.param_set``; a whole number becomes a double where the node has one."""
    target, name = _target(node, params), params.text("name")
    present = request_response(node, f"{target}/get_parameters", _GET, names=[name]).values
    value = _fitting(params.values.get("value"), present[0].type if present else 0)
    row = message_type("rcl_interfaces/msg/Parameter")(name=name, value=value_message(value))
    answer = request_response(node, f"{target}/set_parameters", _SET, parameters=[row]).results
    if not answer:
        raise StudioError(f"{target} gave no answer for parameter '{name}'")
    return {"successful": bool(answer[0].successful), "reason": answer[0].reason}


def _target(node: Node, params: Params) -> str:
    target = node.resolve_name(params.text("node"))
    offering = services_by_type(node.graph, _LIST)
    if f"{target}/list_parameters" not in offering:
        nodes = [name.removesuffix("/list_parameters") for name in offering]
        raise unknown("ROS 2 node with parameters", target, nodes)
    return target


def _row(name: str, value: Any, descriptor: Any) -> NodeParameter:
    told = message_value(descriptor)
    limits = next((told[key][0] for key in _RANGES if told.get(key)), None)
    return {
        "name": name,
        "value": message_value(value_from_message(value)),
        "type": ParameterType(value.type).word,
        "descriptor": {
            "description": told["description"],
            "read_only": told["read_only"],
            "constraints": told["additional_constraints"],
            "range": limits,
        },
    }


def _fitting(value: Any, present: int) -> Any:
    if present == ParameterType.DOUBLE:
        return _double(value)
    if present == ParameterType.DOUBLE_ARRAY and isinstance(value, list):
        return [_double(item) for item in value]
    return value


def _double(value: Any) -> Any:
    number = finite_number(value)
    return value if number is None else number


def _value(graph: Graph, name: str) -> Any:
    try:
        return graph.parameters.get(name)
    except KeyError:
        raise unknown("parameter", name, graph.parameters.names()) from None
