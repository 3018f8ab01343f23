"""Parameters of controllers, plug-ins and nodes: tables of them, and reading values by a table.

A table (`ParameterTable`) has a row (`Parameter`) for every name that the originals read, honoured
or refused with its reason. Readers (`gazelle.parameters.reader`) take their defaults from it, the
pages of the documentation are printed from it (`gazelle.parameters.markdown`), and a name that it
lacks is told.

Every process of the graph has trees of parameters (`gazelle.parameters.trees`), few have tables.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gazelle.parameters.table import (
        Parameter,
        ParameterKind,
        ParameterTable,
        Topic,
        TopicKind,
        refused,
    )

__all__ = ["Parameter", "ParameterKind", "ParameterTable", "Topic", "TopicKind", "refused"]


def __getattr__(name: str) -> Any:
    if name in __all__:
        return getattr(import_module(f"{__name__}.table"), name)
    raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
