"""ament_index_python.packages."""

from gazelle.compat.packages.ament_index import *  # noqa: F403
