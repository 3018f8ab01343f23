"""Message and service classes by name; the workspace's own packages are asked when need be."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gazelle.cli.tool import option_parser
from gazelle.errors import InterfaceError, NotFoundError
from gazelle.interfaces import ros1_message_type, ros1_service_type, ros1_type_of
from gazelle.nodes.workspace_types import learn_workspace_types

if TYPE_CHECKING:
    from gazelle.interfaces import Ros1Message, Ros1Service

__all__ = [
    "learn_workspace_types",
    "message_class",
    "service_class",
    "shown_type",
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


def wanted_type(tool: str, words: list[str]) -> str:
    """Return the type that the words behind ``find`` name, as `shown_type`."""
    parser = option_parser(tool, "find msg-type")
    _, args = parser.parse_args(words)
    if not args:
        parser.error("please specify a message type")
    if len(args) > 1:
        parser.error("you may only specify one message type")
    return shown_type(args[0])
