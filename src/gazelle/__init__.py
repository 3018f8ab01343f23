"""Gazelle: the ROS + Gazebo workflow with Python and nothing else."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle._version import __version__

if TYPE_CHECKING:
    from gazelle.simulator import Simulation

__all__ = ["Simulation", "__version__"]


def __getattr__(name: str) -> Any:
    if name == "Simulation":
        from gazelle.simulator import Simulation

        return Simulation
    raise AttributeError(f"module 'gazelle' has no attribute '{name}'")
