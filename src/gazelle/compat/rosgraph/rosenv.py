"""The address of the master, which is this process's own graph whatever it says."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping, Sequence

from gazelle.compat.warn_once import warn_once

__all__ = [
    "DEFAULT_MASTER_PORT",
    "DEFAULT_MASTER_URI",
    "ROS_MASTER_URI",
    "get_master_uri",
    "warn_of_master",
]

ROS_MASTER_URI = "ROS_MASTER_URI"
DEFAULT_MASTER_PORT = 11311
DEFAULT_MASTER_URI = f"http://localhost:{DEFAULT_MASTER_PORT}"


def get_master_uri(env: Mapping[str, str] | None = None, argv: Sequence[str] | None = None) -> str:
    """Return ``__master:=`` of a command line, or ``ROS_MASTER_URI``."""
    arguments = sys.argv if argv is None else argv
    given = [one.partition(":=")[2] for one in arguments if one.startswith("__master:=")]
    if given:
        return given[0]
    return (os.environ if env is None else env).get(ROS_MASTER_URI, DEFAULT_MASTER_URI)


def warn_of_master(uri: str | None) -> None:
    """Say that another master's address leads to this process's own graph."""
    own = get_master_uri()
    if uri and uri.rstrip("/") != own.rstrip("/"):
        warn_once(f"master {uri}: answered by the graph of this process, {own}")
