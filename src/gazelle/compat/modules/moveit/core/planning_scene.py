"""moveit.core.planning_scene, on Gazelle's motion."""

from gazelle.compat.moveit.py.scene import PlanningScene
