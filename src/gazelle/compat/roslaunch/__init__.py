"""roslaunch from Python: launch files and single nodes, each run by ``gazelle roslaunch``."""

from __future__ import annotations

from gazelle.compat.roslaunch.core import (
    DEFAULT_MASTER_PORT,
    Node,
    Process,
    ProcessListener,
    RLException,
)
from gazelle.compat.roslaunch.parent import ROSLaunchParent
from gazelle.compat.roslaunch.scriptapi import ROSLaunch

__all__ = [
    "DEFAULT_MASTER_PORT",
    "Node",
    "Process",
    "ProcessListener",
    "RLException",
    "ROSLaunch",
    "ROSLaunchParent",
]
