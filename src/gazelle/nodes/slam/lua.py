"""What can be taken from cartographer's Lua files without running them: plain assignments."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

from gazelle.errors import LaunchError

__all__ = ["read_lua"]

_ASSIGNED = re.compile(
    r"^\s*([A-Za-z_][\w.]*)\s*=\s*(\"[^\"]*\"|-?[\d.]+(?:e-?\d+)?)", re.MULTILINE
)
_COMMENT = re.compile(r"--[^\n]*")
_WANTED = {
    "map_frame": "map_frame",
    "tracking_frame": "tracking_frame",
    "published_frame": "published_frame",
    "submap_publish_period_sec": "submap_publish_period_sec",
    "pose_publish_period_sec": "pose_publish_period_sec",
    "TRAJECTORY_BUILDER_2D.max_range": "max_range",
}
_LARGEST = 1_000_000


def read_lua(words: Sequence[str]) -> dict[str, Any]:
    """Return the parameters that a configuration names, by cartographer_node's arguments.

    Raises:
        LaunchError: the file cannot be read.
    """
    options = dict(pairwise(words))
    folder = options.get("-configuration_directory", "")
    name = options.get("-configuration_basename", "")
    if not name:
        return {}
    path = Path(folder, name)
    try:
        text = path.read_text(errors="replace")[:_LARGEST]
    except OSError as error:
        raise LaunchError(
            f"cartographer's configuration {path} cannot be read: {error.strerror}\n"
            "  fix: -configuration_directory and -configuration_basename name a Lua file"
        ) from None
    found: dict[str, Any] = {}
    for key, value in _ASSIGNED.findall(_COMMENT.sub("", text)):
        if key in _WANTED:
            found[_WANTED[key]] = value[1:-1] if value.startswith('"') else float(value)
    return found
