"""Where the nodes of a tree keep what they tell each other."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

__all__ = ["Blackboard"]


class Blackboard:
    """Values by key; that of a subtree passes some keys on to the tree above.

    A key that begins with ``@`` is one of the outermost tree (BehaviorTree.CPP 4).
    """

    def __init__(
        self,
        parent: Blackboard | None = None,
        remapped: Mapping[str, str] | None = None,
        *,
        takes_all: bool = False,
    ) -> None:
        """Begin empty.

        Args:
            parent: of the tree above.
            remapped: keys here and their names above.
            takes_all: every key that is not private (``_…``) is the parent's of the same name.
        """
        self._parent = parent
        self._remapped = dict(remapped or {})
        self._takes_all = takes_all
        self._values: dict[str, Any] = {}

    @property
    def root(self) -> Blackboard:
        """The outermost tree's."""
        return self if self._parent is None else self._parent.root

    def has(self, key: str) -> bool:
        """Tell whether a key has a value."""
        board, name = self._place(key)
        return name in board._values

    def get(self, key: str, default: Any = None) -> Any:
        """Return a value."""
        board, name = self._place(key)
        return board._values.get(name, default)

    def set(self, key: str, value: Any) -> None:
        """Keep a value."""
        board, name = self._place(key)
        board._values[name] = value

    def unset(self, key: str) -> None:
        """Forget a value."""
        board, name = self._place(key)
        board._values.pop(name, None)

    def _place(self, key: str) -> tuple[Blackboard, str]:
        if key.startswith("@"):
            return self.root._place(key[1:])
        if self._parent is not None:
            if key in self._remapped:
                return self._parent._place(self._remapped[key])
            if self._takes_all and not key.startswith("_"):
                return self._parent._place(key)
        return self, key
