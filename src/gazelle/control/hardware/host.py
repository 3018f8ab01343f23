"""What hardware needs of the simulator."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from gazelle.diagnostics import Diagnostics

if TYPE_CHECKING:
    from gazelle.engine import Engine

__all__ = ["HardwareHost", "ParameterStore"]


class HardwareHost(Protocol):
    """The world that simulated hardware belongs to."""

    engine: Engine
    diagnostics: Diagnostics


class ParameterStore(Protocol):
    """The ROS 1 parameter store, by global names."""

    def get(self, name: str, default: Any = ...) -> Any:
        """Return a parameter or a namespace, or `default`."""
        ...
