"""moveit.planning, on Gazelle's graph."""

from gazelle.compat.moveit.py.planning import *  # noqa: F403
