"""Which names nodes and namespaces may have (rclpy.validate_node_name and its kin)."""

from __future__ import annotations

import re

from gazelle.errors import LaunchError

__all__ = ["InvalidNamespaceError", "InvalidNodeNameError", "check_name", "check_namespace"]

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_WRONG = re.compile(r"[^A-Za-z0-9_]")


class InvalidNodeNameError(LaunchError):
    """A node cannot have this name."""


class InvalidNamespaceError(LaunchError):
    """A namespace cannot have this name."""


def check_name(name: str) -> None:
    """See that a node may have a name.

    Raises:
        InvalidNodeNameError: it may not; the message says why and what to write.
    """
    if not _NAME.fullmatch(name):
        raise InvalidNodeNameError(f"Invalid node name: {_why(name, 'node name')}")


def check_namespace(namespace: str) -> None:
    """See that an absolute namespace is legal.

    Raises:
        InvalidNamespaceError: it is not.
    """
    if namespace == "/":
        return
    for part in namespace.split("/")[1:]:
        if not _NAME.fullmatch(part):
            why = _why(part, "namespace") if part else "it has an empty part"
            raise InvalidNamespaceError(f"Invalid namespace: {why} ('{namespace}')")


def _why(name: str, what: str) -> str:
    if not name:
        return f"{what} must not be empty"
    if name[0].isdigit():
        return f"'{name}': {what} must not start with a number"
    if what == "node name" and "/" in name:
        return f"'{name}': {what} must not contain '/'; give the namespace as namespace="
    instead = _WRONG.sub("_", name)
    return (
        f"'{name}': {what} must not contain characters other than alphanumerics or '_'; "
        f"'{instead}' would do"
    )
