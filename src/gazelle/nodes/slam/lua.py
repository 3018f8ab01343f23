"""What can be taken from cartographer's Lua files without running them: plain assignments."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from gazelle.errors import LaunchError
from gazelle.nodes.gflags import Kind, read_flags

__all__ = ["read_lua"]

_ASSIGNED = re.compile(
    r"^\s*([A-Za-z_][\w.]*)\s*=\s*(\"[^\"]*\"|true\b|false\b|-?[\d.]+(?:e-?\d+)?)", re.MULTILINE
)
_FLAGS: dict[str, Kind] = {
    **dict.fromkeys(("collect_metrics", "load_frozen_state", "logtostderr", "alsologtostderr",
                     "start_trajectory_with_default_topics"), "bool"),
    **dict.fromkeys(("configuration_basename", "configuration_directory", "load_state_filename",
                     "save_state_filename", "log_dir", "minloglevel", "v"), "string"),
}  # fmt: skip
_COMMENT = re.compile(r"--[^\n]*")
_RENAMED = {"TRAJECTORY_BUILDER_2D.max_range": "max_range"}
_LARGEST = 1_000_000


def read_lua(words: Sequence[str]) -> dict[str, Any]:
    """Return the parameters that a configuration names, by cartographer_node's arguments.

    Raises:
        LaunchError: the file cannot be read.
    """
    options = read_flags(words, _FLAGS)
    folder = str(options.get("configuration_directory", ""))
    name = str(options.get("configuration_basename", ""))
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
        found[_RENAMED.get(key, key)] = _value(value)
    return found


def _value(word: str) -> str | float | bool:
    if word.startswith('"'):
        return word[1:-1]
    return word == "true" if word in ("true", "false") else float(word)
