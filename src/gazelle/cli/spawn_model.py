"""``spawn_model`` without rosrun: puts a model into a running world."""

from __future__ import annotations

from gazelle.nodes.__main__ import main as run_node

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Spawn a model and end."""
    return run_node(["gazebo_ros/spawn_model", *argv])
