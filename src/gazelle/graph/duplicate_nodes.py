"""Of ROS 1's nodes of one name the youngest stays, on the whole graph."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING, NamedTuple

from gazelle.graph.key_expressions import Entity, Kind
from gazelle.graph.process_queries import shut_down_node

if TYPE_CHECKING:
    import zenoh

    from gazelle.graph.discovery import Discovery

__all__ = ["TAKEN_OVER", "DuplicateNodes"]

TAKEN_OVER = "new node registered with same name"
"""What ROS's master tells the older one."""

# By then everybody knows of a node.
_YOUNG_S = 10.0


class _Claim(NamedTuple):
    """Since when a node here has its name: by the wall, to compare with others, and by itself."""

    since_ns: int
    since_s: float


class DuplicateNodes:
    """Asks other processes to end their nodes of the names that nodes here have claimed.

    Word of a node takes a moment, so that of two that start at once neither may know of the other.
    Who hears of the other later asks it then, and the younger one does not obey.
    """

    def __init__(self, session: zenoh.Session, domain: int, zid: str, discovery: Discovery) -> None:
        """Have no names."""
        self._session = session
        self._domain = domain
        self._zid = zid
        self._discovery = discovery
        self._claims: dict[str, _Claim] = {}
        discovery.listen(self._on_entity)

    def claim(self, name: str) -> None:
        """Take a name for a node that is about to be made, and end those who have it."""
        claim = self._claims[name] = _Claim(time.time_ns(), time.monotonic())
        for one in self._discovery.known():
            if self._is_namesake(one, name):
                self._end(one.zid, name, claim)

    def release(self, name: str) -> None:
        """Want a name no more."""
        self._claims.pop(name, None)

    def yields(self, name: str, since_ns: int) -> bool:
        """Tell whether the node here makes way for one that claimed the name at that time."""
        claim = self._claims.get(name)
        return claim is None or claim.since_ns < since_ns

    def _on_entity(self, entity: Entity, is_there: bool) -> None:
        claim = self._claims.get(entity.node)
        if not is_there or claim is None or not self._is_namesake(entity, entity.node):
            return
        if time.monotonic() - claim.since_s < _YOUNG_S:
            # Not here: nothing else would be heard of until it answers.
            threading.Thread(
                target=self._end, args=(entity.zid, entity.node, claim), daemon=True
            ).start()

    def _is_namesake(self, entity: Entity, name: str) -> bool:
        return entity.kind is Kind.NODE and entity.node == name and entity.zid != self._zid

    def _end(self, zid: str, name: str, claim: _Claim) -> None:
        shut_down_node(self._session, self._domain, zid, name, TAKEN_OVER, since_ns=claim.since_ns)
