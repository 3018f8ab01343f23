"""Motion planning: a path from a configuration to a goal, past obstacles.

`plan` is the one entry; planners have the names that MoveIt gives them.
"""

from __future__ import annotations

from gazelle.motion.planning.error_codes import ErrorCode, PlanningError
from gazelle.motion.planning.path_validation import FINE_STEP, first_fault
from gazelle.motion.planning.plan_path import plan
from gazelle.motion.planning.planner_configs import PlannerConfig, configured
from gazelle.motion.planning.planner_registry import PLANNERS
from gazelle.motion.planning.problem import GoalSource, Path, PlannerSettings, Search
from gazelle.motion.planning.rrt_connect import warm_up

__all__ = [
    "FINE_STEP",
    "PLANNERS",
    "ErrorCode",
    "GoalSource",
    "Path",
    "PlannerConfig",
    "PlannerSettings",
    "PlanningError",
    "Search",
    "configured",
    "first_fault",
    "plan",
    "warm_up",
]
