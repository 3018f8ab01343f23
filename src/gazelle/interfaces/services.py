"""Service and action types of both generations: bundles of message classes."""

from __future__ import annotations

from typing import Any, NamedTuple

from gazelle.interfaces.definition import RosVersion
from gazelle.interfaces.message import Message
from gazelle.interfaces.message_base import Types
from gazelle.interfaces.ros1_message import Ros1Message
from gazelle.interfaces.type_names import ros1_name

__all__ = [
    "ActionType",
    "Ros1Service",
    "ServiceType",
    "make_ros1_service",
    "ros2_action",
    "ros2_service",
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


def ros2_service(types: Types, full: str) -> ServiceType:
    """Return a service in the form of ROS 2.

    Args:
        types: where classes come from.
        full: full name; services of actions are ``pkg/action/Name_SendGoal`` and so on.

    Raises:
        NotFoundError: nothing defines it.
        UserFileError: its definition has errors.
    """
    return ServiceType(
        full, _message(types, f"{full}_Request"), _message(types, f"{full}_Response")
    )


def ros2_action(types: Types, full: str) -> ActionType:
    """Return an action in the form of ROS 2.

    Args:
        types: where classes come from.
        full: full name.

    Raises:
        NotFoundError: nothing defines it.
        UserFileError: its definition has errors.
    """
    return ActionType(
        full,
        _message(types, f"{full}_Goal"),
        _message(types, f"{full}_Result"),
        _message(types, f"{full}_Feedback"),
        ros2_service(types, f"{full}_SendGoal"),
        ros2_service(types, f"{full}_GetResult"),
        _message(types, f"{full}_FeedbackMessage"),
    )


def make_ros1_service(
    types: Types, full: str, request: type[Ros1Message], response: type[Ros1Message]
) -> type[Ros1Service]:
    """Return a new service class in the form of ROS 1.

    Args:
        types: where definitions come from.
        full: full name.
        request: class of requests.
        response: class of responses.
    """
    from gazelle.interfaces.ros1_md5sum import service_md5sum

    attributes: dict[str, Any] = {
        "__module__": f"{full.split('/', maxsplit=1)[0]}.srv._{full.split('/')[2]}",
        "TYPE_NAME": full,
        "_type": ros1_name(full),
        "_md5sum": service_md5sum(types, full),
        "_request_class": request,
        "_response_class": response,
    }
    return type(full.split("/")[2], (Ros1Service,), attributes)


def _message(types: Types, full: str) -> type[Message]:
    return types.class_of(full, RosVersion.ROS2)  # type: ignore[return-value]
