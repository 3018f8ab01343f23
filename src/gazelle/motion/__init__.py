"""Arms: inverse kinematics, collision checking, motion planning, time parameterisation."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gazelle.motion.moveit_config_planner import Goal, PlannedMotion, Planner, Search

__all__ = ["Goal", "PlannedMotion", "Planner", "Search"]


def __getattr__(name: str) -> Any:
    """Load the planner only when it is asked for: it brings MuJoCo and compiled kernels."""
    if name not in __all__:
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
    from gazelle.motion import moveit_config_planner

    return getattr(moveit_config_planner, name)
