"""Where the values of parameters come from."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any, Final, Protocol

from gazelle.diagnostics import SourceSpan
from gazelle.parameters.trees import flattened, nested

__all__ = ["MISSING", "ParameterSource", "TreeSource", "branch_of"]

MISSING: Final = object()
"""What a source has for a name that nobody gave a value."""


class ParameterSource(Protocol):
    """Values by name: a tree of YAML, a ``<plugin>`` element, a store."""

    def find(self, name: str) -> Any:
        """Return the value of a name with dots, `MISSING` when there is none."""
        ...

    def leaves(self) -> Iterable[tuple[str, Any]]:
        """Return all that was given, by name with dots."""
        ...

    def full_name(self, name: str) -> str:
        """Return the name that a user knows a parameter by, such as ``/mira/arm/pid/p``."""
        ...

    def place(self, name: str) -> SourceSpan | None:
        """Return where a parameter stands, None when that is not known."""
        ...


class TreeSource:
    """Values of a tree, such as YAML files give.

    Args:
        tree: nested, or keys with dots or slashes.
        full_name: see `ParameterSource.full_name`.
        place: see `ParameterSource.place`.

    Attributes:
        tree: the values, nested.
    """

    def __init__(
        self,
        tree: Mapping[str, Any],
        *,
        full_name: Callable[[str], str] = str,
        place: Callable[[str], SourceSpan | None] = lambda name: None,
    ) -> None:
        self.tree = nested(tree)
        self._full_name = full_name
        self._place = place

    def find(self, name: str) -> Any:
        """Return the value of a name with dots, `MISSING` when there is none."""
        return branch_of(self.tree, name)

    def leaves(self) -> Iterable[tuple[str, Any]]:
        """Return all that was given; an empty branch is a leaf."""
        return flattened(self.tree)

    def full_name(self, name: str) -> str:
        """Return the name that a user knows a parameter by."""
        return self._full_name(name)

    def place(self, name: str) -> SourceSpan | None:
        """Return where a parameter stands."""
        return self._place(name)


def branch_of(tree: Mapping[str, Any], name: str) -> Any:
    """Return what a tree has at a name with dots, `MISSING` when there is nothing."""
    branch: Any = tree
    for word in name.split("."):
        if not isinstance(branch, Mapping) or word not in branch:
            return MISSING
        branch = branch[word]
    return branch
