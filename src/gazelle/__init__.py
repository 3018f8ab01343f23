"""Gazelle: the ROS + Gazebo workflow with Python and nothing else."""

from __future__ import annotations

from gazelle._version import __version__

# As typing has it: importing that would be most of the time this module takes.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from gazelle.simulator import Simulation

__all__ = ["Simulation", "__version__"]


def __getattr__(name: str) -> Any:
    if name == "Simulation":
        from gazelle.simulator import Simulation

        return Simulation
    raise AttributeError(f"module 'gazelle' has no attribute '{name}'")
