"""A tree inside a tree."""

from __future__ import annotations

from gazelle.nodes.nav2.behavior_trees.tree_node import Decorator, Status

__all__ = ["SubTree"]


class SubTree(Decorator):
    """Says what the tree below says."""

    def tick(self) -> Status:
        """Tick the tree below; when that is over it is idle again."""
        status = self.child.execute()
        if status.is_done:
            self.halt_children()
        return status
