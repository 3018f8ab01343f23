"""The parameters of one controller, plug-in or node."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from gazelle.parameters.parameter import Parameter

__all__ = ["ParameterTable"]


@dataclass(frozen=True, slots=True)
class ParameterTable:
    """All parameters that there are, what has an effect and what not.

    Attributes:
        family: its name in the documentation.
        summary: what it is, one or two sentences.
        types: the names it goes by: types of a controller or of a plug-in in parameter files,
            libraries without ``lib`` and ``.so``, ``package/type`` of a node.
        rows: one of them each.
    """

    family: str
    summary: str
    types: tuple[str, ...] = ()
    rows: tuple[Parameter, ...] = ()
    _by_name: dict[str, Parameter] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    def row(self, key: str) -> Parameter:
        """Return the row of a key as the table writes it, or of one of its other spellings.

        Raises:
            KeyError: there is none.
        """
        found = self.exact_row(key)
        if found is None:
            raise KeyError(f"{self.family} has no parameter {key}")
        return found

    def exact_row(self, name: str) -> Parameter | None:
        """Return the row that is spelled so letter for letter, None when there is none."""
        return self._index().get(name)

    def row_for(self, name: str) -> Parameter | None:
        """Return the row that a parameter's name belongs to, None when it is unknown."""
        found = self.exact_row(name)
        if found is not None:
            return found
        return next((row for row in self.rows if not row.is_exact and row.matches(name)), None)

    def keys(self) -> list[str]:
        """Return the names of all parameters that have an effect."""
        return [row.key for row in self.rows if not row.is_refused]

    def plus(self, rows: Iterable[Parameter]) -> ParameterTable:
        """Return a table with more rows."""
        return ParameterTable(self.family, self.summary, self.types, (*self.rows, *rows))

    def _index(self) -> dict[str, Parameter]:
        if not self._by_name:
            for row in self.rows:
                for name in row.names:
                    self._by_name.setdefault(name, row)
        return self._by_name
