"""Which topics are recorded."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from gazelle.graph import ANY_TYPE, Entity, Kind
from gazelle.graph.names import is_hidden

__all__ = ["Selection"]


@dataclass(frozen=True, slots=True)
class Selection:
    """What the user asked for.

    Attributes:
        topics: global names.
        every: all topics.
        patterns: regular expressions of names; ROS's matches the whole name.
        exclude: regular expression of names that are left out.
        node: a node whose subscriptions are recorded.
        hidden: also names with a part that starts with an underscore, in `every`.
    """

    topics: tuple[str, ...] = ()
    every: bool = False
    patterns: tuple[re.Pattern[str], ...] = ()
    exclude: re.Pattern[str] | None = None
    node: str = ""
    hidden: bool = True

    @property
    def is_open(self) -> bool:
        """Whether topics may be wanted that are not known yet."""
        return bool(self.every or self.patterns or self.node)

    def found(self, entities: Iterable[Entity]) -> list[str]:
        """Return the topics on the graph that are wanted, those named apart, sorted."""
        names = set()
        for one in entities:
            is_end = one.kind in (Kind.PUBLISHER, Kind.SUBSCRIPTION) and one.type_name != ANY_TYPE
            if is_end and one.name not in self.topics and self._wants(one):
                names.add(one.name)
        return sorted(names)

    def _wants(self, one: Entity) -> bool:
        if self.exclude is not None and self.exclude.fullmatch(one.name):
            return False
        if self.node:
            return one.kind is Kind.SUBSCRIPTION and one.node == self.node
        if one.kind is not Kind.PUBLISHER:
            return False
        if self.every:
            return self.hidden or not is_hidden(one.name)
        return any(pattern.fullmatch(one.name) for pattern in self.patterns)
