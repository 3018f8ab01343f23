"""``ros2 doctor`` and ``ros2 wtf``: what is there, and what looks wrong."""

from __future__ import annotations

from gazelle.cli.ros2.doctor.command import main

__all__ = ["main"]
