"""moveit.core.kinematic_constraints, on Gazelle's motion."""

from gazelle.compat.moveit.py.kinematic_constraints import *  # noqa: F403
