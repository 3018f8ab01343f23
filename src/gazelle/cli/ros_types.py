"""Classes of messages, services and actions by name, as ROS 1 and ROS 2 write it.

The workspace's own packages are asked when need be.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.cli.ros_tool import ToolError, option_parser
from gazelle.errors import InterfaceError, NotFoundError
from gazelle.interfaces import (
    message_type,
    ros1_message_type,
    ros1_service_type,
    ros1_type_of,
    service_type,
)
from gazelle.nodes.workspace_types import learn_workspace_types

if TYPE_CHECKING:
    from gazelle.interfaces import Message, Ros1Message, Ros1Service, ServiceType

__all__ = [
    "learn_workspace_types",
    "message_class",
    "ros2_message_class",
    "ros2_service_class",
    "service_class",
    "shown_type",
    "stated_message_class",
    "topic_class",
    "wanted_type",
]


def message_class(name: str) -> type[Ros1Message]:
    """Return a class with the field names of ROS 1.

    Args:
        name: ``pkg/Name``, or the name it travels under.

    Raises:
        NotFoundError: nothing defines it.
        UserFileError: its definition has errors.
    """
    short = shown_type(name)
    try:
        return ros1_message_type(short)
    except NotFoundError:
        learn_workspace_types()
        return ros1_message_type(short)


def topic_class(name: str) -> type[Ros1Message]:
    """Return the class of what is published, as `message_class`.

    Raises:
        InterfaceError: nothing defines it here; the text is what ROS says, and where to look.
        UserFileError: its definition has errors.
    """
    try:
        return message_class(name)
    except NotFoundError as error:
        raise InterfaceError(
            f"Cannot load message class for [{shown_type(name)}]. Are your messages built?\n"
            f"  {error}"
        ) from None


def service_class(name: str) -> type[Ros1Service]:
    """Return a service class with the field names of ROS 1.

    Raises:
        NotFoundError: nothing defines it.
        UserFileError: its definition has errors.
    """
    try:
        return ros1_service_type(name)
    except NotFoundError:
        learn_workspace_types()
        return ros1_service_type(name)


def shown_type(name: str) -> str:
    """Return a type's name as ROS 1 shows it; ``*``, any type, stays."""
    return ros1_type_of(name) if name.count("/") == 2 else name


def wanted_type(tool: str, argv: list[str]) -> str:
    """Return the type that the words behind ``find`` name, as `shown_type`."""
    parser = option_parser(tool, "find msg-type")
    _, args = parser.parse_args(argv)
    if not args:
        parser.error("please specify a message type")
    if len(args) > 1:
        parser.error("you may only specify one message type")
    return shown_type(args[0])


def stated_message_class(name: str) -> type[Message]:
    """Return the class of a type that the user wrote.

    Raises:
        ToolError: nothing defines it.
    """
    try:
        return ros2_message_class(name)
    except NotFoundError as error:
        raise ToolError(f"The passed message type is invalid\n  {error}") from None


def ros2_message_class(name: str) -> type[Message]:
    """Return the class of a message.

    Raises:
        NotFoundError: nothing defines it.
        UserFileError: its definition has errors.
    """
    found: type[Message] = _found(message_type, name)
    return found


def ros2_service_class(name: str) -> ServiceType:
    """Return the class of a service that the user wrote.

    Raises:
        ToolError: nothing defines it, or it is no service.
        UserFileError: its definition has errors.
    """
    parts = name.split("/")
    if len(parts) == 3 and parts[1] != "srv":
        raise ToolError(f"The passed type is not a service\n  '{name}' is of {parts[1]}/")
    try:
        found: ServiceType = _found(service_type, name)
    except NotFoundError as error:
        reason = str(error).replace("_Request'", "'", 1)
        raise ToolError(f"The passed service type is invalid\n  {reason}") from None
    return found


def _found(look_up: Callable[[str], Any], name: str) -> Any:
    try:
        return look_up(name)
    except NotFoundError:
        learn_workspace_types()
        return look_up(name)
