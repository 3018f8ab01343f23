"""rosservice's functions: types of services, and calls by name."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gazelle.compat.rospy.services import ServiceProxy
from gazelle.compat.rospy.state import STATE
from gazelle.diagnostics import did_you_mean
from gazelle.graph import ServiceInfo
from gazelle.interfaces import fill, ros1_service_type, ros1_type_of

__all__ = [
    "NAME",
    "ROSServiceException",
    "ROSServiceIOException",
    "call_service",
    "get_service_args",
    "get_service_class_by_name",
    "get_service_list",
    "get_service_node",
    "get_service_type",
    "rosservice_find",
]


NAME = "rosservice"


class ROSServiceException(Exception):  # noqa: N818 - rosservice's name
    """A question about a service has no answer."""


class ROSServiceIOException(ROSServiceException):
    """The graph cannot be reached."""


def get_service_list(
    node: str | None = None, namespace: str | None = None, include_nodes: bool = False
) -> list[Any]:
    """Return the names of services, of a node or below a namespace; with nodes if asked for."""
    found = STATE.open_graph().services()
    if namespace:
        start = STATE.resolved(namespace).rstrip("/")
        found = tuple(one for one in found if one.name.startswith(f"{start}/"))
    if node:
        full = STATE.resolved(node)
        found = tuple(one for one in found if full in one.servers)
    names = sorted(found, key=lambda one: one.name)
    return (
        [(one.name, list(one.servers)) for one in names]
        if include_nodes
        else [one.name for one in names]
    )


def get_service_type(service_name: str) -> str | None:
    """Return a service's type, None when nobody offers it."""
    found = _find(service_name)
    return None if found is None else ros1_type_of(found.type_name)


def get_service_node(service_name: str) -> str | None:
    """Return the node that offers a service, None when nobody does."""
    found = _find(service_name)
    return None if found is None else next(iter(found.servers), None)


def rosservice_find(service_type: str) -> list[str]:
    """Return the services of a type."""
    found = STATE.open_graph().services()
    return [one.name for one in found if ros1_type_of(one.type_name) == service_type]


def get_service_class_by_name(service_name: str) -> Any:
    """Return the class of a service.

    Raises:
        ROSServiceException: nobody offers it.
    """
    name = get_service_type(service_name)
    if name is None:
        known = [one.name for one in STATE.open_graph().services()]
        hint = did_you_mean(service_name, known)
        raise ROSServiceException(f"Service [{service_name}] is not available. {hint}".rstrip())
    return ros1_service_type(name)


def get_service_args(service_name: str) -> str:
    """Return the names of a request's fields.

    Raises:
        ROSServiceException: nobody offers the service.
    """
    kind = get_service_class_by_name(service_name)
    return " ".join(kind._request_class.__slots__)


def call_service(
    service_name: str, service_args: Sequence[Any], service_class: Any = None
) -> tuple[Any, Any]:
    """Call a service with values from YAML; return request and response.

    Raises:
        ROSServiceException: nobody offers it, or the values do not fit.
        ServiceException: the call failed.
    """
    from gazelle.errors import InterfaceError

    kind = service_class or get_service_class_by_name(service_name)
    request = kind._request_class()
    try:
        fill(request, list(service_args))
    except InterfaceError as error:
        text = f"Incompatible arguments to call service [{service_name}]"
        raise ROSServiceException(f"{text}:\n{error}") from error
    return request, ServiceProxy(service_name, kind)(request)


def _find(name: str) -> ServiceInfo | None:
    full = STATE.resolved(name)
    return next((one for one in STATE.open_graph().services() if one.name == full), None)
