"""dynamic_reconfigure: parameters that others see and change while a node runs."""

from __future__ import annotations

from gazelle.graph.dynamic_reconfigure.client import ReconfigureClient, ReconfigureError
from gazelle.graph.dynamic_reconfigure.description import (
    DynamicGroup,
    DynamicParameter,
    EnumConstant,
    Value,
    enum_edit_method,
)
from gazelle.graph.dynamic_reconfigure.messages import server_names
from gazelle.graph.dynamic_reconfigure.server import ReconfigureServer

__all__ = [
    "DynamicGroup",
    "DynamicParameter",
    "EnumConstant",
    "ReconfigureClient",
    "ReconfigureError",
    "ReconfigureServer",
    "Value",
    "enum_edit_method",
    "server_names",
]
