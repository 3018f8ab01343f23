"""``ros_gz_sim/remove``: takes a model out of the running world."""

from __future__ import annotations

import threading
from typing import Any

from gazelle.errors import GazelleError
from gazelle.graph import Graph, Node
from gazelle.graph.gazebo_names import offered_name
from gazelle.interfaces import service_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import private_parameters, start_node
from gazelle.parameters import Parameter, ParameterTable

__all__ = ["PARAMETERS", "run"]

PARAMETERS = ParameterTable(
    "remove",
    "Takes a model out of the running world, and ends.",
    ("ros_gz_sim/remove",),
    (
        Parameter("entity_name", "text", "", "the model's name"),
        Parameter("world", "text", "", "the world's name, of which there is one"),
    ),
)

_SERVICE = "/gazebo/delete_model"
_WAIT_S = 5.0
_NO_NAME = 255


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Remove a model, say how it went, and end."""
    node = start_node(arguments, graph)
    try:
        with private_parameters(node, arguments, PARAMETERS) as own:
            name = own.text("entity_name")
        if not name:
            node.log("info", "Entity to remove name is not provided, entity will not be removed.")
            return _NO_NAME
        return _remove(node, name, stop)
    except GazelleError as error:
        node.log("error", str(error))
        return 1
    finally:
        node.shutdown()


def _remove(node: Node, name: str, stop: threading.Event) -> int:
    kind: Any = service_type("gazebo_msgs/DeleteModel")
    while True:
        client = node.create_client(offered_name(node.graph, _SERVICE, _WAIT_S), kind)
        if client.available:
            break
        client.unregister()
        if stop.is_set():
            node.log("info", "Entity removal was interrupted.")
            return 1
        node.log("warn", f"Waiting for service [{_SERVICE}] to become available ...")
    answer = client.call(kind.Request(model_name=name))
    if not answer.success:
        node.log("error", f"Entity removal failed.\n {answer.status_message}")
        return 1
    node.log("info", "Entity removal successful.")
    return 0
