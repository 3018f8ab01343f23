"""Conditions in attributes that every node of BehaviorTree.CPP 4 may have."""

from __future__ import annotations

from collections.abc import Mapping

from gazelle.nodes.nav2.behavior_trees.script import evaluate
from gazelle.nodes.nav2.behavior_trees.tree_node import Decorator, Status

__all__ = ["Conditioned", "conditions_of"]

_BEFORE = (
    ("_failureIf", Status.FAILURE),
    ("_successIf", Status.SUCCESS),
    ("_skipIf", Status.SKIPPED),
)
_NAMES = frozenset(
    {"_failureIf", "_successIf", "_skipIf", "_while", "_onSuccess", "_onFailure", "_onHalted",
     "_post"}
)  # fmt: skip


def conditions_of(attributes: Mapping[str, str]) -> dict[str, str]:
    """Return the conditions among a node's attributes."""
    return {name: text for name, text in attributes.items() if name in _NAMES}


class Conditioned(Decorator):
    """Runs scripts before and after its child.

    Attributes:
        conditions: scripts by attribute.
    """

    conditions: Mapping[str, str] = {}

    def tick(self) -> Status:
        """Ask the scripts that come before, tick, run those that come after."""
        if self.child.status is not Status.RUNNING:
            for name, status in _BEFORE:
                if self._holds(name):
                    return status
        if "_while" in self.conditions and not self._holds("_while"):
            self.halt_child(self.child)
            return Status.SKIPPED
        status = self.child.execute()
        if status.is_done:
            self._run("_onSuccess" if status is Status.SUCCESS else "_onFailure")
            self._run("_post")
        return status

    def halted(self) -> None:
        """Run the script of an end by somebody else."""
        self._run("_onHalted")
        self._run("_post")

    def _holds(self, name: str) -> bool:
        script = self.conditions.get(name)
        return script is not None and bool(evaluate(script, self.ports.blackboard))

    def _run(self, name: str) -> None:
        if name in self.conditions:
            evaluate(self.conditions[name], self.ports.blackboard)
