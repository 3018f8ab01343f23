"""``ros2 launch``."""

from __future__ import annotations

from gazelle.cli.ros2.launch.command import main

__all__ = ["main"]
