"""dynamic_reconfigure.client, on Gazelle's graph."""

from gazelle.compat.dynamic_reconfigure import (
    DynamicReconfigureCallbackException,
    DynamicReconfigureParameterException,
)
from gazelle.compat.dynamic_reconfigure.client import Client

__all__ = [
    "Client",
    "DynamicReconfigureCallbackException",
    "DynamicReconfigureParameterException",
]
