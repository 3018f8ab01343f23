"""What a controller manager asks for parameters."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

from gazelle.diagnostics import SourceSpan

__all__ = ["ParameterSource"]


class ParameterSource(Protocol):
    """Parameters of one controller manager and its controllers."""

    def controllers(self) -> tuple[str, ...]:
        """Return the names of the configured controllers: those that have a type."""
        ...

    def controller_type(self, controller: str) -> str | None:
        """Return the type a controller is configured with, None when there is none."""
        ...

    def tree(self, controller: str) -> Mapping[str, Any]:
        """Return a controller's parameters, nested or with dots; empty when there are none."""
        ...

    def manager_tree(self) -> Mapping[str, Any]:
        """Return the parameters of the controller manager itself."""
        ...

    def set(self, controller: str, key: str, value: Any) -> None:
        """Set a parameter of a controller; an empty name means the manager."""
        ...

    def full_name(self, controller: str, key: str) -> str:
        """Return the name a user knows a parameter by."""
        ...

    def place(self, controller: str, key: str) -> SourceSpan | None:
        """Return where a parameter stands, None when that is not known."""
        ...
