"""ament_index_python.resources."""

from gazelle.compat.packages.ament_index import *  # noqa: F403
