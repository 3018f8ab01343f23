"""Message, service and action classes of ROS 2 by name; the workspace's packages are asked too."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.cli.ros_types import learn_workspace_types
from gazelle.cli.tool import ToolError
from gazelle.errors import NotFoundError
from gazelle.interfaces import message_type, service_type

if TYPE_CHECKING:
    from gazelle.interfaces import Message, ServiceType

__all__ = ["ros2_message_class", "ros2_service_class", "stated_message_class"]


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
    words = name.split("/")
    if len(words) == 3 and words[1] != "srv":
        raise ToolError(f"The passed type is not a service\n  '{name}' is of {words[1]}/")
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
