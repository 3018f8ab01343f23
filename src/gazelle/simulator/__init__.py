"""The world server: time loop, plug-ins, services and the `Simulation` API."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gazelle.simulator.simulation import Simulation
    from gazelle.simulator.wall_clock import Mode
    from gazelle.simulator.world_server import ServerSettings, WorldServer

__all__ = ["Mode", "ServerSettings", "Simulation", "WorldServer"]

_PLACES = {
    "Mode": "gazelle.simulator.wall_clock",
    "ServerSettings": "gazelle.simulator.world_server",
    "Simulation": "gazelle.simulator.simulation",
    "WorldServer": "gazelle.simulator.world_server",
}


def __getattr__(name: str) -> Any:
    if name in _PLACES:
        from importlib import import_module

        return getattr(import_module(_PLACES[name]), name)
    raise AttributeError(f"module 'gazelle.simulator' has no attribute '{name}'")
