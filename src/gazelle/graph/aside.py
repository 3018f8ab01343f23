"""What is too long for a terminal: lines that go to a node's log file alone."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import Protocol

from gazelle.folders import ros_log_folder

__all__ = ["aside_path", "write_aside"]


class _Logging(Protocol):
    name: str
    log_path: str


def aside_path(node: _Logging) -> Path:
    """Return a node's log file: the launch's, else ``NAME-PID.log`` where ROS keeps its logs."""
    if node.log_path:
        return Path(node.log_path)
    return (
        ros_log_folder(os.environ) / f"{node.name.strip('/').replace('/', '-')}-{os.getpid()}.log"
    )


def write_aside(node: _Logging, lines: Iterable[str]) -> str:
    """Add lines to the node's log file.

    Returns:
        the file, empty when it cannot be written.
    """
    path = aside_path(node)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("a", encoding="utf-8", errors="replace") as stream:
            stream.writelines(f"{line}\n" for line in lines)
    except OSError:
        return ""
    return str(path)
