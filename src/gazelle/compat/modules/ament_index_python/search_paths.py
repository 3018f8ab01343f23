"""ament_index_python.search_paths."""

from gazelle.compat.packages.ament_index import *  # noqa: F403
