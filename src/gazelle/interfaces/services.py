"""Service and action types of both generations: bundles of message classes."""

from __future__ import annotations

from typing import Any, NamedTuple

from gazelle.interfaces import library
from gazelle.interfaces.lookup import split_name
from gazelle.interfaces.message import Message, message_type
from gazelle.interfaces.naming import ros1_name
from gazelle.interfaces.ros1_message import Ros1Message, ros1_class

__all__ = [
    "ActionType",
    "Ros1Service",
    "ServiceType",
    "action_type",
    "ros1_service_type",
    "service_type",
]


class ServiceType(NamedTuple):
    """A service in the form of ROS 2.

    Attributes:
        name: full name, such as ``std_srvs/srv/SetBool``.
        Request: class of requests.
        Response: class of responses.
    """

    name: str
    Request: type[Message]
    Response: type[Message]


class ActionType(NamedTuple):
    """An action in the form of ROS 2, with the services and topic it consists of.

    Attributes:
        name: full name, such as ``example_interfaces/action/Fibonacci``.
        Goal: class of goals.
        Result: class of results.
        Feedback: class of feedback.
        SendGoal: service that sends a goal.
        GetResult: service that waits for the result.
        FeedbackMessage: class that travels on the feedback topic.
    """

    name: str
    Goal: type[Message]
    Result: type[Message]
    Feedback: type[Message]
    SendGoal: ServiceType
    GetResult: ServiceType
    FeedbackMessage: type[Message]


class Ros1Service:
    """Base of service classes in the form of ROS 1, with genpy's attributes.

    Attributes:
        TYPE_NAME: full name, such as ``std_srvs/srv/SetBool``.
    """

    TYPE_NAME: str = ""
    _type: str = ""
    _md5sum: str = ""
    _request_class: type[Ros1Message]
    _response_class: type[Ros1Message]


_services: dict[str, tuple[int, type[Ros1Service]]] = {}


def service_type(name: str) -> ServiceType:
    """Return a service in the form of ROS 2.

    Args:
        name: ``std_srvs/srv/SetBool`` or ``std_srvs/SetBool``.

    Raises:
        NotFoundError: nothing defines it.
        UserFileError: its definition has errors.
    """
    full = "/".join(split_name(name, "srv"))
    return _service(full)


def action_type(name: str) -> ActionType:
    """Return an action in the form of ROS 2.

    Args:
        name: ``example_interfaces/action/Fibonacci`` or ``example_interfaces/Fibonacci``.

    Raises:
        NotFoundError: nothing defines it.
        UserFileError: its definition has errors.
    """
    full = "/".join(split_name(name, "action"))
    return ActionType(
        full,
        message_type(f"{full}_Goal"),
        message_type(f"{full}_Result"),
        message_type(f"{full}_Feedback"),
        _service(f"{full}_SendGoal"),
        _service(f"{full}_GetResult"),
        message_type(f"{full}_FeedbackMessage"),
    )


def ros1_service_type(name: str) -> type[Ros1Service]:
    """Return a service class in the form of ROS 1.

    It has `_type`, `_md5sum`, `_request_class` and `_response_class`, as genpy's classes do.

    Args:
        name: ``std_srvs/SetBool`` or ``std_srvs/srv/SetBool``.

    Raises:
        NotFoundError: nothing defines it.
        UserFileError: its definition has errors.
    """
    from gazelle.interfaces.ros1_digest import service_md5sum

    full = "/".join(split_name(name, "srv"))
    known = _services.get(full)
    if known is not None and known[0] == library.revision():
        return known[1]
    request, response = ros1_class(f"{full}_Request"), ros1_class(f"{full}_Response")
    if known is not None and known[1]._request_class is request:
        found = known[1]
    else:
        attributes: dict[str, Any] = {
            "__module__": f"{full.split('/')[0]}.srv._{full.split('/')[2]}",
            "TYPE_NAME": full,
            "_type": ros1_name(full),
            "_md5sum": service_md5sum(full),
            "_request_class": request,
            "_response_class": response,
        }
        found = type(full.split("/")[2], (Ros1Service,), attributes)
    _services[full] = (library.revision(), found)
    return found


def _service(full: str) -> ServiceType:
    return ServiceType(full, message_type(f"{full}_Request"), message_type(f"{full}_Response"))
