"""What `dynamic_reconfigure` is in Gazelle: its Python modules, on Gazelle's graph."""

from __future__ import annotations

from gazelle.compat.dynamic_reconfigure.errors import (
    DynamicReconfigureCallbackException,
    DynamicReconfigureException,
    DynamicReconfigureParameterException,
)

__all__ = [
    "DynamicReconfigureCallbackException",
    "DynamicReconfigureException",
    "DynamicReconfigureParameterException",
    "find_reconfigure_services",
    "get_parameter_names",
]


def find_reconfigure_services() -> list[str]:
    """Return the names of all reconfigurable nodes and node handles, sorted."""
    from gazelle.compat.rospy.state import STATE
    from gazelle.graph.dynamic_reconfigure import server_names

    return server_names(STATE.open_graph())


def get_parameter_names(descr: object) -> object:
    """Return the names of a configuration type's parameters."""
    return descr.defaults.keys()  # type: ignore[attr-defined]
