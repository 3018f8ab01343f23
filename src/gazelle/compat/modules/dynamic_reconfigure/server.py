"""dynamic_reconfigure.server, on Gazelle's graph."""

from gazelle.compat.dynamic_reconfigure import (
    DynamicReconfigureCallbackException,
    DynamicReconfigureParameterException,
)
from gazelle.compat.dynamic_reconfigure.server import Server

__all__ = [
    "DynamicReconfigureCallbackException",
    "DynamicReconfigureParameterException",
    "Server",
]
