"""``ros2 topic``."""

from __future__ import annotations

from gazelle.cli.ros2.topic.command import main

__all__ = ["main"]
