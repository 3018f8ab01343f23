"""dynamic_reconfigure, on Gazelle's graph."""

from gazelle.compat.dynamic_reconfigure import (
    DynamicReconfigureCallbackException,
    DynamicReconfigureException,
    DynamicReconfigureParameterException,
    find_reconfigure_services,
    get_parameter_names,
)

__all__ = [
    "DynamicReconfigureCallbackException",
    "DynamicReconfigureException",
    "DynamicReconfigureParameterException",
    "find_reconfigure_services",
    "get_parameter_names",
]
