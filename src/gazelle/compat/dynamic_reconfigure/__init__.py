"""What `dynamic_reconfigure` is in Gazelle: its Python modules, on Gazelle's graph."""

from __future__ import annotations

__all__ = [
    "DynamicReconfigureCallbackException",
    "DynamicReconfigureException",
    "DynamicReconfigureParameterException",
    "find_reconfigure_services",
    "get_parameter_names",
]


class DynamicReconfigureException(Exception):  # noqa: N818 - the original's name
    """Base of the others."""


class DynamicReconfigureParameterException(DynamicReconfigureException):
    """A parameter is unknown, or a value does not fit."""


class DynamicReconfigureCallbackException(DynamicReconfigureException):
    """The node's callback failed, or its server could not be called."""


def find_reconfigure_services() -> list[str]:
    """Return the names of all reconfigurable nodes and node handles, sorted."""
    from gazelle.compat.rospy.state import STATE
    from gazelle.graph.dynamic_reconfigure import server_names

    return server_names(STATE.open_graph())


def get_parameter_names(descr: object) -> object:
    """Return the names of a configuration type's parameters."""
    return descr.defaults.keys()  # type: ignore[attr-defined]
