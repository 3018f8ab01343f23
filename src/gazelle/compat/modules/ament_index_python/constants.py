"""ament_index_python.constants."""

from gazelle.workspace.ament_index import (
    AMENT_PREFIX_PATH_ENV_VAR,
    RESOURCE_INDEX_SUBFOLDER,
)

__all__ = [
    "AMENT_PREFIX_PATH_ENV_VAR",
    "RESOURCE_INDEX_SUBFOLDER",
]
