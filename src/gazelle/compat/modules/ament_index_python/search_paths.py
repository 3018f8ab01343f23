"""ament_index_python.search_paths."""

from gazelle.workspace.ament_index import (
    get_search_paths,
)

__all__ = [
    "get_search_paths",
]
