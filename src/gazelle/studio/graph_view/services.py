"""``service.call``, and calls of services that other methods make."""

from __future__ import annotations

from typing import Any

from gazelle.errors import GazelleError
from gazelle.graph import Graph, Kind, Node
from gazelle.interfaces import service_type
from gazelle.studio.errors import StudioError, unknown
from gazelle.studio.graph_view.message_forms import filled
from gazelle.studio.json_text import message_value
from gazelle.studio.request_params import Params

__all__ = ["call_service", "request_response", "services_by_type"]

_TIMEOUT_S = 10.0
_MAX_DURATION_S = 3600.0


def call_service(node: Node, params: Params) -> Any:
    """``service.call``: the response as an object."""
    name = node.resolve_name(params.text("service"))
    type_name = params.text("type", "") or _type_of(node.graph, name)
    kind = service_type(type_name)
    values = params.any("request", {})
    request = filled(kind.Request, values, node.clock.now_ns())
    timeout_s = params.number("timeout_s", _TIMEOUT_S, least=0.01, most=_MAX_DURATION_S)
    client = node.create_client(name, kind)
    try:
        return message_value(client.call(request, timeout_s))
    finally:
        client.unregister()


def request_response(node: Node, name: str, type_name: str, **fields: Any) -> Any:
    """Call a service with fields that fit and return the response.

    Raises:
        StudioError: it is not there, does not answer or refuses.
    """
    kind = service_type(type_name)
    client = node.create_client(name, kind)
    try:
        return client.call(kind.Request(**fields), _TIMEOUT_S)
    except GazelleError as error:
        raise StudioError(str(error)) from error
    finally:
        client.unregister()


def services_by_type(graph: Graph, type_name: str) -> list[str]:
    """Return the names of all services of a type, sorted."""
    entities = graph.entities()
    return sorted(
        {one.name for one in entities if one.kind is Kind.SERVICE and one.type_name == type_name}
    )


def _type_of(graph: Graph, name: str) -> str:
    types = {one.name: one.type_name for one in graph.services(include_hidden=True)}
    if name not in types:
        raise unknown("service", name, types)
    return types[name]
