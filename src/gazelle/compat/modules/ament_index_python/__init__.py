"""ament_index_python, answered by Gazelle's workspace."""

from gazelle.compat.packages.ament_index import *  # noqa: F403
