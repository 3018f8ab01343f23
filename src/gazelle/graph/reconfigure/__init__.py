"""dynamic_reconfigure: parameters that others see and change while a node runs."""

from __future__ import annotations

from gazelle.graph.reconfigure.client import ReconfigureClient, ReconfigureError
from gazelle.graph.reconfigure.description import (
    DynamicGroup,
    DynamicParameter,
    EnumConstant,
    Value,
    enum_edit_method,
)
from gazelle.graph.reconfigure.messages import server_names
from gazelle.graph.reconfigure.server import ReconfigureServer

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
